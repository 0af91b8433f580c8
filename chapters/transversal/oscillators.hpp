/// @file
/// The driven Duffing oscillators of the chapter, their solutions, and how far a run strays from them.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::transversal {

/// x'' + 2 pi e1 x' + 4 pi^2 e2 (x + x^3) = 4 pi^2 e3 cos 2 pi t: the form of the oscillators in the author's
/// other papers, with e1 = 0.25 and e3 = 0.5. The summary prints neither the equation nor its parameters.
/// @param e2 stiffness
[[nodiscard]] problems::TextProblem stand_in(double e2);

/// A solution in long double.
using Reference = problems::ReferenceTrajectory<long double, problems::TextProblem>;

/// A state at a time.
struct Point {
  double t;      ///< time
  ivp::State x;  ///< position and velocity
  [[nodiscard]] double position() const { return x[0]; }
};

/// What became of a run.
struct Course {
  Status status;              ///< how it ended
  std::vector<Point> points;  ///< all that it computed, the start included
  Statistics work;            ///< what it cost
  double error = 0;           ///< greatest error of the position at its points; infinite if it failed
  double largest = 0;         ///< greatest |x|

  /// None if it failed.
  [[nodiscard]] std::optional<double> finite_error() const {
    return std::isfinite(error) ? std::optional(error) : std::nullopt;
  }
  /// Did the numbers run out?
  [[nodiscard]] bool overflows() const { return status.outcome() == Outcome::non_finite; }
};

/// Runs a method of fixed step from @p x0 at 0 to @p end.
/// @param reference reaches @p end; null: no error
[[nodiscard]] Course course(const problems::TextProblem& problem, const ivp::State& x0, double end,
                            const ivp::NamedIntegrator& method, const Reference* reference);

/// `mtl` with p points and a step, without an estimate, as in the source.
[[nodiscard]] ivp::NamedIntegrator mtl(double step, int points);
/// A method by its name, with a step.
[[nodiscard]] ivp::NamedIntegrator classical(std::string_view name, double step);

}  // namespace nlmech::chapters::transversal
