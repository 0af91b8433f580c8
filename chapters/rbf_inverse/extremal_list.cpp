#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;
using scene::Workshop;

/// An extremal with its kind at T = 2; kinds are recorded.
struct KnownKind {
  DuffingCase which;
  double cost;
  bvp::Kind kind;
};
const std::vector<KnownKind>& known_kinds() {
  using enum bvp::Kind;
  static const std::vector<KnownKind> all = {
      {DuffingCase::free, 8.94191, minimum},    {DuffingCase::fixed, 122.0838, minimum},
      {DuffingCase::fixed, 327.489, minimum},   {DuffingCase::x1x1, 7.99567, minimum},
      {DuffingCase::x1x1, 178.0, saddle},       {DuffingCase::x1x1, 357.51, saddle},
      {DuffingCase::x1x2, 0.103246, minimum},   {DuffingCase::x1x2, 10.2497, saddle},
      {DuffingCase::x2x1, 9.50766, minimum},    {DuffingCase::harmonic, 61.52487, minimum},
      {DuffingCase::harmonic, 200.555, saddle}, {DuffingCase::free, 294.38, saddle},
      {DuffingCase::fixed, 375.11, saddle}};
  return all;
}

scene::Table tabulate(const DuffingRuns& runs, Workshop& w) {
  scene::Table table({{"T"},
                      {"case"},
                      {"cost", 10},
                      {"kind"},
                      {"least eigenvalue", 3},
                      {"starts that led to it"},
                      {"x1(0)", 8},
                      {"x2(0)", 8},
                      {"lambda1(0)", 10},
                      {"lambda2(0)", 10},
                      {"miss of the flown end", 2}});
  const auto shown = [](double value) { return std::abs(value) < 1e-12 ? 0.0 : value; };
  for (std::size_t i = 0; i < final_times.size(); ++i) {
    for (const DuffingCase which : bvp::duffing_cases()) {
      for (const bvp::Found& f : extremals_of(runs, w, which, i).found) {
        const Eigen::VectorXd z = f.extremal.solution.first();
        table.add(
            {final_times[i], std::string(to_string(which)), f.extremal.cost < 1e-20 ? 0.0 : f.extremal.cost,
             std::string(to_string(f.extremal.second_order.kind)), f.extremal.second_order.least,
             std::int64_t{f.hits}, shown(z[0]), shown(z[1]), shown(z[2]), shown(z[3]), f.extremal.miss});
      }
    }
  }
  return table;
}

scene::Figure draw(const DuffingRuns& runs, Workshop& w) {
  ControlCurves figure("Many extremals a case; costs differ by orders of magnitude");
  std::string tics;
  const auto cases = bvp::duffing_cases();
  for (std::size_t c = 0; c < cases.size(); ++c)
    tics += fmt::format("{}\"{}\" {}", c == 0 ? "(" : ", ", to_string(cases[c]), c + 1);
  tics += ") rotate by 40 right";
  for (std::size_t i = 0; i < final_times.size(); ++i) {
    figure.panel("", i == 0 ? "cost {/:Italic J}" : "", time_label(final_times[i]));
    for (const bool minimum : {true, false}) {
      figure.begin(minimum ? "minimum" : "saddle", minimum ? "o1" : "o5");
      for (std::size_t c = 0; c < cases.size(); ++c) {
        for (const bvp::Found& f : extremals_of(runs, w, cases[c], i).found) {
          const bool is_minimum = f.extremal.second_order.kind == bvp::Kind::minimum;
          if (is_minimum == minimum && f.extremal.cost > 1e-4)
            figure.add(static_cast<double>(c) + 1, f.extremal.cost);
        }
      }
      if (!minimum) figure.add(1, 1e-9);  // below the axis: a curve has a point at least
    }
    figure.with("logy", "1").with("yrange", "[1e-2:1e6]").with("xrange", "[0.4:8.6]").with("xtics", tics);
    figure.with("key", i == 2 ? "top right" : "off");
  }
  figure.overall("bottom", "0.2").overall("width", "1000").overall("height", "480");
  return figure.take();
}

std::vector<scene::Quantity> promises(const DuffingRuns& runs, Workshop& w) {
  std::vector<scene::Quantity> all;
  double worst_first = 0;
  for (const KnownExtremal& k : known_extremals()) {
    const auto time = static_cast<std::size_t>(
        std::find(final_times.begin(), final_times.end(), k.final_time) - final_times.begin());
    const bvp::Extremal& e = best_of(runs, w, k.which, time);
    all.push_back(scene::at_most(
        fmt::format("lowest cost, {}, {}", to_string(k.which), time_label(k.final_time)), "1", e.cost,
        k.cost * (1 + 1e-9), "the lowest of 270 starts, tools/oracles/rbf_inverse_extremals.py"));
    for (std::size_t i = 0; i < 4; ++i) {
      const double off = e.solution.first()[static_cast<Eigen::Index>(i)] - k.first[i];
      worst_first = std::max(worst_first, std::abs(off) / std::max(1.0, std::abs(k.first[i])));
    }
  }
  all.push_back(scene::at_most("largest error of their initial states and co-states", "1", worst_first, 1e-10,
                               "the same; relative where above 1"));
  double worst_miss = 0;
  for (std::size_t i = 0; i < final_times.size(); ++i)
    for (const DuffingCase which : bvp::duffing_cases())
      for (const bvp::Found& f : extremals_of(runs, w, which, i).found)
        worst_miss = std::max(worst_miss, f.extremal.miss / (1 + f.extremal.solution.first().norm()));
  all.push_back(scene::at_most("largest miss of all extremals over their initial values", "1", worst_miss,
                               1e-9, "the tolerance of the collocation"));
  // The kind must agree wherever the same extremal was found.
  int disagree = 0;
  for (const KnownKind& k : known_kinds())
    for (const bvp::Found& f : extremals_of(runs, w, k.which).found)
      if (std::abs(f.extremal.cost / k.cost - 1) < 1e-4 && f.extremal.second_order.kind != k.kind) ++disagree;
  all.push_back(scene::at_most("extremals whose kind disagrees", "1", disagree, 0, "recorded"));
  // oracle: rbf_inverse_extremals fixed T = 5 cost
  all.push_back(scene::at_most("cost of the fixed case, T = 5", "1",
                               best_of(runs, w, DuffingCase::fixed, 2).cost, 46.608623 * (1 + 1e-7),
                               "the best known, tools/oracles/rbf_inverse_extremals.py"));
  all.push_back(scene::at_most("cost of a free start, T = 2", "1",
                               best_of(runs, w, DuffingCase::final_only).cost, 1e-12,
                               "flown backward from the target without force: J = 0"));
  return all;
}

}  // namespace

void add_extremals(scene::Chapter& chapter, const DuffingRuns& runs) {
  std::vector<const scene::AnyRun*> needs;
  for (const auto& at_time : runs.extremals) needs.insert(needs.end(), at_time.begin(), at_time.end());
  chapter.add({.name = "extremals",
               .title = "All extremals that the program's own starts find, with cost and kind",
               .place = "our own",
               .needs = needs,
               .show = [runs](Workshop& w) {
                 return scene::Showing{draw(runs, w), tabulate(runs, w), promises(runs, w)};
               }});
}

}  // namespace nlmech::chapters
