#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr std::size_t twenty = 2;  // revolutions[twenty]
constexpr std::array drawn = {Propagator::ode45, Propagator::series, Propagator::f_and_g,
                              Propagator::rkn1210};

double greatest(const EnergyRecord& record) {
  return *std::max_element(record.error.begin(), record.error.end());
}

/// The greatest error of each twenty-fifth of an orbit, at its time: more cannot be told apart in a picture.
void add_curve(scene::Table& data, std::int64_t number, const EnergyRecord& record, double period) {
  const double bin = period / 25;
  std::size_t best = 0;
  for (std::size_t i = 1; i <= record.t.size(); ++i) {
    const auto bin_of = [&](std::size_t k) { return static_cast<int>(record.t[k] / bin - 1e-9); };
    if (i == record.t.size() || bin_of(i) != bin_of(best)) {
      data.add({number, record.t[best] / period, record.error[best]});
      best = i;
    } else if (record.error[i] > record.error[best]) {
      best = i;
    }
  }
}

/// Points at which the double precision of the state knows no difference at all.
double share_of_zeros(const EnergyRecord& record) {
  const auto zeros = std::count(record.error.begin(), record.error.end(), 0.0);
  return static_cast<double>(zeros) / static_cast<double>(record.error.size());
}

scene::Showing show(const PublishedRuns& runs, Workshop& w) {
  scene::Table data({{"curve", 3, true}, {"orbit"}, {"error"}});
  scene::Showing showing;
  const bool low = runs.orbit.order == low_orbit().order;
  std::int64_t number = 0;
  std::string text;
  for (const Propagator p : drawn) {
    const EnergyRecord& record = w.result(runs.of(p, twenty));
    add_curve(data, ++number, record, period_of(runs.orbit));
    if (p == Propagator::ode45 || p == Propagator::series) {
      text += fmt::format("{}{} to {}", text.empty() ? "" : ", ", name_of(p),
                          scene::format_number(greatest(record), 1));
      continue;
    }
    showing.quantities.push_back(scene::at_most(fmt::format("greatest energy error of {}", name_of(p)), "1",
                                                greatest(record), p == Propagator::rkn1210 ? 1e-13 : 2e-12,
                                                p == Propagator::rkn1210
                                                    ? "rounding of some thousand steps, 2 eps each by chance"
                                                    : "eps t/G in Lagrange's G with t up to 20 orbits"));
    showing.quantities.push_back({fmt::format("share of points at which {} errs by 0", name_of(p)), "1",
                                  share_of_zeros(record), 0, 0.3,
                                  "errors of a few eps: now and then the nearest double is the same"});
  }
  // 1.19e-7 and 1.02e-11 are norms over 500 and 2000 points with errors that grow about linearly: the last is
  // sqrt(3/points) of the norm, and oscillates by less than a factor of three.
  const double norm = low ? 1.19e-7 : 1.02e-11, points = runs.orbit.steps * 20;
  const double last = norm * std::sqrt(3 / points);
  showing.quantities.push_back({"greatest energy error of Analytic-Cont", "1",
                                greatest(w.result(runs.of(Propagator::series, twenty))), last / 3, 3 * last,
                                "the recorded norm over points whose errors grow with time"});
  const double norm45 = low ? 9.42e-5 : 1.44e-3, last45 = norm45 * std::sqrt(3 / points);
  showing.quantities.push_back({"greatest energy error of ode45", "1",
                                greatest(w.result(runs.of(Propagator::ode45, twenty))), last45 / 3,
                                3 * last45, "the recorded norm over points whose errors grow with time"});
  showing.figure = {std::move(data),
                    "two_body_series-history",
                    {{"heading", fmt::format("{}: {}, the others at rounding", runs.orbit.name, text)}}};
  return showing;
}

}  // namespace

void add_history(scene::Chapter& chapter, const PublishedRuns& runs) {
  std::vector<const scene::AnyRun*> needs;
  for (const Propagator p : drawn) needs.push_back(&runs.of(p, twenty));
  const bool low = runs.orbit.order == low_orbit().order;
  chapter.add({.name = low ? "fig-3.22" : "fig-3.23",
               .title = fmt::format("{}: relative energy error over 20 orbits", runs.orbit.name),
               .place = low ? "Figure 3.22" : "Figure 3.23",
               .needs = needs,
               .show = [runs](Workshop& w) { return show(runs, w); }});
}

}  // namespace nlmech::chapters
