/// @file
/// Boundary value problem from equations, conditions and a guess given as text.
#pragma once

#include <string>
#include <vector>

#include "nlmech/bvp/problem.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Boundary value problem of Equations between two times, with one condition per component of the state, each
/// on the state at one end. An unknown constant k is a component with k' = 0. All derivatives are exact, by
/// dual numbers.
class TypedBoundary final : public bvp::Problem {
 public:
  /// @param begin conditions at @p from, separated by commas: "x = 0, x' + 2 x = 1"
  /// @param end conditions at @p until
  /// @throws InputError naming the option, for a condition that cannot be read, or too many or too few
  TypedBoundary(program::Equations equations, double from, double until, const std::string& begin,
                const std::string& end);

  /// Names of the components of the state: "x", "x'".
  [[nodiscard]] const std::vector<std::string>& names() const { return equations_.state_names(); }
  /// Initial guess from functions of time: "x = sin(pi t), k = 10". A missing x' is the derivative of a given
  /// x; other missing components are 0.
  /// @throws InputError naming `--guess`, for text that cannot be parsed or that depends on the state
  [[nodiscard]] bvp::Start guess(const std::string& text) const;

  /// See Problem.
  [[nodiscard]] int states() const override { return equations_.size(); }
  /// See Problem: both ends, and the known interior times at which the equations jump, if these are at most
  /// 200.
  [[nodiscard]] std::vector<double> points() const override { return points_; }
  /// First mesh with points where functions of time start to change, as pulses do; empty if there are none.
  [[nodiscard]] std::vector<double> mesh() const;
  /// See Problem.
  void rhs(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p,
           Eigen::VectorXd& dxdt) const override;
  /// See Problem.
  void jacobian(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p, Eigen::MatrixXd& by_state,
                Eigen::MatrixXd& by_parameter) const override;
  /// See Problem.
  void conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::VectorXd& r) const override;
  /// See Problem.
  void condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::MatrixXd& by_ends,
                          Eigen::MatrixXd& by_parameter) const override;

 private:
  [[nodiscard]] program::Program conditions_of(const char* option, const std::string& text);

  program::Equations equations_;
  std::vector<double> points_;
  program::Program slopes_, begin_, end_;
};

}  // namespace nlmech::chapters::rbf_inverse
