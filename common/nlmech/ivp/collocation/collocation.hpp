/// @file
/// Collocation in time, step by step: radial basis functions (the dissertation's RBF-Coll) and their
/// polynomial limit.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/collocation/basis.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

/// Newton's iteration as collocation uses it. Rounding in the derivative matrix sets a floor under the
/// updates; an iteration that stalls on it, below `noise`, is done.
inline constexpr algebraic::Newton collocation_newton = {.tolerance = 1e-12, .noise = 1e-6, .iterations = 50};

/// RBF-Coll (Elgohary 2015, section 4.2, Eqs 4.12-4.16): in each step the state is a sum of radial basis
/// functions centred at N nodes; the equations hold at all nodes but the first, where the state is known. All
/// unknowns at once by Newton's iteration with exact Jacobian, from the constant state.
/// A fixed step has no error estimate: past a pole of the solution, or across a jump much shorter than the
/// step, Newton's iteration may find a root of the step's equations that is no solution of the problem. The
/// truncation error and the condition of the basis pull the shape in opposite directions: in double precision
/// errors below about 1e-8 are not to be had; PolynomialCollocation has no such floor.
///
/// Tests hold it to its polynomial limit for c h = 0.1 (3 %), and to a status, not a number, at both ends of
/// the shape.
struct RbfCollocation {
  static constexpr std::string_view name = "rbf-coll";  ///< on command lines and in tables
  double step = 0.1;                                    ///< length of a step, positive
  int nodes = 7;                                        ///< N, from 2 to 200
  /// c in 1/time (Eq. 4.8); 0 for the dissertation's rule (N - 1) / (4 step). A shortened step keeps c times
  /// its length, and with it the condition of the basis.
  double shape = 0;
  collocation::Kernel kernel = collocation::Kernel::gaussian;  ///< which radial function (Eq. 4.8)
  collocation::NodeFamily points =
      collocation::NodeFamily::legendre_gauss_lobatto;  ///< where the nodes stand
  collocation::Inversion inversion =
      collocation::Inversion::solve;              ///< how the derivative matrix is formed (Eq. 4.15)
  algebraic::Newton newton = collocation_newton;  ///< the iteration for a step's equations
};

/// The limit c -> 0 of RbfCollocation: polynomials through the same nodes, formed without loss of digits.
/// With Legendre-Gauss-Lobatto nodes an implicit Runge-Kutta method of N - 1 stages and order N - 1, not
/// A-stable; with the left end and Radau nodes Radau IIA of order 2 N - 3, L-stable.
///
/// Tests hold it to the orders N - 1 and 2 N - 3 for 3 to 6 nodes (observed within 0.1 to 0.25), to
/// polynomials of its degree, which it solves to rounding, and to known growth at the instability window of
/// Lobatto nodes (2e-4).
struct PolynomialCollocation {
  static constexpr std::string_view name = "polynomial-coll";   ///< the family; messages name the nodes
  static constexpr std::string_view lobatto_name = "lgl-coll";  ///< on command lines, with Lobatto nodes
  static constexpr std::string_view radau_name = "radau-coll";  ///< with the left end and Radau nodes
  double step = 0.1;                                            ///< length of a step, positive
  int nodes = 7;                                                ///< N, from 2 to 200
  collocation::NodeFamily points =
      collocation::NodeFamily::legendre_gauss_lobatto;  ///< where the nodes stand
  algebraic::Newton newton = collocation_newton;        ///< the iteration for a step's equations
};

