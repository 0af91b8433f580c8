/// @file
/// The backward Euler method.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

/// Backward Euler, x1 = x0 + h f(t1, x1) (Elgohary 2015, Eq. 4.5): order 1, A- and L-stable; oscillations are
/// damped by 1/sqrt(1 + (h omega)^2) a step. Solved by Newton's iteration with the exact Jacobian, from
/// x1 = x0. Dense output: the chord, order 1.
///
/// Tests hold it to its closed form on the linear oscillator for h omega from 0.1 to 100 (1e-13), to order 1
/// at and within steps (observed within 0.1), and to a loss of energy in every step.
struct BackwardEuler {
  static constexpr std::string_view name = "backward-euler";  ///< on command lines and in tables
  double step = 0.01;                                         ///< length of a step, positive
  algebraic::Newton newton = {};                              ///< solves each step's equations for x1
};

/// One step of the backward Euler method.
template <SystemLike S>
class BackwardEulerStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;  ///< components of the state
  /// @param system outlives the stepper
  BackwardEulerStepper(const S& system, const algebraic::Newton& newton)
      : Stepper<n>(system.size()),
        system_(system),
        newton_(newton),
        x0_(system.size()),
        x1_(system.size()),
        f_(system.size()),
        workspace_(system.size()) {}
  /// The method's.
  [[nodiscard]] static std::string_view name() { return BackwardEuler::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// From t to t + h.
  Status step(double t, double h, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    const double t1 = segment_(t + h);
    const auto residual = [&](const State<n>& x, State<n>& r) {
      system_.rhs(t1, x, f_);
      ++statistics.right_hand_sides;
      r = x - x0 - h * f_;
    };
    const auto derivative = [&](const State<n>& x, Jacobian<n>& matrix) {
      system_.jacobian(t1, x, matrix);
      matrix *= -h;
      matrix.diagonal().array() += 1;
    };
    x1_ = x0;
    algebraic::Newton newton = newton_;
    // Rounding of a component by eps |x| reaches others of the kind of its rate, however stiff f is, as
    // eps |x|/h: more would be no smooth motion at this step.
    const double noise = 16 * std::numeric_limits<double>::epsilon() * x0.cwiseAbs().maxCoeff();
    newton.noise = std::max(newton.noise, noise * (1 + 1 / std::abs(h)));
    const std::int64_t before = statistics.newton_iterations;
    const Outcome outcome = algebraic::solve(newton, residual, derivative, x1_, workspace_, statistics);
    if (outcome != Outcome::success)
      return step_not_solved(name(), outcome, t, h, static_cast<int>(statistics.newton_iterations - before));
    t0_ = t;
    h_ = h;
    x0_ = x0;
    x1 = x1_;
    return {};
  }

  /// Linear between the ends of the step.
  void at(double t, State<n>& x) const override {
    const double s = (t - t0_) / h_;
    x = (1 - s) * x0_ + s * x1_;
  }

 private:
  const S& system_;
  algebraic::Newton newton_;
  SmoothSegment segment_;
  State<n> x0_, x1_, f_;
  algebraic::Workspace<State<n>, Jacobian<n>> workspace_;
  double t0_ = 0, h_ = 1;
};

/// Runs the backward Euler method.
template <SystemLike S>
struct Integrator<S, BackwardEuler> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const BackwardEuler& method) {
    require_step(method.name, method.step);
    BackwardEulerStepper<S> stepper(task.system, method.newton);
    return walk(task, method.step, stepper);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<BackwardEuler> = InLibrary::all;
/// @endcond

}  // namespace nlmech::ivp
