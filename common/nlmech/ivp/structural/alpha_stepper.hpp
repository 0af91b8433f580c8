/// @file
/// The implicit step that Newmark's, Hilber, Hughes and Taylor's and the generalised alpha method share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/cubic_hermite.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

/// The four numbers of the family, for q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) a0 + 2 beta a1],   v1 = v0 + h [(1 - gamma) a0 + gamma a1],
///     (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) g1 + alpha_f g0.
///
/// The accelerations a are variables of the method: they start as g(t0, q0, v0) and are then carried from
/// step to step. Order 2 if and only if gamma = 1/2 - alpha_m + alpha_f.
struct AlphaScheme {
  double alpha_m = 0;    ///< weight of the old acceleration
  double alpha_f = 0;    ///< weight of the old force
  double beta = 0.25;    ///< weight of the new acceleration in positions
  double gamma = 0.5;    ///< weight of the new acceleration in velocities
  bool forgets = false;  ///< a0 is replaced by g0 in every step
};

/// One step of the family; its equations are solved for a1 by Newton's iteration with the exact Jacobian,
/// from a1 = a0.
template <SystemLike S>
class AlphaStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;  ///< components of the state
  /// @param system outlives the stepper
  AlphaStepper(const S& system, std::string_view name, const AlphaScheme& scheme,
               const algebraic::Newton& newton)
      : Stepper<n>(system.size()),
        system_(system),
        name_(name),
        scheme_(scheme),
        newton_(newton),
        hermite_(system.size()),
        jacobian_(system.size(), system.size()),
        q_(Half<n>::Zero(system.size() / 2)),
        v_(q_),
        a0_(q_),
        a1_(q_),
        g0_(q_),
        g1_(q_),
        workspace_(q_.size()) {}
  /// Of the method that this is.
  [[nodiscard]] std::string_view name() const { return name_; }

  /// The next step starts a segment on which f is smooth: accelerations of the one before do not count.
  void begin_segment(double begin, double end) {
    segment_ = SmoothSegment(begin, end);
    starts_ = true;
  }

  /// From t to t + h.
  Status step(double t, double h, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    if (starts_) {
      q_ = positions(x0);
      v_ = velocities(x0);
      system_.acceleration(segment_(t), q_, v_, g0_);
      ++statistics.right_hand_sides;
      a0_ = g0_;
      starts_ = false;
    }
    a1_ = a0_;
    if (Status status = solve(t, h, x0, statistics); !status.ok()) return status;
    advance(h, x0);
    positions(x1) = q_;
    velocities(x1) = v_;
    // The force at the end, from the equation just solved.
    g1_ =
        ((1 - scheme_.alpha_m) * a1_ + scheme_.alpha_m * a0_ - scheme_.alpha_f * g0_) / (1 - scheme_.alpha_f);
    keep(t, h, x0, x1);
    g0_ = g1_;
    a0_ = scheme_.forgets ? g1_ : a1_;
    return {};
  }

  /// Cubic Hermite.
  void at(double t, State<n>& x) const override { hermite_.at(t, x); }

 private:
  // Positions and velocities that belong to the accelerations a1.
  void advance(double h, const State<n>& x0) {
    const auto v0 = velocities(x0);
    q_ = positions(x0) + h * v0 + (h * h) * ((0.5 - scheme_.beta) * a0_ + scheme_.beta * a1_);
    v_ = v0 + h * ((1 - scheme_.gamma) * a0_ + scheme_.gamma * a1_);
  }

  Status solve(double t, double h, const State<n>& x0, Statistics& statistics) {
    const double t1 = segment_(t + h), wm = 1 - scheme_.alpha_m, wf = 1 - scheme_.alpha_f;
    const auto residual = [&](const Half<n>& /*a1_*/, Half<n>& r) {
      advance(h, x0);
      system_.acceleration(t1, q_, v_, g1_);
      ++statistics.right_hand_sides;
      r = wm * a1_ + scheme_.alpha_m * a0_ - wf * g1_ - scheme_.alpha_f * g0_;
    };
    const auto derivative = [&](const Half<n>& /*a1_*/, auto& matrix) {
      positions(hermite_.x1) = q_;  // as a place to work: keep() writes it anew
      velocities(hermite_.x1) = v_;
      system_.jacobian(t1, hermite_.x1, jacobian_);
      const auto size = Eigen::fix<half<n>>(system_.size() / 2);
      matrix = -wf * (scheme_.beta * h * h * jacobian_.bottomLeftCorner(size, size) +
                      scheme_.gamma * h * jacobian_.bottomRightCorner(size, size));
      matrix.diagonal().array() += wm;
    };
    algebraic::Newton newton = newton_;
    newton.noise = std::max(newton.noise, noise(h, x0));
    const std::int64_t before = statistics.newton_iterations;
    const Outcome outcome = algebraic::solve(newton, residual, derivative, a1_, workspace_, statistics);
    if (outcome == Outcome::success) return {};
    return step_not_solved(name_, outcome, t, h, static_cast<int>(statistics.newton_iterations - before));
  }

  // Rounding of q and v by eps moves g by at most eps (|g_q| |q| + |g_v| |v|), and that moves a1, however
  // stiff g is, by at most eps (|q|/(beta h^2) + |v|/(gamma h)): a change of a1 that is lost in q1 and v1.
  [[nodiscard]] double noise(double h, const State<n>& x0) const {
    constexpr double eps = 4 * std::numeric_limits<double>::epsilon();
    const double q = positions(x0).cwiseAbs().maxCoeff(), v = velocities(x0).cwiseAbs().maxCoeff();
    const double by_q = scheme_.beta > 0 ? q / (scheme_.beta * h * h) : 0;
    return eps * (by_q + (scheme_.gamma > 0 ? v / (scheme_.gamma * std::abs(h)) : 0));
  }

  void keep(double t, double h, const State<n>& x0, const State<n>& x1) {
    hermite_.t0 = t;
    hermite_.h = h;
    hermite_.x0 = x0;
    hermite_.x1 = x1;
    positions(hermite_.f0) = velocities(x0);
    velocities(hermite_.f0) = g0_;
    positions(hermite_.f1) = velocities(x1);
    velocities(hermite_.f1) = g1_;
  }

  const S& system_;
  std::string_view name_;
  AlphaScheme scheme_;
  algebraic::Newton newton_;
  SmoothSegment segment_;
  CubicHermite<n> hermite_;
  Jacobian<n> jacobian_;
  Half<n> q_, v_, a0_, a1_, g0_, g1_;
  algebraic::Workspace<Half<n>, Matrix<double, half<n>>> workspace_;
  bool starts_ = true;
};

/// Runs a method of the family.
template <SystemLike S>
[[nodiscard]] Solution<S::dimension> walk_by_alpha(const Task<S>& task, std::string_view name, double step,
                                                   const AlphaScheme& scheme,
                                                   const algebraic::Newton& newton) {
  require_step(name, step);
  require_accelerations(name, task.system);
  AlphaStepper<S> stepper(task.system, name, scheme, newton);
  return walk(task, step, stepper);
}

}  // namespace nlmech::ivp
