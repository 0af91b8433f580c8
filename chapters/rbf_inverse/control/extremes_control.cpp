#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/bvp/optimal_control/dual_problem.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::chapters::rbf_inverse::extremes_control {
namespace {

using bvp::DuffingCase;

/// Row of the table: a task and its result; cells are empty if not applicable.
struct Row {
  std::string task, status = "none found";
  std::optional<double> cost = {}, known = {}, estimate = {}, miss = {};
  scene::Cell intervals = {}, starts = {};
  double most = HUGE_VAL;  ///< upper bound of the cost

  [[nodiscard]] std::optional<double> shown_cost() const {
    return cost && std::abs(*cost) < 1e-20 ? 0.0 : cost;
  }
};

/// Case with extreme parameters.
struct Hard {
  DuffingCase which;
  double final_time, beta;
  std::optional<double> known = {};  ///< least cost known
};

/// Solves a hard case; returns its row.
Row solved(const Hard& h) {
  // A fixed end takes pump_start() for few oscillations and the direct method from it for many; a free end
  // takes the direct method.
  const bool fixed = h.which == DuffingCase::fixed;
  const bvp::DuffingStarts starts{.constants = false,
                                  .unforced = 0,
                                  .pumps = fixed ? 8 : 0,
                                  .direct = fixed ? 0 : 4,
                                  .random = 0,
                                  .driven = fixed ? 3 : 0};
  bvp::DuffingSettings settings = printed_settings(h.which, h.final_time);
  settings.beta = h.beta;
  const bvp::Multistart all = duffing_extremals(settings, starts, {}, {});
  Row row{.task = fmt::format("{}, T = {:g}, beta = {:g}", to_string(h.which), h.final_time, h.beta),
          .known = h.known,
          .starts = fmt::format("{}, {}, {}", all.good, all.spurious, all.failed)};
  // 3/2 times the energy of the target over T: cost of pump_start() for linearly growing amplitude.
  const double x = 5, v = 2;
  if (fixed) row.estimate = 1.5 * (v * v / 2 + x * x / 2 + h.beta / 4 * x * x * x * x) / h.final_time;
  if (h.known) row.most = *h.known * (1 + (h.beta == 3 ? 1e-5 : 1e-9));
  if (all.found.empty()) return row;
  const bvp::Extremal& e = all.found.front().extremal;
  row.status = "success";
  row.cost = e.cost;
  row.miss = e.miss;
  row.intervals = e.solution.unknowns.intervals.size();
  return row;
}

/// Oscillator with the right number of conditions, two of which are contradictory.
struct ContradictoryStart {
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
  std::vector<Row> rows;  ///< the last three rows: zero weights, a very short time, contradictory conditions
  double idle_force = HUGE_VAL;  ///< force with zero weights
};

Extremes compute(bool quick) {
  // Reference costs: Taylor method of order 34 in 36 digits, end conditions met to 1e-26.
  std::vector<Hard> hard = {{DuffingCase::fixed, 2, 3, 384.514},
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
  if (quick) std::erase_if(hard, [](const Hard& h) { return h.beta > 10 || h.final_time > 2; });
  Extremes all;
  std::ranges::transform(hard, std::back_inserter(all.rows), solved);
  // With zero weights of the end cost the optimal force is 0.
  bvp::DuffingSettings idle = printed_settings(DuffingCase::free);
  idle.weights.setZero();
  const bvp::Multistart none = duffing_extremals(idle, {.unforced = 2, .pumps = 0, .direct = 1, .random = 4});
  Row& zero = all.rows.emplace_back(Row{.task = "free, zero weights"});
  if (!none.found.empty()) {
    const bvp::Extremal& e = none.found.front().extremal;
    zero.status = "success";
    zero.cost = e.cost;
    all.idle_force = e.solution.first().tail(2).norm();
  }
  // Prescribed end state after a very short time.
  const bvp::ExtremalProblem sudden = duffing_problem(printed_settings(DuffingCase::fixed, 1e-3));
  const bvp::Extremal jerk = solve_extremal(sudden, bvp::constant_start(Eigen::VectorXd::Ones(4)));
  all.rows.push_back({"fixed, T = 1e-3", std::string(to_string(jerk.solution.status.outcome())), jerk.cost});
  const auto contradiction =
      solve(bvp::DualProblem(ContradictoryStart{}), bvp::constant_start(Eigen::VectorXd::Zero(2)));
  all.rows.push_back({"x1(0) = 0 and x1(0) = 1", std::string(to_string(contradiction.status.outcome()))});
  return all;
}

void put(const Extremes& all, scene::Show& show) {
  show.table(all.rows, {{"task", &Row::task},
                        {"status", &Row::status},
                        {"cost", &Row::shown_cost, 9},
                        {"least known", &Row::known, 8},
                        {"1.5 E/T", &Row::estimate, 4},
                        {"intervals", &Row::intervals},
                        {"miss of the integrated end", &Row::miss, 2},
                        {"starts: extremals, spurious, failed", &Row::starts}});
  for (const Row& r : all.rows | std::views::take(all.rows.size() - 3)) {
    const double cost = r.cost.value_or(HUGE_VAL);
    if (!r.estimate)
      show.at_most("lowest cost, " + r.task, cost, 14.5, "staying at rest costs (5^2 + 2^2)/2");
    else if (r.known)
      show.at_most("lowest cost, " + r.task, cost, r.most,
                   "regression value, its digits; a lower cost is an improvement");
  }
  show.equals("are two values at one end refused as infeasible?", all.rows.back().status == "infeasible", 1,
              "x1(0) = 0 and x1(0) = 1");
  show.at_most("force with zero weights", {all.idle_force, "1/s^2"}, 1e-12, "no force costs nothing");
  // x'' = f brings x from 0 to 5 within T, x' to 2: f is linear in t, J = (12 x^2/T^2 - 12 x v/T + 4 v^2)/(2
  // T).
  const double t = 1e-3, x = 5, v = 2;
  show.near("cost, fixed, T = 1e-3", all.rows[all.rows.size() - 2].cost.value_or(HUGE_VAL),
            (12 * x * x / (t * t) - 12 * x * v / t + 4 * v * v) / (2 * t), 1e-4,
            "without spring the force is linear in time; the spring is T^2 of it");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result all("extremes-control",
                          "fixed cases from pumps and descents from them, free ones from "
                          "the direct method",
                          compute);
  return {{.name = "extremes-ocp",
           .title = "Strong nonlinearity, long and very short times, zero weights, contradictory conditions",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::rbf_inverse::extremes_control
