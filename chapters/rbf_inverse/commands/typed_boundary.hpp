/// @file
/// A boundary value problem from equations, conditions and a guess as they are typed.
#pragma once

#include <string>
#include <vector>

#include "nlmech/bvp/problem.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Equations of Equations between two times, with as many conditions as the state has components, each on the
/// state at one of the ends. A constant that is not known is an unknown of its own: k' = 0. All derivatives
/// are exact, by dual numbers.
class TypedBoundary final : public bvp::Problem {
 public:
  /// @param begin conditions at @p from, with commas between: "x = 0, x' + 2 x = 1"
  /// @param end the same at @p until
  /// @throws InputError naming the option, for a condition that cannot be read, or too many or too few
  TypedBoundary(program::Equations equations, double from, double until, const std::string& begin,
                const std::string& end);

  /// Components of the state: "x", "x'".
  [[nodiscard]] const std::vector<std::string>& names() const { return equations_.state_names(); }
  /// Functions of the time to begin with: "x = sin(pi t), k = 10". A component that is left out is the
  /// derivative of another one that is not, or else 0.
  /// @throws InputError naming `--guess`, for what cannot be read or depends on the state
  [[nodiscard]] bvp::Start guess(const std::string& text) const;

  /// See Problem.
  [[nodiscard]] int states() const override { return equations_.size(); }
  /// See Problem: both ends, and the known times between at which the equations jump, if there are no more
  /// than 200.
  [[nodiscard]] std::vector<double> points() const override { return points_; }
  /// A first mesh that divides functions of time where they change after a rest, as pulses do; empty if there
  /// is no such place.
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
