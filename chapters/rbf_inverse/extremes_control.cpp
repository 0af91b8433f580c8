#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/rbf_inverse/scenes.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;
using scene::Workshop;

/// A case that is hard by its numbers.
struct Hard {
  DuffingCase which;
  double final_time, beta;
  double known;  ///< cost that an independent program found; 0 if it found none
};
const std::vector<Hard>& hard_cases() {
  static const std::vector<Hard> all = {{DuffingCase::fixed, 2, 3, 384.514},
                                        {DuffingCase::fixed, 2, 10, 1162.87},
                                        {DuffingCase::fixed, 2, 30, 3558.27},
                                        {DuffingCase::fixed, 2, 100, 0},
                                        {DuffingCase::fixed, 10, 0.9, 24.398741},
                                        {DuffingCase::fixed, 20, 0.9, 12.804494},
                                        {DuffingCase::free, 2, 30, 0},
                                        {DuffingCase::free, 10, 0.9, 0}};
  return all;
}

/// Energy of the target over T, times 3/2: what a pump of linear amplitude costs.
double estimate(const Hard& h) {
  const bvp::DuffingSettings s;
  const double x = s.target[0], v = s.target[1];
  return 1.5 * (v * v / 2 + x * x / 2 + h.beta / 4 * x * x * x * x) / h.final_time;
}

struct Outcome1 {
  Hard hard;
  bvp::Multistart found;
};
struct Odd {
  std::string task, status;
  double cost, costate;
};
struct Extremes {
  std::vector<Outcome1> hard;
  std::vector<Odd> odd;
};

Extremes compute(bool quick) {
  Extremes all;
  for (const Hard& h : hard_cases()) {
    if (quick && (h.beta > 10 || h.final_time > 10)) continue;
    bvp::DuffingSettings settings = printed_settings(h.which, h.final_time);
    settings.beta = h.beta;
    const bool pump = h.which == DuffingCase::fixed;
    all.hard.push_back({h, duffing_extremals(settings,
                                             {.constants = false,
                                              .unforced = 0,
                                              .pumps = pump ? (h.final_time > 5 ? 8 : 4) : 0,
                                              .direct = pump ? 0 : 4,
                                              .random = 0},
                                             {}, {})});
  }
  // Nothing is asked of the end, so nothing should be done.
  bvp::DuffingSettings idle = printed_settings(DuffingCase::free, 2);
  idle.weights.setZero();
  const bvp::Multistart none = duffing_extremals(idle, {.unforced = 2, .pumps = 0, .direct = 1, .random = 4});
  all.odd.push_back(
      {"free final state, zero weights", none.found.empty() ? "none found" : "success",
       none.found.empty() ? HUGE_VAL : none.found.front().extremal.cost,
       none.found.empty() ? HUGE_VAL : none.found.front().extremal.solution.first().tail(2).norm()});
  // A position at the end of a vanishing time.
  bvp::DuffingSettings sudden = printed_settings(DuffingCase::fixed, 1e-3);
  const bvp::Extremal jerk =
      solve_extremal(duffing_problem(sudden), bvp::constant_start(Eigen::VectorXd::Ones(4)));
  all.odd.push_back({"fixed, T = 1e-3", std::string(to_string(jerk.solution.status.outcome())), jerk.cost,
                     jerk.solution.status.ok() ? jerk.solution.first()[2] : HUGE_VAL});
  return all;
}

scene::Table tabulate(const Extremes& all) {
  scene::Table table({{"task"},
                      {"status"},
                      {"cost", 9},
                      {"of an independent program", 8},
                      {"1.5 E/T", 4},
                      {"intervals"},
                      {"miss of the flown end", 2},
                      {"starts: extremals, spurious, failed"}});
  for (const Outcome1& o : all.hard) {
    const std::string task =
        fmt::format("{}, T = {:g}, beta = {:g}", to_string(o.hard.which), o.hard.final_time, o.hard.beta);
    const std::string starts = fmt::format("{}, {}, {}", o.found.good, o.found.spurious, o.found.failed);
    const scene::Cell known = o.hard.known > 0 ? scene::Cell(o.hard.known) : scene::Cell();
    const scene::Cell guess =
        o.hard.which == DuffingCase::fixed ? scene::Cell(estimate(o.hard)) : scene::Cell();
    if (o.found.found.empty()) {
      table.add({task, std::string("none found"), {}, known, guess, {}, {}, starts});
      continue;
    }
    const bvp::Extremal& e = o.found.found.front().extremal;
    table.add({task, std::string("success"), e.cost, known, guess,
               static_cast<std::int64_t>(e.solution.unknowns.intervals.size()), e.miss, starts});
  }
  for (const Odd& o : all.odd)
    table.add({o.task, o.status, std::abs(o.cost) < 1e-20 ? 0.0 : o.cost, {}, {}, {}, {}, {}});
  return table;
}

std::vector<scene::Quantity> promises(const Extremes& all) {
  std::vector<scene::Quantity> quantities;
  for (const Outcome1& o : all.hard) {
    if (o.hard.known == 0) continue;
    const double cost = o.found.found.empty() ? HUGE_VAL : o.found.found.front().extremal.cost;
    quantities.push_back(scene::at_most(fmt::format("lowest cost, {}, T = {:g}, beta = {:g}",
                                                    to_string(o.hard.which), o.hard.final_time, o.hard.beta),
                                        "1", cost, o.hard.known * (1 + 1e-5),
                                        "an independent program, its digits; lower is welcome"));
  }
  quantities.push_back(scene::at_most("force with zero weights", "1/s^2", all.odd[0].costate, 1e-12,
                                      "no force costs nothing"));
  // x'' = f brings x from 0 to 5 within T, x' to 2: f is linear in t, J = (12 x^2/T^2 - 12 x v/T + 4 v^2)/(2
  // T).
  const double t = 1e-3, x = 5, v = 2;
  quantities.push_back(scene::near("cost, fixed, T = 1e-3", "1", all.odd[1].cost,
                                   (12 * x * x / (t * t) - 12 * x * v / t + 4 * v * v) / (2 * t), 1e-4,
                                   "without spring the force is linear in time; the spring is T^2 of it"));
  return quantities;
}

}  // namespace

void add_control_extremes(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Extremes>("extremes-control",
                                              "fixed cases from pumps of linear amplitude, free ones from "
                                              "the direct method",
                                              {}, [](Workshop& w) { return compute(w.quick()); });
  chapter.add({.name = "extremes-ocp",
               .title = "Strong nonlinearity, long and vanishing times, zero weights",
               .place = "our own",
               .needs = {&run},
               .seconds = 10,
               .show = [&run](Workshop& w) {
                 const Extremes& all = w.result(run);
                 return scene::Showing{{}, tabulate(all), promises(all)};
               }});
}

}  // namespace nlmech::chapters
