/// @file
/// Equilibrium equations of a loaded structure for the algebraic solvers.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/frames/loaded_frame.hpp"

namespace nlmech::frames {

/// F(x) = dU/dx - W q for a frame under the load W q; V = U - W q^T x. B is sparse.
class Equilibrium : public algebraic::Potential {
 public:
  /// @param frame the structure; must outlive this object
  /// @param direction q, forces on the unknowns for W = 1
  /// @param load W
  /// @param coupling `as_printed` uses the misprinted Eq. 2.35 in B, to show its effect; F is unchanged
  /// @throws std::invalid_argument if q has another size than the frame, or q or W is not finite
  Equilibrium(const Frame& frame, Eigen::VectorXd direction, double load,
              Coupling coupling = Coupling::consistent);

  /// W.
  [[nodiscard]] double load() const { return load_; }
  /// Another W.
  void set_load(double load) { load_ = load; }
  /// q.
  [[nodiscard]] const Eigen::VectorXd& direction() const { return loaded_.load(); }
  /// The structure.
  [[nodiscard]] const Frame& frame() const { return loaded_.frame(); }

  [[nodiscard]] Eigen::Index size() const override { return loaded_.size(); }
  /// See Equations; f is also not finite where the frame reports a failure other than `wrong_branch`.
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override;
  void linearise(const Eigen::VectorXd& x) override;
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    out.noalias() = *loaded_.sparse() * v;
  }
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    out.noalias() = loaded_.sparse()->transpose() * v;
  }
  void matrix(Eigen::MatrixXd& b) const override { loaded_.matrix(b); }
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return loaded_.sparse(); }
  /// Status of the frame at the last evaluation.
  [[nodiscard]] Status status() const override { return status_; }
  [[nodiscard]] double energy(const Eigen::VectorXd& x) override;

 private:
  LoadedFrame loaded_;
  double load_;
  Status status_;
};

/// Williams' equation (2.21) for one unknown, the drop delta of the apex: F = (W(delta) - W)/2, whose
/// potential is the integral of F from 0 to delta. F is not finite at and past the pole of d_5.
class WilliamsEquilibrium : public algebraic::Potential {
 public:
  /// @throws std::invalid_argument if a number of the toggle is not positive or the load is not finite
  WilliamsEquilibrium(const Williams& toggle, double load);

  /// W.
  [[nodiscard]] double load() const { return load_; }
  /// Another W.
  void set_load(double load) { load_ = load; }
  /// The toggle.
  [[nodiscard]] const Williams& toggle() const { return loaded_.toggle(); }

  /// 1
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override;
  void linearise(const Eigen::VectorXd& x) override { loaded_.linearise(x, load_); }
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override { out = loaded_.slope() * v; }
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    out = loaded_.slope() * v;
  }
  void matrix(Eigen::MatrixXd& b) const override { loaded_.matrix(b); }
  /// Failure past the pole of d_5.
  [[nodiscard]] Status status() const override { return status_; }
  /// See Potential; by Gauss-Kronrod quadrature, to a few rounding errors of its largest part.
  [[nodiscard]] double energy(const Eigen::VectorXd& x) override;

 private:
  LoadedWilliams loaded_;
  double load_;
  Status status_;
};

}  // namespace nlmech::frames
