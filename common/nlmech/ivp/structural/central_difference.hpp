/// @file
/// The explicit central difference method for accelerations.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/ivp/cubic_hermite.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

/// To which time the velocities of a state belong.
enum class VelocityTime : std::uint8_t {
  of_state,         ///< to the time of the state, as everywhere else
  half_step_before  ///< half a step earlier, where the method itself has them
};

/// Central differences, order 2, explicit (Elgohary 2015, Eq. 4.4): velocities live half a step beside
/// positions,
///
///     v(t + h/2) = v(t - h/2) + h a(t, q, v),   q(t + h) = q(t) + h v(t + h/2).
///
/// Started with v(t0 - h/2) = v0 - h/2 a0. Where the step changes from h' to h,
/// v(t + h/2) = v(t - h'/2) + (h' + h)/2 a. States at step ends have the velocity v(t) = v(t - h/2) + h/2 a.
/// Forces that depend on the velocity get v(t) = 1.5 v(t - h/2) - 0.5 v(t - 3h/2), the same as
/// v(t - h/2) + h/2 a(t - h), which keeps the method explicit and its order 2. One acceleration a step.
/// Stable for h omega <= 2; a damping -c v alone: for h c <= 1. Dense output: the cubic Hermite interpolant.
///
/// The two last options exist to reproduce a fault. The rows "Explicit" of Table 4.4 come out as printed if a
/// run with the step h ends with v(t1 - h/2) and the next one, with another step h', takes that number for
/// v(t1 - h'/2): an error of first order, (h' - h)/2 a in the velocity. That is
/// `CentralDifference{.step = h, .reported = VelocityTime::half_step_before}` followed by
/// ``CentralDifference{.step = h', .initial = VelocityTime::half_step_before}``.
///
/// Tests hold it to the rotation by 2 arcsin(h/2) on the linear oscillator (16 eps a step, h omega up to
/// 1.9), to order 2 (observed within 0.1), to growth beyond h omega = 2, and to the errors that
/// tools/oracles/rbf_ivp_methods.py has for Tables 4.2, 4.4 and 4.6.
struct CentralDifference {
  static constexpr std::string_view name = "explicit";  ///< on command lines and in tables
  double step = 0.01;                                   ///< length of a step, positive
  /// half_step_before: the initial velocities are taken for v(t0 - h/2), not for v(t0).
  VelocityTime initial = VelocityTime::of_state;
  /// half_step_before: states that are given out (end of steps and of the run) have the velocity v(t - h/2).
  /// Dense output keeps velocities of the time that it is asked for.
  VelocityTime reported = VelocityTime::of_state;
};

/// One step of central differences; remembers the velocity half a step back.
template <SystemLike S>
class CentralDifferenceStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;  ///< components of the state
  /// @param system outlives the stepper
  CentralDifferenceStepper(const S& system, const CentralDifference& method)
      : Stepper<n>(system.size()),
        system_(system),
        method_(method),
        given_(method.initial),
        hermite_(system.size()),
        q_(Half<n>::Zero(system.size() / 2)),
        v_(q_),
        v_half_(q_),
        a_(q_) {}
  /// The method's.
  [[nodiscard]] static std::string_view name() { return CentralDifference::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) {
    segment_ = SmoothSegment(begin, end);
    starts_ = true;
  }

  /// From t to t + h.
  Status step(double t, double h, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    q_ = positions(x0);
    if (starts_) {
      start(t, h, x0);
      ++statistics.right_hand_sides;
    }
    keep(hermite_.x0, hermite_.f0);
    v_half_ += ((h_before_ + h) / 2) * a_;
    q_ += h * v_half_;
    v_ = v_half_ + (h / 2) * a_;
    system_.acceleration(segment_(t + h), q_, v_, a_);
    ++statistics.right_hand_sides;
    v_ = v_half_ + (h / 2) * a_;
    keep(hermite_.x1, hermite_.f1);
    hermite_.t0 = t;
    hermite_.h = h_before_ = h;
    x1 = hermite_.x1;
    if (method_.reported == VelocityTime::half_step_before) velocities(x1) = v_half_;
    return {};
  }

  /// Cubic Hermite.
  void at(double t, State<n>& x) const override { hermite_.at(t, x); }

 private:
  // Velocity and acceleration at the begin of a segment, and the velocity that would have been half a step
  // before. After the first segment v_ is that of the end of the latest step.
  void start(double t, double h, const State<n>& x0) {
    if (first_) v_ = velocities(x0);
    system_.acceleration(segment_(t), q_, v_, a_);
    if (given_ == VelocityTime::half_step_before) {
      v_half_ = v_;
      v_ += (h / 2) * a_;
      given_ = VelocityTime::of_state;
    } else {
      v_half_ = v_ - (h / 2) * a_;
    }
    h_before_ = h;
    first_ = starts_ = false;
  }

  void keep(State<n>& x, State<n>& f) const {
    positions(x) = q_;
    velocities(x) = v_;
    positions(f) = v_;
    velocities(f) = a_;
  }

  const S& system_;
  CentralDifference method_;
  VelocityTime given_;
  SmoothSegment segment_;
  CubicHermite<n> hermite_;
  Half<n> q_, v_, v_half_, a_;
  double h_before_ = 0;
  bool first_ = true, starts_ = true;
};

/// Runs the central difference method.
template <SystemLike S>
struct Integrator<S, CentralDifference> {
  /// See integrate(). @throws std::invalid_argument also for a problem without accelerations
  static Solution<S::dimension> run(const Task<S>& task, const CentralDifference& method) {
    require_step(method.name, method.step);
    require_accelerations(method.name, task.system);
    CentralDifferenceStepper<S> stepper(task.system, method);
    return walk(task, method.step, stepper);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<CentralDifference> = InLibrary::even;
/// @endcond

}  // namespace nlmech::ivp
