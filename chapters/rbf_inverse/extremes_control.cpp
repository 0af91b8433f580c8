#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/duffing_runs.hpp"
#include "nlmech/bvp/dual_problem.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using bvp::DuffingCase;

/// A case that is hard by its numbers, and its extremals.
struct Hard {
  DuffingCase which;
  double final_time, beta;
  std::optional<double> known = {};  ///< least cost known
  bvp::Multistart all = {};

  [[nodiscard]] std::string task() const {
    return fmt::format("{}, T = {:g}, beta = {:g}", to_string(which), final_time, beta);
  }
  [[nodiscard]] std::string ends() const {
    return fmt::format("{}, {}, {}", all.good, all.spurious, all.failed);
  }
  /// The cheapest, if any is found.
  [[nodiscard]] const bvp::Extremal* best() const {
    return all.found.empty() ? nullptr : &all.found.front().extremal;
  }
  /// Energy of the target over T, times 3/2: what a pump of linear amplitude costs.
  [[nodiscard]] double estimate() const {
    const double x = 5, v = 2;
    return 1.5 * (v * v / 2 + x * x / 2 + beta / 4 * x * x * x * x) / final_time;
  }
};

/// A task that is odd, and what became of it.
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
  std::vector<Hard> hard;
  std::vector<Odd> odd;  ///< zero weights, a vanishing time, a contradiction
};

std::vector<Hard> hard_cases(bool quick) {
  // Few swings need pumps alone, many need descents from them; a free end is left to the direct method.
  const bvp::DuffingStarts pumps{
      .constants = false, .unforced = 0, .pumps = 8, .direct = 0, .random = 0, .driven = 3};
  const bvp::DuffingStarts direct{
      .constants = false, .unforced = 0, .pumps = 0, .direct = 4, .random = 0, .driven = 0};
  // Costs: Taylor's method of order 34 in 36 digits, the end met to 1e-26.
  std::vector<Hard> all = {{DuffingCase::fixed, 2, 3, 384.514},
                           {DuffingCase::fixed, 2, 10, 1162.868031234447},
                           {DuffingCase::fixed, 2, 30, 3497.287677516521},
                           {DuffingCase::fixed, 2, 100, 11649.91891386899},
                           {DuffingCase::fixed, 2, 300},
                           {DuffingCase::fixed, 10, 0.9, 24.39874152832613},
                           {DuffingCase::fixed, 20, 0.9, 12.18151689917772},
                           {DuffingCase::free, 2, 30},
                           {DuffingCase::free, 2, 100},
                           {DuffingCase::free, 10, 0.9},
                           {DuffingCase::free, 20, 0.9}};
  if (quick) std::erase_if(all, [](const Hard& h) { return h.beta > 10 || h.final_time > 2; });
  for (Hard& h : all) {
    bvp::DuffingSettings settings = printed_settings(h.which, h.final_time);
    settings.beta = h.beta;
    h.all = duffing_extremals(settings, h.which == DuffingCase::fixed ? pumps : direct, {}, {});
  }
  return all;
}

std::vector<Odd> odd_tasks() {
  // Nothing is asked of the end, so nothing should be done.
  bvp::DuffingSettings idle = printed_settings(DuffingCase::free);
  idle.weights.setZero();
  const bvp::Multistart none = duffing_extremals(idle, {.unforced = 2, .pumps = 0, .direct = 1, .random = 4});
  Odd zero{"free, zero weights", "none found", HUGE_VAL, HUGE_VAL};
  if (!none.found.empty()) {
    const bvp::Extremal& e = none.found.front().extremal;
    zero = {zero.task, "success", e.cost, e.solution.first().tail(2).norm()};
  }
  // A position at the end of a vanishing time.
  const bvp::ExtremalProblem sudden = duffing_problem(printed_settings(DuffingCase::fixed, 1e-3));
  const bvp::Extremal jerk = solve_extremal(sudden, bvp::constant_start(Eigen::VectorXd::Ones(4)));
  const Status contradiction =
      solve(bvp::DualProblem(TwoBegins{}), bvp::constant_start(Eigen::VectorXd::Zero(2))).status;
  return {zero,
          {"fixed, T = 1e-3", std::string(to_string(jerk.solution.status.outcome())), jerk.cost, 0},
          {"x1(0) = 0 and x1(0) = 1", std::string(to_string(contradiction.outcome())), {}, 0}};
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
  for (const Hard& h : all.hard) {
    const scene::Cell guess = h.which == DuffingCase::fixed ? scene::Cell(h.estimate()) : scene::Cell();
    if (const bvp::Extremal* e = h.best())
      table.add({h.task(), "success", e->cost, h.known, guess, e->solution.unknowns.intervals.size(), e->miss,
                 h.ends()});
    else
      table.add({h.task(), "none found", {}, h.known, guess, {}, {}, h.ends()});
  }
  for (const Odd& o : all.odd) {
    const std::optional<double> cost = o.cost && std::abs(*o.cost) < 1e-20 ? 0.0 : o.cost;
    table.add({o.task, o.status, cost, {}, {}, {}, {}, {}});
  }
  return table;
}

void put(const Extremes& all, scene::Show& show) {
  show.table(tabulate(all));
  for (const Hard& h : all.hard) {
    const double cost = h.best() != nullptr ? h.best()->cost : HUGE_VAL;
    if (h.which == DuffingCase::free)
      show.at_most("lowest cost, " + h.task(), cost, 14.5, "staying at rest costs (5^2 + 2^2)/2");
    else if (h.known)
      show.at_most("lowest cost, " + h.task(), cost, *h.known * (1 + (h.beta == 3 ? 1e-5 : 1e-9)),
                   "recorded, its digits; lower is welcome");
  }
  const Odd &zero = all.odd[0], &sudden = all.odd[1], &contradiction = all.odd[2];
  show.equals("are two values at one end refused as infeasible?", contradiction.status == "infeasible", 1,
              "x1(0) = 0 and x1(0) = 1");
  show.at_most("force with zero weights", {zero.costate, "1/s^2"}, 1e-12, "no force costs nothing");
  // x'' = f brings x from 0 to 5 within T, x' to 2: f is linear in t, J = (12 x^2/T^2 - 12 x v/T + 4 v^2)/(2
  // T).
  const double t = 1e-3, x = 5, v = 2;
  show.near("cost, fixed, T = 1e-3", sudden.cost.value_or(HUGE_VAL),
            (12 * x * x / (t * t) - 12 * x * v / t + 4 * v * v) / (2 * t), 1e-4,
            "without spring the force is linear in time; the spring is T^2 of it");
}

}  // namespace

std::vector<scene::Scene> extremes_control() {
  const scene::Result all("extremes-control",
                          "fixed cases from pumps and descents from them, free ones from "
                          "the direct method",
                          [](bool quick) {
                            return Extremes{hard_cases(quick), odd_tasks()};
                          });
  return {{.name = "extremes-ocp",
           .title = "Strong nonlinearity, long and vanishing times, zero weights, contradictions",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::rbf_inverse
