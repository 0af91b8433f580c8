#include "nlmech/ivp/transversal/mtl.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/transversal/mtl_weights.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::ivp {

std::string_view to_string(MtlLinear linear) {
  switch (linear) {
    case MtlLinear::given: return "given";
    case MtlLinear::zero: return "zero";
    case MtlLinear::jacobian: break;
  }
  return "jacobian";
}

void check_options(const Mtl& method) {
  require_step(Mtl::name, method.step);
  require_within(Mtl::name, "points", method.points, 1, 8);
  if (!(method.width >= 2))
    throw invalid_argument("mtl: the width of the basis functions must be 2 steps or more, not {}",
                           method.width);
  if (!(method.error_tolerance >= 0) || !std::isfinite(method.error_tolerance))
    throw invalid_argument(
        "mtl: the error tolerance must be positive and finite, or 0 for no estimate, not {}",
        method.error_tolerance);
}

namespace {

Status mtl_overflow(double t, double h, Eigen::Index steps) {
  return failed_with(Outcome::non_finite,
                     "mtl: the exponential of the linear part overflows over {} steps of {:.6g} from t = "
                     "{:.17g}; take a smaller step or tolerance (a program can choose another linear part)",
                     steps, h, t);
}

Status mtl_wrong_branch(double t, double h, Eigen::Index steps, double estimate, double allowed) {
  return failed_with(Outcome::wrong_branch,
                     "mtl: the equations of {} steps of {:.6g} from t = {:.17g} were solved, but between "
                     "them the error is estimated as {:.2g}, above {:.2g}: the states may lie on "
                     "another branch; take a smaller step, or a tolerance instead",
                     steps, h, t, estimate, allowed);
}

// The linear part A and the harmonic loads.
program::LinearTerms linear_terms(const System& system, MtlLinear linear) {
  program::LinearTerms terms = system.linear_terms();
  if (linear != MtlLinear::given) terms.a.setZero();
  if (system.second_order()) terms.a.topRightCorner(system.size() / 2, system.size() / 2).setIdentity();
  return terms;
}

/// Stepper of one block of p steps.
class MtlStepper : public Stepper {
 public:
  static constexpr bool has_nodes = true;  ///< the points 1..p

