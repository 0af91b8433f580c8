/// @file
/// Solutions that begin where the equations are singular: x'' + 2 x'/t + x = 0 from t = 0.
#pragma once

#include <Eigen/Core>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// A polynomial in time for the state.
class StatePolynomial final : public DenseOutput {
 public:
  /// None.
  StatePolynomial() = default;
  /// On [t0, t0 + h] through @p values, one a column, at t0 + h times @p nodes, which ascend from 0 to 1.
  StatePolynomial(double t0, double h, Eigen::VectorXd nodes, Nodes values);
  /// The state at @p t.
  void at(double t, State& x) const override;
  /// t0 + h.
  [[nodiscard]] double end() const { return t0_ + h_; }
  /// The state there.
  [[nodiscard]] State last() const { return values_.rightCols(1); }

 private:
  double t0_ = 0, h_ = 0;
  Eigen::VectorXd nodes_, weights_;
  Nodes values_;
};

/// The first part of a solution that begins at a regular singular point: t0 + h with f = g(t, x)/(t - t0), g
/// analytic and g(t0, x0) = 0. The power series about t0 is found as the polynomial of degree 16 that meets
/// the equations at the sixteen right Radau points of the interval, none of which is t0, by Newton's
/// iteration; the interval is halved until the polynomial meets them between these points to a relative 1e-12
/// of f, and then divided by four.
///
/// @param series becomes the polynomial, from t0 to a time that is not beyond t1
/// @return `outside_validity` with the reason if there is none: the initial values do not fit, several
/// solutions begin with them (an eigenvalue of lim (t - t0) df/dx is positive), or the singularity is of
/// another kind
[[nodiscard]] Status begin_at_singular_point(const System& system, const State& x0, double t0, double t1,
                                             StatePolynomial& series);

}  // namespace nlmech::ivp
