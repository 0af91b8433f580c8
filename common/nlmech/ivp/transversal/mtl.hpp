/// @file
/// Multi-step transversal linearisation (Roy): the linear part exact, the rest interpolated over p steps.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/transversal/mtl_weights.hpp"

namespace nlmech::ivp {

/// What Mtl solves exactly; the rest of the right-hand side is interpolated. All lead to the same order.
enum class MtlLinear {
  given,    ///< the problem's `linear_part`; zero if it names none
  zero,     ///< nothing (x'' = 0 for a problem with accelerations): collocation at equidistant points
  jacobian  ///< df/dx at the begin of each block of p steps: for stiff problems, whose own linear part may
            ///< grow where solutions do not. Costs an exponential a block, and the time symmetry
};

/// "given", "zero", "jacobian".
[[nodiscard]] std::string_view to_string(MtlLinear linear);

/// Newton's iteration as Mtl uses it.
inline constexpr algebraic::Newton mtl_newton = {.tolerance = 1e-12, .noise = 1e-8, .iterations = 50};

/// Multi-step transversal linearisation (D. Roy, A multi-step transversal linearization method in nonlinear
/// dynamics, extended summary). Over p steps of length h the equation x' = A x + g(t, x) + load is replaced
/// by
///
///     y' = A y + sum over k = 0..p of g(t_k, x_k) phi_k(t) + load                          (Eqs 3, 4)
///
/// and the states at t_1..t_p are those for which y(t_l) = x_l (Eq. 5): p n equations, solved by Newton's
/// iteration with the exact Jacobian. Harmonics that the problem names in `load` are solved exactly; linear
/// problems are exact to rounding for every h. For problems with accelerations A = [0 1; -K -C] and g acts on
/// the velocities. Order: mtl_order().
///
/// With a fixed A symmetric in time, so that energies of oscillators do not drift; not symplectic. Not
/// L-stable. A step too long for the problem may be solved by states that lie on no solution; the estimate
/// of error_tolerance turns that into a status.
/// Dense output: y itself, and exact on linear problems; within a block it is of the order p + 1, as its
/// inner points are.
///
/// Tests hold it to mtl_order() (observed within 0.12), linear problems to rounding for steps of every
/// length, its symmetry to 1e4 eps, and the bound of the energy error to a recorded one (4 %).
struct Mtl {
  static constexpr std::string_view name = "mtl";  ///< on command lines and in tables
  double step = 0.1;                               ///< h, distance of the points, positive
  int points = 3;                                  ///< p, from 1 to 8
  MtlBasis basis = MtlBasis::lagrange;             ///< phi_k
  MtlLinear linear = MtlLinear::given;             ///< A
  /// Ends with `wrong_branch` where the estimated error of a block, max |e_i|/(1 + |x_i|), is greater: with
  /// the default where nothing of the states is right. 0: no estimate, as in the source. y is put into the
  /// equation midway between the points; what is missing there, times h and through (1 - h df/dx)^-1, is the
  /// estimate, of order h^(p+2).
  double error_tolerance = 0.1;
  algebraic::Newton newton = mtl_newton;  ///< the iteration for a block's equations
};

/// @throws std::invalid_argument naming the option that is out of range
void check_options(const Mtl& method);

namespace detail {
/// Failure of a block whose linear part overflows.
[[nodiscard]] Status mtl_overflow(double t, double block);
/// Failure of a block whose estimate is above what is allowed.
[[nodiscard]] Status mtl_wrong_branch(double t, double block, double estimate, double allowed);
/// @throws std::invalid_argument for a linear part or a load that is not finite, or that does not act on the
/// velocities of a problem with accelerations
void check_split(const Eigen::Ref<const Eigen::MatrixXd>& a, std::span<const Harmonic> load,
                 bool second_order);
}  // namespace detail

/// One block of p steps.
template <SystemLike S>
class MtlStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;   ///< components of the state
  static constexpr bool has_nodes = true;  ///< the points 1..p

