#include "nlmech/comparison/choice/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/integrators/problem_set.hpp"
#include "nlmech/comparison/any_method.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::integrators::choose {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Time of a method over that of the fastest, from a row of tables/reference/method_times.csv; infinite if it
/// does not achieve the digits.
double over_fastest(const scene::CsvRecord& headings, const scene::CsvRecord& row,
                    const std::string& method) {
  const auto column = std::ranges::find(headings.cells, method + " over fastest");
  double factor = infinity;
  const bool known =
      column != headings.cells.end() &&
      scene::parse_number(row.cells.at(static_cast<std::size_t>(column - headings.cells.begin())), factor);
  if (!known) return infinity;
  return factor;
}

/// The first choice of the command for a problem and digits, with its measured times.
struct Judged {
  std::string problem;
  int digits;
  comparison::Features features;
  std::string rule, chosen, fastest;
  double behind;     ///< time of the chosen method over that of the fastest
  double series;     ///< time of `series` over that of the fastest
  double condition;  ///< condition number found by the command
  double delivered;  ///< achieved digits at t1 with the tolerance that the command recommends
};

double delivered(const SetProblem& p, const comparison::Ranked& first) {
  const auto run =
      comparison::any_method(first.method)
          .with({.tolerance = first.tolerance, .absolute_tolerance = first.tolerance * p.absolute});
  const ivp::Solution end = run(p.system, p.x0, p.t0, p.t1, {}, {});
  return end.status.ok() ? std::clamp(-std::log10(p.error(end.x, p.times.size() - 1)), 0.0, 16.0) : 0;
}

std::vector<Judged> assess_choices(bool /*quick*/) {
  const auto file = scene::data_folder() / "tables" / "reference" / "method_times.csv";
  const auto rows = scene::parse_csv(scene::read_whole(file), file.filename().string());
  std::vector<Judged> judged;
  for (const SetProblem& p : problem_set()) {
    if (!p.has_solution()) continue;
    const comparison::ChoiceRequest request{p.system, p.x0, p.t0, p.t1, p.absolute};
    const comparison::MethodChoice examined = comparison::examine(request);
    for (const scene::CsvRecord& row : rows) {
      const std::string& fastest = row.cells.at(2);
      if (row.cells[0] != p.name || fastest == "none") continue;
      const int digits = std::stoi(row.cells[1]);
      const comparison::MethodChoice c = comparison::choose(request, digits, examined);
      const comparison::Ranked first = c.ranked.empty() ? comparison::Ranked{"none"} : c.ranked.front();
      judged.push_back({p.name, digits, c.features,
                        std::string(comparison::choice_rule(c.features, digits).name), first.method, fastest,
                        over_fastest(rows[0], row, first.method), over_fastest(rows[0], row, "series"),
                        c.condition, c.ranked.empty() ? 0 : delivered(p, first)});
    }
  }
  return judged;
}

double share_within(const std::vector<Judged>& all, double Judged::*factor, double bound) {
  const auto count = std::ranges::count_if(all, [&](const Judged& j) { return j.*factor <= bound; });
  return 100. * static_cast<double>(count) / static_cast<double>(all.size());
}

void put(const std::vector<Judged>& all, scene::Show& show) {
  scene::Panel& panel = show.plot(fmt::format("First choice within twice the fastest time: {:.0f} % of cases",
                                              share_within(all, &Judged::behind, 2)),
                                  "run time over that of the fastest method", "share of cases, %");
  panel.log_x(1, 20).y_range(0, 100).key("bottom right");
  for (const auto& [name, factor] :
       {std::pair("first choice", &Judged::behind), std::pair("always series", &Judged::series)}) {
    std::vector<double> x, y;
    for (int k = 0; k <= 130; ++k) {
      x.push_back(std::pow(10, 0.01 * k));
      y.push_back(share_within(all, factor, x.back()));
    }
    panel.curve(name, x, y);
  }
  show.table(all, {{"problem", &Judged::problem},
                   {"digits", &Judged::digits},
                   {"stiffness", [](const Judged& j) { return j.features.stiffness; }, 2},
                   {"operations", [](const Judged& j) { return j.features.operations; }},
                   {"rule", &Judged::rule},
                   {"chosen", &Judged::chosen},
                   {"fastest", &Judged::fastest},
                   {"chosen / fastest time", &Judged::behind},
                   {"condition", &Judged::condition, 2},
                   {"digits achieved", &Judged::delivered, 3}});
  double delivered = 0, few = 0, explicit_most = 0, stiff_least = infinity;
  for (const Judged& j : all) {
    const double stiffness = j.features.stiffness;
    if (stiffness > comparison::stiff_from)
      stiff_least = std::min(stiff_least, stiffness);
    else
      explicit_most = std::max(explicit_most, stiffness);
    if (j.digits == 12) continue;
    ++few;
    delivered += j.delivered > j.digits - 0.5 ? 100 : 0;
  }
  show.between("problems and digits", all.size(), 78, 88,
               "22 problems at 3, 6, 9 and 12 digits; 12 are not achieved on every problem, and rounding "
               "decides on which");
  show.between("share of cases with 3, 6 and 9 digits achieved to within half a digit, %", delivered / few,
               90, 100,
               "the rules take a third of the tolerance that an error at a single time would need; at 12 "
               "digits rounding decides");
  show.between("share of series within a factor of two, %", share_within(all, &Judged::series, 2), 0, 100,
               "for comparison: the gain of the rules over series alone");
  show.between("share within a factor of two of the fastest, %", share_within(all, &Judged::behind, 2), 80,
               100, "requirement of the chapter");
  show.between("greatest stiffness below the threshold", explicit_most, 0, comparison::stiff_from / 2,
               "the threshold follows from regions of stability; no problem is near it");
  show.between("least stiffness above the threshold", stiff_least, comparison::stiff_from * 2, 1e3,
               "the threshold follows from regions of stability; no problem is near it");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result judged(
      "judged",
      "every problem of the set at 3, 6, 9 and 12 digits; run times from tables/reference/method_times.csv",
      assess_choices);
  return {{.name = "choose",
           .title = "Run time of the chosen method over that of the fastest",
           .content = scene::Content(put, judged)}};
}

}  // namespace nlmech::chapters::integrators::choose
