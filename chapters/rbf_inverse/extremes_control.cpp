#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "chapters/rbf_inverse/scenes.hpp"
#include "nlmech/bvp/dual_problem.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;
using scene::Workshop;

/// A case that is hard by its numbers.
struct Hard {
  DuffingCase which;
  double final_time, beta;
  double known;            ///< least cost known; 0 if none is
  bvp::DuffingStarts own;  ///< starts
};
const std::vector<Hard>& hard_cases() {
  // Few swings need pumps alone, many need descents from them; a free end is left to the direct method.
  const bvp::DuffingStarts pumps{
      .constants = false, .unforced = 0, .pumps = 8, .direct = 0, .random = 0, .driven = 3};
  const bvp::DuffingStarts direct{
      .constants = false, .unforced = 0, .pumps = 0, .direct = 4, .random = 0, .driven = 0};
  // Costs: Taylor's method of order 34 in 36 digits, the end met to 1e-26.
  static const std::vector<Hard> all = {{DuffingCase::fixed, 2, 3, 384.514, pumps},
                                        {DuffingCase::fixed, 2, 10, 1162.868031234447, pumps},
                                        {DuffingCase::fixed, 2, 30, 3497.287677516521, pumps},
                                        {DuffingCase::fixed, 2, 100, 11649.91891386899, pumps},
                                        {DuffingCase::fixed, 2, 300, 0, pumps},
                                        {DuffingCase::fixed, 10, 0.9, 24.39874152832613, pumps},
                                        {DuffingCase::fixed, 20, 0.9, 12.18151689917772, pumps},
                                        {DuffingCase::free, 2, 30, 0, direct},
                                        {DuffingCase::free, 2, 100, 0, direct},
                                        {DuffingCase::free, 10, 0.9, 0, direct},
                                        {DuffingCase::free, 20, 0.9, 0, direct}};
  return all;
}

/// Energy of the target over T, times 3/2: what a pump of linear amplitude costs.
double estimate(const Hard& h) {
  const bvp::DuffingSettings s;
  const double x = s.target[0], v = s.target[1];
  return 1.5 * (v * v / 2 + x * x / 2 + h.beta / 4 * x * x * x * x) / h.final_time;
}

struct HardResult {
  Hard hard;
  bvp::Multistart found;
};
struct Odd {
  std::string task, status;
  std::optional<double> cost;
  double costate;
};

/// The oscillator with two conditions that cannot hold both, though their number is right.
struct TwoBegins {
  static constexpr int states = 2, parameters = 0;
  [[nodiscard]] std::vector<double> points() const { return {0, 2}; }
  template <class T>
  void rhs(const T& /*t*/, const Vector<T, 2>& x, const Vector<T, 0>& /*p*/, Vector<T, 2>& f) const {
    f[0] = x[1];
    f[1] = -x[0] - 0.9 * (x[0] * x[0] * x[0]);
  }
  template <class T>
  void conditions(const Matrix<T, 2, Eigen::Dynamic>& ends, const Vector<T, 0>& /*p*/,
                  Vector<T, Eigen::Dynamic>& r) const {
    r[0] = ends(0, 0);
    r[1] = ends(0, 0) - 1.0;
  }
};
struct Extremes {
  std::vector<HardResult> hard;
  std::vector<Odd> odd;
};