  /// @param system outlives the stepper
  /// @param method checked options
  /// @throws std::invalid_argument for a linear part or load of the problem that cannot be
  MtlStepper(const S& system, const Mtl& method)
      : Stepper<n>(system.size()),
        system_(system),
        method_(method),
        p_(method.points),
        a_(linear_part(system, method.linear)),
        weights_(system.size(), columns(system), method.basis, method.points, system.load()),
        unknowns_(p_ * system.size()),
        work_(p_ * system.size()),
        free_(system.size(), p_ + 1),
        g_(columns(system), p_ + 1),
        phases_(weights_.flow().phase_count(), p_ + 1),
        phase_(phases_.rows()),
        slopes_(static_cast<std::size_t>(p_), Eigen::MatrixXd::Zero(columns(system), system.size())),
        missing_(columns(system)),
        x0_(State<n>::Zero(system.size())),
        node_(x0_),
        f_(x0_),
        jacobian_(system.size(), system.size()),
        lu_(system.size()) {
    this->times_.resize(static_cast<std::size_t>(p_));
    this->states_.resize(system.size(), p_);
  }
  /// The method's.
  [[nodiscard]] static std::string_view name() { return Mtl::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// From t to t + block, p steps at once.
  Status step(double t, double block, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    const double h = block / static_cast<double>(p_);
    if (Outcome outcome = prepare(t, h, x0, statistics); outcome != Outcome::success)
      return detail::mtl_overflow(t, block);
    const std::int64_t before = statistics.newton_iterations;
    Outcome outcome = solve(true, statistics);
    if (outcome != Outcome::success) {
      ++statistics.fallbacks;  // rare: the other start
      outcome = solve(false, statistics);
    }
    if (outcome != Outcome::success)
      return step_not_solved(Mtl::name, outcome, t, block,
                             static_cast<int>(statistics.newton_iterations - before));
    // The nonlinear terms at the states as they are after the last update.
    for (Eigen::Index k = 1; k <= p_; ++k)
      g_.col(k).noalias() -= slope(k) * work_.update.segment((k - 1) * size(), size());
    this->states_ = Eigen::Map<const Nodes<n>>(unknowns_.data(), size(), p_);
    x1 = this->states_.col(p_ - 1);
    return method_.error_tolerance > 0 ? judge(t, block, statistics) : Status();
  }

  /// The linearised solution itself.
  void at(double t, State<n>& x) const override {
    const auto j = std::clamp(static_cast<Eigen::Index>(std::floor((t - t0_) / h_)), Eigen::Index{0}, p_ - 1);
    const bool at_next = t == time(j + 1);  // rounding may have put it before
    x = point(at_next ? j + 1 : j);
    const double tau = t - time(j);
    if (at_next || tau == 0 || weights_.prepare_between(a_, tau) != Outcome::success) return;
    f_ = x;
    weights_.between(j, g_, f_, phases_.col(j), x);
  }

 private:
  static Jacobian<n> linear_part(const S& system, MtlLinear linear) {
    Jacobian<n> a = Jacobian<n>::Zero(system.size(), system.size());
    if (system.second_order()) a.topRightCorner(system.size() / 2, system.size() / 2).setIdentity();
    if (linear == MtlLinear::given) static_cast<void>(system.linear_part(a));  // zero if there is none
    detail::check_split(a, system.load(), system.second_order());
    return a;
  }
  static int columns(const S& system) { return system.second_order() ? system.size() / 2 : system.size(); }
  [[nodiscard]] Eigen::Index size() const { return x0_.size(); }
  [[nodiscard]] double time(Eigen::Index k) const {
    return k == 0 ? t0_ : this->times_[static_cast<std::size_t>(k - 1)];
  }
  [[nodiscard]] auto point(Eigen::Index k) const {
    return Eigen::Map<const State<n>>(k == 0 ? x0_.data() : unknowns_.data() + (k - 1) * size(), size());
  }
  [[nodiscard]] Eigen::MatrixXd& slope(Eigen::Index k) { return slopes_[static_cast<std::size_t>(k - 1)]; }

  // All that does not depend on the unknowns.
  Outcome prepare(double t, double h, const State<n>& x0, Statistics& statistics) {
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

  // g(t_k, x_k): what A and the load leave of f.
  void nonlinear(Eigen::Index k, Statistics& statistics) {
    node_ = point(k);
    system_.rhs(segment_(time(k)), node_, f_);
    ++statistics.right_hand_sides;
    f_.noalias() -= a_ * node_;
    f_.noalias() -= weights_.flow().load() * phases_.col(k);
    g_.col(k) = f_.tail(g_.rows());
  }

  // Newton's iteration, from the motion with g held at its first value, or from rest at the first state.
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

  // The estimate of Mtl::error_tolerance.
  Status judge(double t, double block, Statistics& statistics) {
    double worst = 0;
    if (weights_.prepare_between(a_, h_ / 2) != Outcome::success) return detail::mtl_overflow(t, block);
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
        f_ = lu_.solve(f_).eval();
      }
      const double error = algebraic::detail::length_of_update(f_, node_);
      if (!(error <= worst)) worst = error;
    }
    if (worst <= method_.error_tolerance) return {};
    return detail::mtl_wrong_branch(t, block, worst, method_.error_tolerance);
  }

  const S& system_;
  Mtl method_;
  Eigen::Index p_;
  Jacobian<n> a_;
  mutable MtlWeights weights_;  // at() works in its second half
  SmoothSegment segment_;
  Eigen::VectorXd unknowns_;  // states at the points 1..p
  algebraic::Workspace<Eigen::VectorXd, Eigen::MatrixXd> work_;
  Eigen::MatrixXd free_, g_, phases_;
  Eigen::VectorXd phase_;
  std::vector<Eigen::MatrixXd> slopes_;  // dg/dx at the points
  Eigen::VectorXd missing_;
  State<n> x0_, node_;
  mutable State<n> f_;
  Jacobian<n> jacobian_;
  Eigen::PartialPivLU<Jacobian<n>> lu_;
  double t0_ = 0, h_ = 0;
};

/// Runs Mtl.
template <SystemLike S>
struct Integrator<S, Mtl> {
  /// See integrate(). A step of the walk is a block of p steps; the last block may be shorter.
  /// @throws std::invalid_argument also for options out of range
  static Solution<S::dimension> run(const Task<S>& task, const Mtl& method) {
    check_options(method);
    MtlStepper<S> stepper(task.system, method);
    return walk(task, method.step * method.points, stepper);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<Mtl> = InLibrary::all;
/// @endcond

}  // namespace nlmech::ivp
