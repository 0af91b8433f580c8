#include "nlmech/ivp/collocation/collocation.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

collocation::Basis basis_of(const RbfCollocation& method) {
  if (!(method.shape >= 0) || !std::isfinite(method.shape))
    throw std::invalid_argument(fmt::format(
        "rbf-coll: the shape must be positive and finite, or 0 for the rule, not {}", method.shape));
  const double relative = method.shape == 0 ? (method.nodes - 1) / 4.0 : method.shape * method.step;
  return collocation::Basis::radial(method.points, method.nodes, method.kernel, relative, method.inversion);
}

collocation::Basis basis_of(const PolynomialCollocation& method) {
  return collocation::Basis::polynomial(method.points, method.nodes);
}

namespace {

/// One step: the states at nodes 2..N from the state at node 1.
class CollocationStepper : public Stepper {
 public:
  static constexpr bool has_nodes = true;  ///< nodes 2..N

  /// @param system outlives the stepper
  /// @param basis on the unit interval, the first node at its start
  /// @param newton the iteration for a step's equations
  /// @param name of the method, for messages
  CollocationStepper(const System& system, collocation::Basis basis, const algebraic::Newton& newton,
                     std::string_view name)
      : Stepper(system.size()),
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

  /// Name of the method.
  [[nodiscard]] std::string_view name() const { return name_; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// Integrates from t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
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

  /// Dense output: the trial function.
  void at(double t, State& x) const override {
    const Eigen::VectorXd row = basis_.row((t - t0_) / h_);
    x = row[0] * x0_;
    for (Eigen::Index k = 0; k < inner_; ++k) x += row[k + 1] * this->states_.col(k);
  }

 private:
  // States at the nodes as columns: unknowns are ordered node by node.
  Eigen::Map<Nodes> matrix(Eigen::VectorXd& x) const {
    return Eigen::Map<Nodes>(x.data(), x0_.size(), inner_);
  }
  Eigen::Map<const Nodes> matrix(const Eigen::VectorXd& x) const {
    return Eigen::Map<const Nodes>(x.data(), x0_.size(), inner_);
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

  const System& system_;
  collocation::Basis basis_;
  algebraic::Newton newton_;
  std::string_view name_;
  Eigen::Index inner_;
  SmoothSegment segment_;
  std::vector<double> asked_;  // times at which f is evaluated
  Eigen::VectorXd unknowns_;
  algebraic::Workspace<Eigen::VectorXd> work_;
  Nodes derivatives_;
  State node_, x0_;
  Jacobian jacobian_;
  double t0_ = 0, h_ = 1;
};

template <class Method>
[[nodiscard]] Solution collocate(const InitialValueProblem& problem, const Method& method) {
  require_step(name_of(method), method.step);
  collocation::Basis basis = basis_of(method);
  if (!basis.status().ok()) return {problem.t0, problem.x0, basis.status(), {}};
  CollocationStepper stepper(problem.system, std::move(basis), method.newton, name_of(method));
  return integrate_fixed_steps(problem, method.step, stepper);
}

}  // namespace

Solution run(const InitialValueProblem& problem, const RbfCollocation& method) {
  return collocate(problem, method);
}

Solution run(const InitialValueProblem& problem, const PolynomialCollocation& method) {
  return collocate(problem, method);
}

}  // namespace nlmech::ivp