Extremes compute(bool quick) {
  Extremes all;
  for (const Hard& h : hard_cases()) {
    if (quick && (h.beta > 10 || h.final_time > 2)) continue;
    bvp::DuffingSettings settings = printed_settings(h.which, h.final_time);
    settings.beta = h.beta;
    all.hard.push_back({h, duffing_extremals(settings, h.own, {}, {})});
  }
  // Nothing is asked of the end, so nothing should be done.
  bvp::DuffingSettings idle = printed_settings(DuffingCase::free, 2);
  idle.weights.setZero();
  const bvp::Multistart none = duffing_extremals(idle, {.unforced = 2, .pumps = 0, .direct = 1, .random = 4});
  all.odd.push_back(
      {"free, zero weights", none.found.empty() ? "none found" : "success",
       none.found.empty() ? HUGE_VAL : none.found.front().extremal.cost,
       none.found.empty() ? HUGE_VAL : none.found.front().extremal.solution.first().tail(2).norm()});
  // A position at the end of a vanishing time.
  bvp::DuffingSettings sudden = printed_settings(DuffingCase::fixed, 1e-3);
  const bvp::Extremal jerk =
      solve_extremal(duffing_problem(sudden), bvp::constant_start(Eigen::VectorXd::Ones(4)));
  all.odd.push_back({"fixed, T = 1e-3", std::string(to_string(jerk.solution.status.outcome())), jerk.cost,
                     jerk.solution.status.ok() ? jerk.solution.first()[2] : HUGE_VAL});
  const Status none_at_all =
      solve(bvp::DualProblem(TwoBegins{}), bvp::constant_start(Eigen::VectorXd::Zero(2))).status;
  all.odd.push_back({"x1(0) = 0 and x1(0) = 1", std::string(to_string(none_at_all.outcome())), {}, 0});
  return all;
}

scene::Table tabulate(const Extremes& all) {
  scene::Table table({{"task"},
                      {"status"},
                      {"cost", 9},
                      {"least known", 8},
                      {"1.5 E/T", 4},
                      {"intervals"},
                      {"miss of the flown end", 2},
                      {"starts: extremals, spurious, failed"}});
  for (const HardResult& o : all.hard) {
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
    table.add({o.task,
               o.status,
               o.cost ? scene::Cell(std::abs(*o.cost) < 1e-20 ? 0.0 : *o.cost) : scene::Cell(),
               {},
               {},
               {},
               {},
               {}});
  return table;
}

std::vector<scene::Quantity> promises(const Extremes& all) {
  std::vector<scene::Quantity> quantities;
  for (const HardResult& o : all.hard) {
    const bool is_free = o.hard.which == DuffingCase::free;
    if (o.hard.known == 0 && !is_free) continue;
    const double cost = o.found.found.empty() ? HUGE_VAL : o.found.found.front().extremal.cost;
    const std::string name = fmt::format("lowest cost, {}, T = {:g}, beta = {:g}", to_string(o.hard.which),
                                         o.hard.final_time, o.hard.beta);
    if (is_free)
      quantities.push_back(scene::at_most(name, "1", cost, 14.5, "staying at rest costs (5^2 + 2^2)/2"));
    else
      quantities.push_back(scene::at_most(name, "1", cost,
                                          o.hard.known * (1 + (o.hard.beta == 3 ? 1e-5 : 1e-9)),
                                          "recorded, its digits; lower is welcome"));
  }
  quantities.push_back(scene::near("are two values at one end refused as infeasible?", "1",
                                   all.odd.back().status == "infeasible" ? 1 : 0, 1, 0,
                                   "x1(0) = 0 and x1(0) = 1"));
  quantities.push_back(scene::at_most("force with zero weights", "1/s^2", all.odd[0].costate, 1e-12,
                                      "no force costs nothing"));
  // x'' = f brings x from 0 to 5 within T, x' to 2: f is linear in t, J = (12 x^2/T^2 - 12 x v/T + 4 v^2)/(2
  // T).
  const double t = 1e-3, x = 5, v = 2;
  quantities.push_back(scene::near("cost, fixed, T = 1e-3", "1", all.odd[1].cost.value_or(HUGE_VAL),
                                   (12 * x * x / (t * t) - 12 * x * v / t + 4 * v * v) / (2 * t), 1e-4,
                                   "without spring the force is linear in time; the spring is T^2 of it"));
  return quantities;
}

}  // namespace

void add_control_extremes(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Extremes>("extremes-control",
                                              "fixed cases from pumps and descents from them, free ones from "
                                              "the direct method",
                                              {}, [](Workshop& w) { return compute(w.quick()); });
  chapter.add({.name = "extremes-ocp",
               .title = "Strong nonlinearity, long and vanishing times, zero weights, contradictions",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) {
                 const Extremes& all = w.result(run);
                 return scene::Showing{{}, tabulate(all), promises(all)};
               }});
}

}  // namespace nlmech::chapters