  /// @param system outlives the stepper
  /// @param method checked options
  MtlStepper(const System& system, const Mtl& method)
      : MtlStepper(system, method, linear_terms(system, method.linear)) {}
  MtlStepper(const System& system, const Mtl& method, const program::LinearTerms& terms)
      : Stepper(system.size()),
        system_(system),
        method_(method),
        p_(method.points),
        a_(terms.a),
        weights_(system.size(), columns(system), method.basis, method.points, terms.load, method.width),
        unknowns_(p_ * system.size()),
        work_(p_ * system.size()),
        free_(system.size(), p_ + 1),
        g_(columns(system), p_ + 1),
        phases_(weights_.flow().phase_count(), p_ + 1),
        phase_(phases_.rows()),
        slopes_(static_cast<std::size_t>(p_), Eigen::MatrixXd::Zero(columns(system), system.size())),
        missing_(columns(system)),
        x0_(State::Zero(system.size())),
        node_(x0_),
        answer_(x0_),
        f_(x0_),
        jacobian_(system.size(), system.size()),
        lu_(system.size()) {
    this->times_.resize(static_cast<std::size_t>(p_));
    this->states_.resize(system.size(), p_);
  }
  /// Name of the method.
  [[nodiscard]] static std::string_view name() { return Mtl::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// Integrates from t to t + block: p steps at once.
  Status step(double t, double block, const State& x0, State& x1, Statistics& statistics) {
    const double h = block / static_cast<double>(p_);
    if (Outcome outcome = prepare(t, h, x0, statistics); outcome != Outcome::success)
      return mtl_overflow(t, h, p_);
    const std::int64_t before = statistics.newton_iterations;
    Outcome outcome = solve(true, statistics);
    if (outcome != Outcome::success) {
      ++statistics.fallbacks;  // rare: the other initial guess
      outcome = solve(false, statistics);
    }
    if (outcome != Outcome::success)
      return step_not_solved(Mtl::name, outcome, t, h,
                             static_cast<int>(statistics.newton_iterations - before));
    // Updates the nonlinear terms to first order for the last change of the states.
    for (Eigen::Index k = 1; k <= p_; ++k)
      g_.col(k).noalias() -= slope(k) * work_.update.segment((k - 1) * size(), size());
    this->states_ = Eigen::Map<const Nodes>(unknowns_.data(), size(), p_);
    x1 = this->states_.col(p_ - 1);
    return method_.error_tolerance > 0 ? check_error_estimate(t, statistics) : Status();
  }

  /// Dense output: the linearised solution.
  void at(double t, State& x) const override {
    const auto j = std::clamp(static_cast<Eigen::Index>(std::floor((t - t0_) / h_)), Eigen::Index{0}, p_ - 1);
    const bool at_next = t == time(j + 1);  // rounding may have put it before
    x = point(at_next ? j + 1 : j);
    const double tau = t - time(j);
    if (at_next || tau == 0 || weights_.prepare_between(a_, tau) != Outcome::success) return;
    f_ = x;
    weights_.between(j, g_, f_, phases_.col(j), x);
  }

 private:
  static int columns(const System& system) {
    return system.second_order() ? system.size() / 2 : system.size();
  }
  [[nodiscard]] Eigen::Index size() const { return x0_.size(); }
  [[nodiscard]] double time(Eigen::Index k) const {
    return k == 0 ? t0_ : this->times_[static_cast<std::size_t>(k - 1)];
  }
  [[nodiscard]] Eigen::Map<const Eigen::VectorXd> point(Eigen::Index k) const {
    return Eigen::Map<const Eigen::VectorXd>(k == 0 ? x0_.data() : unknowns_.data() + (k - 1) * size(),
                                             size());
  }
  [[nodiscard]] Eigen::MatrixXd& slope(Eigen::Index k) { return slopes_[static_cast<std::size_t>(k - 1)]; }

  // Computes everything that does not depend on the unknowns.
  Outcome prepare(double t, double h, const State& x0, Statistics& statistics) {
    x0_ = x0;
    t0_ = t;
    for (Eigen::Index k = 0; k <= p_; ++k) {
      if (k > 0) this->times_[static_cast<std::size_t>(k - 1)] = t + static_cast<double>(k) * h;
      weights_.flow().phases(time(k), phase_);
      phases_.col(k) = phase_;
    }
    if (h != h_ || method_.linear == MtlLinear::jacobian) {
      if (method_.linear == MtlLinear::jacobian) {
        system_.jacobian(segment_(t), x0, a_);
        ++statistics.jacobians;
      }
      h_ = 0;  // in case of a failure
      if (const Outcome outcome = weights_.compute(a_, h); outcome != Outcome::success) return outcome;
      h_ = h;
    }
    weights_.free_motion(x0_, phases_, free_);
    nonlinear(0, statistics);
    return Outcome::success;
  }

  // g(t_k, x_k): f without the linear part and the load.
  void nonlinear(Eigen::Index k, Statistics& statistics) {
    node_ = point(k);
    system_.rhs(segment_(time(k)), node_, f_);
    ++statistics.right_hand_sides;
    f_.noalias() -= a_ * node_;
    f_.noalias() -= weights_.flow().load() * phases_.col(k);
    g_.col(k) = f_.tail(g_.rows());
  }

  // Newton's iteration. Initial guess: the motion with constant g (@p moving), or the constant first state.
  Outcome solve(bool moving, Statistics& statistics) {
    for (Eigen::Index l = 1; l <= p_; ++l) {
      auto x = unknowns_.segment((l - 1) * size(), size());
      x = x0_;
      if (!moving) continue;
      x = free_.col(l);
      for (Eigen::Index k = 0; k <= p_; ++k) x.noalias() += weights_.weight(l, k) * g_.col(0);
    }
    return algebraic::solve(
        method_.newton, [&](const Eigen::VectorXd& x, Eigen::VectorXd& r) { residual(x, r, statistics); },
        [&](const Eigen::VectorXd& x, Eigen::MatrixXd& j) { derivative(x, j); }, unknowns_, work_,
        statistics);
  }

  //! [mtl residual]
  // Eq. 5: x_l - exp(A l h) x_0 - r_l - sum over k of W_lk g_k.
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& r, Statistics& statistics) {
    for (Eigen::Index k = 1; k <= p_; ++k) nonlinear(k, statistics);
    r = x;
    for (Eigen::Index l = 1; l <= p_; ++l) {
      auto part = r.segment((l - 1) * size(), size());
      part -= free_.col(l);
      for (Eigen::Index k = 0; k <= p_; ++k) part.noalias() -= weights_.weight(l, k) * g_.col(k);
    }
  }
  //! [mtl residual]

