/// @file
/// The driven Duffing oscillators of the chapter: problems, reference solutions and errors of runs.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::transversal {

/// x'' + 2 pi e1 x' + 4 pi^2 e2 (x + x^3) = 4 pi^2 e3 cos 2 pi t with e1 = 0.25 and e3 = 0.5, the form of the
/// oscillators in the author's other papers. The summary prints neither the equation nor its parameters.
/// @param e2 stiffness
[[nodiscard]] problems::TextProblem stand_in(double e2);

/// Reference solution in long double.
using Reference = problems::ReferenceTrajectory<long double, problems::TextProblem>;

/// A state at a time.
struct Point {
  double t;      ///< time
  ivp::State x;  ///< position and velocity
  [[nodiscard]] double position() const { return x[0]; }
};

/// Result of a run.
struct Course {
  Status status;              ///< outcome of the run
  std::vector<Point> points;  ///< all computed points, the start included
  Statistics work;            ///< work of the run
  double error = 0;           ///< largest error of the position at the points; infinite if the run failed
  double largest = 0;         ///< largest |x|

  /// The error; nothing if the run failed.
  [[nodiscard]] std::optional<double> finite_error() const {
    return std::isfinite(error) ? std::optional(error) : std::nullopt;
  }
  /// Did the run end with a non-finite number?
  [[nodiscard]] bool overflows() const { return status.outcome() == Outcome::non_finite; }
};

/// Runs a fixed-step method from @p x0 at t = 0 to @p end.
/// @param reference solution up to @p end; null: errors are not computed
[[nodiscard]] Course course(const problems::TextProblem& problem, const ivp::State& x0, double end,
                            const ivp::NamedIntegrator& method, const Reference* reference);

/// `mtl` with p points and a fixed step size, without error estimate, as in the source.
[[nodiscard]] ivp::NamedIntegrator mtl(double step, int points);
/// A fixed-step method by name.
[[nodiscard]] ivp::NamedIntegrator classical(std::string_view name, double step);

}  // namespace nlmech::chapters::transversal
