/// @file
/// What the hunts over commands for initial value problems share: random problems, and what two methods that
/// have no part in the commands' verification know of their solutions.
#pragma once

#include <fmt/format.h>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/adversary/commands/command_run.hpp"

namespace nlmech::adversary {

/// Of which no reference of the commands is made.
inline constexpr std::array oracles = {"odeint-bulirsch-stoer", "arkode-erk"};

/// States at several times, one a column.
struct Known {
  Eigen::MatrixXd x;      ///< by the first oracle
  Eigen::MatrixXd doubt;  ///< |difference| of the two
  Eigen::VectorXd size;   ///< greatest |x_i| at these times and at the begin
};

/// The way that a command was asked to go.
struct Journey {
  double t0 = 0;                   ///< begin
  std::vector<double> times = {};  ///< in the direction of travel, the last is the end
};

/// The tolerances of a run.
struct Tolerances {
  double relative, absolute;
};

/// How far off the states of a run by a tolerance may be: what the commands' page says, 100 tolerances or ten
/// times what the problem makes of one on the way.
inline constexpr double most_tolerances = 100, most_amplified = 10;

namespace detail {

inline std::optional<Eigen::VectorXd> end_by(const char* method, const ivp::System& system,
                                             const Eigen::VectorXd& x0, double t0, double t1) {
  // The finest that these two methods hold in doubles.
  const auto run = peers::peer_integrator(method, 1e-13, 1e-15);
  const auto end = run(system, ivp::State(x0), t0, t1, {}, {.steps = 2'000'000, .seconds = 5});
  if (!end.status.ok() || !end.x.allFinite()) return {};
  return Eigen::VectorXd(end.x);
}

/// From time to time by one method.
inline std::optional<Eigen::MatrixXd> states_by(const char* method, const ivp::System& system,
                                                const Eigen::VectorXd& x0, const Journey& way) {
  Eigen::MatrixXd all(x0.size(), static_cast<Eigen::Index>(way.times.size()));
  Eigen::VectorXd x = x0;
  double t = way.t0;
  for (std::size_t k = 0; k < way.times.size(); ++k) {
    if (way.times[k] != t) {
      const auto next = end_by(method, system, x, t, way.times[k]);
      if (!next) return {};
      x = *next;
    }
    t = way.times[k];
    all.col(static_cast<Eigen::Index>(k)) = x;
  }
  return all;
}

inline std::optional<Known> known(const ivp::System& system, const Eigen::VectorXd& x0, const Journey& way) {
  const auto a = states_by(oracles[0], system, x0, way), b = states_by(oracles[1], system, x0, way);
  if (!a || !b) return {};
  return Known{*a, (*a - *b).cwiseAbs(), a->cwiseAbs().rowwise().maxCoeff().cwiseMax(x0.cwiseAbs())};
}

/// d x(t1) / d x(t0) by central differences.
inline std::optional<Eigen::MatrixXd> derivative(const ivp::System& system, const Eigen::VectorXd& x,
                                                 double t0, double t1, const Eigen::VectorXd& size) {
  Eigen::MatrixXd d(x.size(), x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    // Far above the oracle's own errors, and small against the solution.
    const double step = 1e-6 * (std::max(std::abs(x[j]), 1e-3 * size[j]) + (size[j] > 0 ? 0 : 1));
    Eigen::VectorXd low = x, high = x;
    low[j] -= step;
    high[j] += step;
    const auto a = end_by(oracles[0], system, low, t0, t1), b = end_by(oracles[0], system, high, t0, t1);
    if (!a || !b) return {};
    d.col(j) = (*b - *a) / (high[j] - low[j]);
  }
  return d;
}

}  // namespace detail

/// One tolerance of each component: with the rounding that steps leave, sixteen units of its size.
[[nodiscard]] inline Eigen::VectorXd one_tolerance(const Eigen::VectorXd& x, const Eigen::VectorXd& size,
                                                   const Tolerances& t) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  return t.absolute + t.relative * x.array().abs() + rounding * size.array();
}