  void derivative(const Eigen::VectorXd& /*x is unknowns_*/, Eigen::MatrixXd& j) {
    j.setIdentity();
    for (Eigen::Index k = 1; k <= p_; ++k) {
      node_ = point(k);
      system_.jacobian(segment_(time(k)), node_, jacobian_);
      jacobian_ -= a_;
      slope(k) = jacobian_.bottomRows(g_.rows());
      for (Eigen::Index l = 1; l <= p_; ++l)
        j.block((l - 1) * size(), (k - 1) * size(), size(), size()).noalias() -=
            weights_.weight(l, k) * slope(k);
    }
  }

  // Checks the error estimate against Mtl::error_tolerance.
  Status check_error_estimate(double t, Statistics& statistics) {
    double worst = 0;
    if (weights_.prepare_between(a_, h_ / 2) != Outcome::success) return mtl_overflow(t, h_, p_);
    for (Eigen::Index j = 0; j < p_; ++j) {
      weights_.between(j, g_, point(j), phases_.col(j), node_);
      const double middle = segment_(time(j) + h_ / 2);
      system_.rhs(middle, node_, f_);
      system_.jacobian(middle, node_, jacobian_);
      ++statistics.right_hand_sides;
      ++statistics.jacobians;
      weights_.flow().phases(middle, phase_);
      f_.noalias() -= a_ * node_;
      f_.noalias() -= weights_.flow().load() * phase_;
      weights_.interpolate(j, g_, missing_);
      f_.tail(missing_.size()) -= missing_;
      f_ *= h_;
      if (system_.second_order()) f_.head(size() - missing_.size()).setZero();
      jacobian_ *= -h_;
      jacobian_.diagonal().array() += 1;
      if (jacobian_.allFinite() && f_.allFinite()) {
        lu_.compute(jacobian_);
        lu_.solve(f_, answer_);
        f_ = answer_;
      }
      const double error = algebraic::detail::length_of_update(f_, node_);
      if (!(error <= worst)) worst = error;
    }
    if (worst <= method_.error_tolerance) return {};
    return mtl_wrong_branch(t, h_, p_, worst, method_.error_tolerance);
  }

  const System& system_;
  Mtl method_;
  Eigen::Index p_;
  Jacobian a_;
  mutable MtlWeights weights_;  // at() uses its workspace
  SmoothSegment segment_;
  Eigen::VectorXd unknowns_;  // states at the points 1..p
  algebraic::Workspace<Eigen::VectorXd> work_;
  Eigen::MatrixXd free_, g_, phases_;
  Eigen::VectorXd phase_;
  std::vector<Eigen::MatrixXd> slopes_;  // dg/dx at the points
  Eigen::VectorXd missing_;
  State x0_, node_, answer_;
  mutable State f_;
  Jacobian jacobian_;
  algebraic::DenseLu<double> lu_;
  double t0_ = 0, h_ = 0;
};

}  // namespace

Solution run(const InitialValueProblem& problem, const Mtl& method) {
  check_options(method);
  MtlStepper stepper(problem.system, method);
  return integrate_fixed_steps(problem, method.step * method.points, stepper, method.points);
}

}  // namespace nlmech::ivp
