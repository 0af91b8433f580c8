/// @file
/// The printed method with half of its unknowns: those that a linear equation gives are eliminated.
#pragma once

#include <vector>

#include "nlmech/bvp/optimal_control/printed.hpp"

namespace nlmech::bvp {

/// The equations of a GlobalCollocation after elimination of x_m = (D x_k)/a at every node at which the row
/// of x_k is not replaced. All equations in which x_m is left are linear in it, so that Newton's iteration
/// takes the same steps in the other unknowns, and they do not depend on the start's x_m. For the Duffing
/// cases, x1' = x2 and lambda2' = -lambda1, half of the unknowns go, and a step costs a sixth.
class CondensedCollocation final : public algebraic::Equations {
 public:
  /// @param problem that of the equations
  /// @param equations outlive the condensed ones, and are used by them
  /// @param linear at most one equation for each unknown
  /// @throws std::invalid_argument if an equation is not of that form, judged at three states
  CondensedCollocation(const Problem& problem, GlobalCollocation& equations,
                       const std::vector<LinearEquation>& linear);

  /// The unknowns that remain, out of all.
  [[nodiscard]] Eigen::VectorXd reduced(const Eigen::VectorXd& all) const { return all(kept_); }
  /// All unknowns, the eliminated ones from the others.
  [[nodiscard]] Eigen::VectorXd expanded(const Eigen::VectorXd& some) const;

  /// See Equations.
  [[nodiscard]] Eigen::Index size() const override { return static_cast<Eigen::Index>(kept_.size()); }
  /// See Equations.
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override;
  /// See Equations.
  void linearise(const Eigen::VectorXd& x) override;
  /// See Equations.
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override { out = matrix_ * v; }
  /// See Equations.
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    out = matrix_.transpose() * v;
  }
  /// See Equations.
  void matrix(Eigen::MatrixXd& b) const override { b = matrix_; }
  /// See Equations.
  [[nodiscard]] Status status() const override { return equations_.status(); }

 private:
  GlobalCollocation& equations_;
  std::vector<Eigen::Index> kept_, gone_;        // unknowns
  std::vector<Eigen::Index> rows_, eliminated_;  // equations
  Eigen::MatrixXd by_kept_;                      // eliminated unknowns by the others
  Eigen::MatrixXd through_gone_;                 // what elimination adds to the matrix
  Eigen::MatrixXd matrix_;
};

}  // namespace nlmech::bvp
