/// @file
/// Solutions that start at a singular point of the equations: x'' + 2 x'/t + x = 0 from t = 0.
#pragma once

#include <Eigen/Core>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// State as a polynomial in time.
class StatePolynomial final : public DenseOutput {
 public:
  /// Without values.
  StatePolynomial() = default;
  /// Polynomial on [t0, t0 + h] through the columns of @p values at t0 + h times @p nodes (ascending, from 0
  /// to 1).
  StatePolynomial(double t0, double h, Eigen::VectorXd nodes, Nodes values);
  /// The state at @p t.
  void at(double t, State& x) const override;
  /// t0 + h.
  [[nodiscard]] double end() const { return t0_ + h_; }
  /// The state at end().
  [[nodiscard]] State last() const { return values_.rightCols(1); }

 private:
  double t0_ = 0, h_ = 0;
  Eigen::VectorXd nodes_, weights_;
  Nodes values_;
};

/// First part, to t0 + h, of a solution that starts at a regular singular point: f = g(t, x)/(t - t0), g
/// analytic and g(t0, x0) = 0. Newton's iteration finds the polynomial of degree 16 that satisfies the
/// equations at the sixteen right Radau points of the interval, none of which is t0. The interval is halved
/// until the polynomial satisfies them between these points to a relative 1e-12, and then divided by four.
///
/// @param series receives the polynomial, from t0 to a time not beyond t1
/// @return `outside_validity` with the reason if there is no such polynomial: the initial values are
/// inconsistent, several solutions start from them (an eigenvalue of lim (t - t0) df/dx is positive), the
/// singularity is of another kind, or there are more than 60 components
[[nodiscard]] Status begin_at_singular_point(const System& system, const State& x0, double t0, double t1,
                                             StatePolynomial& series);

}  // namespace nlmech::ivp
