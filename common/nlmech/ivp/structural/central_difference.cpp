#include "nlmech/ivp/structural/central_difference.hpp"

#include <cstdint>
#include <string_view>

#include "nlmech/ivp/cubic_hermite.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

namespace {

/// Stepper of central differences; stores the velocity of half a step earlier.
class CentralDifferenceStepper : public Stepper {
 public:
  /// @param system outlives the stepper
  CentralDifferenceStepper(const System& system, const CentralDifference& method)
      : Stepper(system.size()),
        system_(system),
        method_(method),
        given_(method.initial),
        hermite_(system.size()),
        q_(State::Zero(system.size() / 2)),
        v_(q_),
        v_half_(q_),
        a_(q_) {}
  /// Name of the method.
  [[nodiscard]] static std::string_view name() { return CentralDifference::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) {
    segment_ = SmoothSegment(begin, end);
    starts_ = true;
  }

  /// Integrates from t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
    if (starts_) {
      start(t, h, x0);
      ++statistics.right_hand_sides;
    }
    hermite_.next_step(t, h);
    const double between = (h_before_ + h) / 2;
    for (Eigen::Index i = 0; i < q_.size(); ++i) {
      v_half_[i] += between * a_[i];
      q_[i] += h * v_half_[i];
      v_[i] = v_half_[i] + (h / 2) * a_[i];
    }
    system_.acceleration(segment_(t + h), q_, v_, a_);
    ++statistics.right_hand_sides;
    for (Eigen::Index i = 0; i < q_.size(); ++i) v_[i] = v_half_[i] + (h / 2) * a_[i];
    join(q_, v_, a_, hermite_.x1, hermite_.f1);
    h_before_ = h;
    x1 = hermite_.x1;
    if (method_.reported == VelocityTime::half_step_before) velocities(x1) = v_half_;
    return {};
  }

  /// Dense output: cubic Hermite interpolation.
  void at(double t, State& x) const override { hermite_.at(t, x); }

 private:
  // Sets velocity and acceleration at the start of a segment, and the velocity half a step earlier. After the
  // first segment v_ is the velocity at the end of the latest step.
  void start(double t, double h, const State& x0) {
    q_ = positions(x0);
    if (first_) v_ = velocities(x0);
    system_.acceleration(segment_(t), q_, v_, a_);
    if (given_ == VelocityTime::half_step_before) {
      v_half_ = v_;
      v_ += (h / 2) * a_;
      given_ = VelocityTime::of_state;
    } else {
      v_half_ = v_ - (h / 2) * a_;
    }
    join(q_, v_, a_, hermite_.x1, hermite_.f1);
    h_before_ = h;
    first_ = starts_ = false;
  }

  const System& system_;
  CentralDifference method_;
  VelocityTime given_;
  SmoothSegment segment_;
  CubicHermite hermite_;
  State q_, v_, v_half_, a_;
  double h_before_ = 0;
  bool first_ = true, starts_ = true;
};

}  // namespace

Solution run(const InitialValueProblem& problem, const CentralDifference& method) {
  require_step(method.name, method.step);
  require_accelerations(method.name, problem.system);
  CentralDifferenceStepper stepper(problem.system, method);
  return integrate_fixed_steps(problem, method.step, stepper);
}

}  // namespace nlmech::ivp