/// One step: the states at nodes 2..N from the state at node 1.
template <SystemLike S>
class CollocationStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;   ///< components of the state
  static constexpr bool has_nodes = true;  ///< nodes 2..N

  /// @param system outlives the stepper
  /// @param basis on the unit interval, the first node at its begin
  /// @param newton the iteration for a step's equations
  /// @param name the method's, for messages
  CollocationStepper(const S& system, collocation::Basis basis, const algebraic::Newton& newton,
                     std::string_view name)
      : Stepper<n>(system.size()),
        system_(system),
        basis_(std::move(basis)),
        newton_(newton),
        name_(name),
        inner_(basis_.nodes().size() - 1),
        unknowns_(inner_ * system.size()),
        work_(inner_ * system.size()),
        derivatives_(system.size(), inner_),
        node_(system.size()),
        x0_(system.size()),
        jacobian_(system.size(), system.size()) {
    this->times_.resize(static_cast<std::size_t>(inner_));
    asked_.resize(this->times_.size());
    this->states_.resize(system.size(), inner_);
  }

  /// The method's.
  [[nodiscard]] std::string_view name() const { return name_; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// From t to t + h.
  Status step(double t, double h, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    t0_ = t;
    h_ = h;
    x0_ = x0;
    for (Eigen::Index k = 0; k < inner_; ++k) {
      const auto i = static_cast<std::size_t>(k);
      this->times_[i] = k + 1 == inner_ ? t + h : t + h * basis_.nodes()[k + 1];
      asked_[i] = segment_(this->times_[i]);
    }
    matrix(unknowns_).colwise() = x0;
    const std::int64_t before = statistics.newton_iterations;
    const Outcome outcome = algebraic::solve(
        newton_, [&](const Eigen::VectorXd& x, Eigen::VectorXd& f) { residual(x, f, statistics); },
        [&](const Eigen::VectorXd& x, Eigen::MatrixXd& j) { derivative(x, j); }, unknowns_, work_,
        statistics);
    this->states_ = matrix(unknowns_);
    x1 = this->states_.col(inner_ - 1);
    if (outcome == Outcome::success) return {};
    return step_not_solved(name_, outcome, t, h, static_cast<int>(statistics.newton_iterations - before));
  }

  /// The trial function itself.
  void at(double t, State<n>& x) const override {
    const Eigen::VectorXd row = basis_.row((t - t0_) / h_);
    x = row[0] * x0_;
    for (Eigen::Index k = 0; k < inner_; ++k) x += row[k + 1] * this->states_.col(k);
  }

 private:
  // States at the nodes as columns: unknowns are ordered node by node.
  auto matrix(Eigen::VectorXd& x) const { return Eigen::Map<Nodes<n>>(x.data(), x0_.size(), inner_); }
  auto matrix(const Eigen::VectorXd& x) const {
    return Eigen::Map<const Nodes<n>>(x.data(), x0_.size(), inner_);
  }

  //! [collocation residual]
  // Eq. 4.16 times h: D x - h g at nodes 2..N, D on the unit interval.
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f, Statistics& statistics) {
    const auto& d = basis_.derivative();
    this->states_ = matrix(x);
    system_.rhs(asked_, this->states_, derivatives_);
    statistics.right_hand_sides += inner_;
    auto out = matrix(f);
    out.noalias() = this->states_ * d.bottomRightCorner(inner_, inner_).transpose();
    out.noalias() += x0_ * d.col(0).tail(inner_).transpose();
    out -= h_ * derivatives_;
  }
  //! [collocation residual]

  void derivative(const Eigen::VectorXd& x, Eigen::MatrixXd& j) {
    const auto& d = basis_.derivative();
    const Eigen::Index m = x0_.size();
    j.setZero();
    for (Eigen::Index row = 0; row < inner_; ++row) {
      for (Eigen::Index column = 0; column < inner_; ++column)
        j.block(row * m, column * m, m, m).diagonal().setConstant(d(row + 1, column + 1));
      node_ = x.segment(row * m, m);
      system_.jacobian(asked_[static_cast<std::size_t>(row)], node_, jacobian_);
      j.block(row * m, row * m, m, m) -= h_ * jacobian_;
    }
  }

  const S& system_;
  collocation::Basis basis_;
  algebraic::Newton newton_;
  std::string_view name_;
  Eigen::Index inner_;
  SmoothSegment segment_;
  std::vector<double> asked_;  // times at which f is asked for
  Eigen::VectorXd unknowns_;
  algebraic::Workspace<Eigen::VectorXd, Eigen::MatrixXd> work_;
  Nodes<n> derivatives_;
  State<n> node_, x0_;
  Jacobian<n> jacobian_;
  double t0_ = 0, h_ = 1;
};

/// What messages call a method.
[[nodiscard]] constexpr std::string_view name_of(const RbfCollocation& /*method*/) {
  return RbfCollocation::name;
}
/// The name of its nodes on command lines, "lgl-coll" or "radau-coll"; "polynomial-coll" with others.
[[nodiscard]] constexpr std::string_view name_of(const PolynomialCollocation& method) {
  switch (method.points) {
    case collocation::NodeFamily::legendre_gauss_lobatto: return PolynomialCollocation::lobatto_name;
    case collocation::NodeFamily::left_end_and_radau: return PolynomialCollocation::radau_name;
    default: return PolynomialCollocation::name;
  }
}

/// The basis of a method. @throws std::invalid_argument for options out of range
[[nodiscard]] collocation::Basis basis_of(const RbfCollocation& method);
/// The basis of a method. @throws std::invalid_argument for options out of range
[[nodiscard]] collocation::Basis basis_of(const PolynomialCollocation& method);

namespace detail {
template <SystemLike S, class Method>
[[nodiscard]] Solution<S::dimension> collocate(const Task<S>& task, const Method& method) {
  require_step(name_of(method), method.step);
  collocation::Basis basis = basis_of(method);
  if (!basis.status().ok()) return {task.t0, task.x0, basis.status(), {}};
  CollocationStepper<S> stepper(task.system, std::move(basis), method.newton, name_of(method));
  return walk(task, method.step, stepper);
}
}  // namespace detail

/// Runs RbfCollocation.
template <SystemLike S>
struct Integrator<S, RbfCollocation> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const RbfCollocation& method) {
    return detail::collocate(task, method);
  }
};

/// Runs PolynomialCollocation.
template <SystemLike S>
struct Integrator<S, PolynomialCollocation> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const PolynomialCollocation& method) {
    return detail::collocate(task, method);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<RbfCollocation> = InLibrary::all;
template <>
inline constexpr InLibrary in_library<PolynomialCollocation> = InLibrary::all;
/// @endcond

}  // namespace nlmech::ivp