namespace detail {

/// What the problem makes of errors of one tolerance in all components at any of these times: the greatest up
/// to each of them.
inline std::optional<Eigen::MatrixXd> moved(const ivp::System& system, const Eigen::VectorXd& x0,
                                            const Journey& way, const Known& known,
                                            const Tolerances& tolerances) {
  std::vector<Eigen::MatrixXd> made;
  Eigen::MatrixXd most = Eigen::MatrixXd::Zero(known.x.rows(), known.x.cols());
  Eigen::VectorXd x = x0;
  double t = way.t0;
  for (std::size_t k = 0; k < way.times.size(); ++k) {
    const auto d = derivative(system, x, t, way.times[k], known.size);
    if (!d) return {};
    for (Eigen::MatrixXd& error : made) error = (*d * error).eval();
    made.emplace_back(*d * one_tolerance(x, known.size, tolerances).asDiagonal());
    const auto column = static_cast<Eigen::Index>(k);
    for (const Eigen::MatrixXd& error : made)
      most.col(column) = most.col(column).cwiseMax(error.cwiseAbs().rowwise().sum());
    t = way.times[k];
    x = known.x.col(column);
  }
  return most;
}

}  // namespace detail

/// A random initial value problem of a chapter's commands.
struct Question {
  bool second_order = false;  ///< do methods for accelerations fit?
  std::string words;          ///< "--problem duffing --set hardening=3 --initial 1,0"
  Eigen::VectorXd x0;         ///< initial state
  double longest = 100;       ///< time beyond which a run is of no use
  /// The states at the times of a journey; nothing if an oracle does not arrive.
  std::function<std::optional<Known>(const Journey&)> known;
  /// What the problem makes of one tolerance on the way, for each component and time.
  std::function<std::optional<Eigen::MatrixXd>(const Journey&, const Known&, const Tolerances&)> moved;
  /// The end of a run by the library itself; nothing if it fails.
  std::function<std::optional<Eigen::VectorXd>(const ivp::MethodInfo&, const ivp::Settings&, double t0,
                                               double t1)>
      end;
};

namespace detail {

/// A parameter times a factor.
[[nodiscard]] inline double any_parameter(Draw& draw, double value) {
  if (draw.chance(0.4)) value = value * draw.log_uniform(0.1, 10) + (draw.chance(0.1) ? 0.5 : 0);
  return std::max(value, 0.0);
}

/// A random state, or one near the problem's own.
[[nodiscard]] inline Eigen::VectorXd any_state(Draw& draw, Eigen::VectorXd x0, bool keep) {
  for (double& x : x0) {
    if (keep)
      x *= draw.uniform(0.9, 1.1);
    else
      x = draw.chance(0.2) ? 0 : draw.signed_log(1e-3, 3);
  }
  return x0;
}

}  // namespace detail

/// A problem with other parameters and a random initial state.
/// @param keep the initial state near the problem's own: of problems that any state would make meaningless
[[nodiscard]] inline Question question(Draw& draw, const std::string& name, double longest,
                                       bool keep = false) {
  Question q;
  q.words = "--problem " + name;
  q.longest = longest;
  program::Settings values;
  const problems::TextProblem usual(name);
  for (const auto& [parameter, value] : usual.parameters()) {
    values[parameter] = detail::any_parameter(draw, value);
    q.words += fmt::format(" --set {}={:.17g}", parameter, values[parameter]);
  }
  const problems::TextProblem problem(name, values);
  q.x0 = detail::any_state(draw, problem.initial_state(), keep);
  q.words += fmt::format(" --initial {:.17g}", fmt::join(std::vector<double>(q.x0.begin(), q.x0.end()), ","));
  const ivp::System system(problem);
  q.second_order = system.second_order();
  q.known = [system, x0 = q.x0](const Journey& way) { return detail::known(system, x0, way); };
  q.moved = [system, x0 = q.x0](const Journey& way, const Known& k, const Tolerances& t) {
    return detail::moved(system, x0, way, k, t);
  };
  q.end = [system, x0 = q.x0](const ivp::MethodInfo& method, const ivp::Settings& settings, double t0,
                              double t1) -> std::optional<Eigen::VectorXd> {
    const auto run = method.with(settings);
    const auto end = run(system, ivp::State(x0), t0, t1, {}, {.seconds = 5});
    if (!end.status.ok()) return {};
    return Eigen::VectorXd(end.x);
  };
  return q;
}

/// Any problem of the library that is not stiff.
[[nodiscard]] Question any_question(Draw& draw);

/// The name of a method for it that takes a step, or of one that chooses its steps.
[[nodiscard]] std::string any_method(Draw& draw, const Question& question, bool takes_step);

/// Are the oracles and the program there? Else the sentence to skip with.
[[nodiscard]] std::string missing_oracles();

}  // namespace nlmech::adversary
