/// @file
/// Checks a run against the bounds and invariants of its problem.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/solution.hpp"

namespace nlmech::ivp {

/// Checks a run against the bounds and invariants of its problem (problems/problem.hpp). A run by a method
/// with tolerances does not end with success
/// - if a component violates its bound by more than 10 (atol + rtol d), where d is its distance from the
///   bound at the start of the step. Checked forwards in time only, and only if the initial state is within
///   all bounds;
/// - if an invariant differs from its initial value by more than 10 times the first-order effect of an error
///   of one tolerance in each component in each step. Checked at the end only: a drift
///   persists, and a check in each step would cost more than the steps of some methods.
///
/// Costs nothing without bounds and invariants. Tests: Robertson's reactions with an absolute tolerance that
/// lets y2 become negative, and oscillators whose energy drifts.
template <class S>
class StatedLimits {
 public:
  using State = typename S::State;  ///< all components

  /// @param system outlives this object
  /// @param method name, for messages
  StatedLimits(const S& system, std::string_view method, double t0, const State& x0, double t1,
               double relative, double absolute)
      : system_(system), method_(method), relative_(relative), absolute_(absolute) {
    if constexpr (requires { system.bounds(lower_, upper_); }) {
      has_bounds_ = t1 > t0 && system.bounds(lower_, upper_) && (x0.array() >= lower_.array()).all() &&
                    (x0.array() <= upper_.array()).all();
    }
    if constexpr (requires { system.invariants(t0, x0, first_); })
      has_invariants_ = system.invariants(t0, x0, first_);
    if (has_invariants_) {
      now_ = varied_ = first_;
      allowed_ = Eigen::VectorXd::Zero(first_.size());
      probe_ = x0;
    }
  }

  /// Must each step be checked?
  [[nodiscard]] bool has_bounds() const { return has_bounds_; }
  /// Checks a step against the bounds; requires has_bounds(). @return false if it must not be accepted;
  /// status() gives the reason
  bool respects(const StepOf<S>& step) {
    for (Eigen::Index i = 0; i < step.x1.size(); ++i) {
      const double x = step.x1[i], below = lower_[i] - x, above = x - upper_[i];
      if (!(below > 0 || above > 0)) continue;
      const double bound = below > 0 ? lower_[i] : upper_[i];
      const double distance = std::max(0., below > 0 ? step.x0[i] - bound : bound - step.x0[i]);
      if (std::abs(x - bound) <= factor * (absolute_ + relative_ * distance)) continue;
      status_ = bound_left(method_, static_cast<int>(i + 1), step.t1, x, bound);
      return false;
    }
    return true;
  }
  /// Checks the invariants at the end of a run of @p steps steps. @return as respects()
  bool respects_end(std::int64_t steps, double t, const State& x) {
    return !has_invariants_ || conserves(steps, t, x);
  }
  /// Success, or the bound or invariant that is violated, and the time.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  static constexpr double factor = 10;

  bool conserves(std::int64_t steps, double t, const State& x) {
    if (!system_.invariants(t, x, now_)) return true;
    const double count = factor * (1 + static_cast<double>(steps));
    for (Eigen::Index k = 0; k < now_.size(); ++k) {
      if (!std::isfinite(first_[k])) continue;
      const double drift = std::abs(now_[k] - first_[k]);
      if (drift <= count * allowed_[k]) continue;
      allow(t, x);
      if (drift <= count * allowed_[k]) continue;
      status_ = invariant_lost(method_, static_cast<int>(k + 1), t, now_[k], first_[k]);
      return false;
    }
    return true;
  }
  // Updates allowed_ by the effect on the invariants of an error of one tolerance in each component at x,
  // plus rounding.
  void allow(double t, const State& x) {
    constexpr double epsilon = 2.220446049250313e-16, root = 1.5e-8;
    Eigen::VectorXd& sum = change_;
    sum = 8 * epsilon * (now_.cwiseAbs() + first_.cwiseAbs());
    probe_ = x;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double tolerance = absolute_ + relative_ * std::abs(x[i]);
      // Difference step large enough against rounding.
      const double length = std::max(tolerance, root * std::max(std::abs(x[i]), x.cwiseAbs().maxCoeff()));
      probe_[i] = x[i] + length;
      if (system_.invariants(t, probe_, varied_))
        sum += (varied_ - now_).cwiseAbs() * ((tolerance + epsilon * std::abs(x[i])) / length);
      probe_[i] = x[i];
    }
    allowed_ = allowed_.cwiseMax(sum);
  }

  const S& system_;
  std::string_view method_;
  double relative_, absolute_;
  bool has_bounds_ = false, has_invariants_ = false;
  State lower_, upper_, probe_;
  Eigen::VectorXd first_, now_, varied_, allowed_, change_;
  Status status_;
};

/// Does a method have tolerances?
template <class Method>
concept HasTolerances = requires(const Method& method) {
  method.relative_tolerance;
  method.absolute_tolerance;
};

/// Does the method choose its steps by its tolerances? False if a fixed step is given.
template <HasTolerances Method>
[[nodiscard]] bool uses_tolerances(const Method& method) {
  if constexpr (requires { method.step; }) {
    return !(method.step > 0);
  } else {
    return true;
  }
}

/// The name of a method, for messages.
template <class Method>
[[nodiscard]] std::string_view method_name(const Method& method) {
  if constexpr (requires { std::string_view(Method::name); }) {
    return Method::name;
  } else if constexpr (requires { std::string_view(method.name); }) {
    return method.name;
  } else if constexpr (requires { std::string_view(method.name()); }) {
    return method.name();
  } else {
    return "integrate";
  }
}

}  // namespace nlmech::ivp
