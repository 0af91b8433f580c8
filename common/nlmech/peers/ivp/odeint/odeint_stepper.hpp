/// @file
/// Odeint's controlled steppers as peer steppers. Only for sources that are compiled with Boost.
#pragma once

#include <algorithm>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/peers/ivp/odeint/odeint.hpp"

namespace nlmech::peers::detail {

/// A state of n components for both Odeint's array algebra and the equations, so that nothing is copied and
/// loops are unrolled.
template <class T, std::size_t n>
struct OdeintState : Vector<T, static_cast<int>(n)> {
  using Base = Vector<T, static_cast<int>(n)>;  ///< state of the equations
  using Base::Base;
  using Base::operator=;
};
/// Odeint's state for equations of @p n components.
template <int n>
using OdeintStateOf = std::conditional_t<n == Eigen::Dynamic, std::vector<double>,
                                         OdeintState<double, static_cast<std::size_t>(n < 1 ? 1 : n)>>;
/// Odeint's algebra for a state.
template <class State>
using OdeintAlgebra =
    std::conditional_t<std::is_same_v<State, std::vector<double>>, boost::numeric::odeint::range_algebra,
                       boost::numeric::odeint::array_algebra>;

/// Odeint's right-hand side. It holds a pointer, because Odeint's steppers copy it.
template <class E, class State>
struct OdeintRhs {
  E* equations;     ///< Equations or a final class derived from it
  double sign = 1;  ///< -1: Odeint's time is -t
  /// dx/dt into @p f.
  void operator()(const State& x, State& f, double t) const {
    if constexpr (requires { equations->rhs(t, x, f); }) {
      equations->rhs(sign * t, x, f);
    } else {
      equations->rhs(sign * t, x.data(), f.data());
    }
    if (sign < 0) {
      for (double& slope : f) slope = -slope;
    }
  }
};

/// Time and step size of a loop over Odeint's trial steps. Odeint's own loops accept a step to NaN or
/// infinity, because comparisons with NaN are false, and repeat a rejected step for ever or hundreds of times
/// if its size has become zero or NaN.
class OdeintStep {
 public:
  /// @param method name for messages @param largest greatest step size
  explicit OdeintStep(std::string_view method, double largest = std::numeric_limits<double>::infinity())
      : method_(method), largest_(largest) {}
  /// Starts at @p t towards @p end with the initial step @p step. @param reflected use -t as Odeint's time
  void begin(double t, double end, double step, bool reflected = false) {
    sign_ = reflected ? -1 : 1;
    t_ = sign_ * t;
    end_ = sign_ * end;
    step_ = within(sign_ * step);
  }
  /// Odeint's time reached.
  [[nodiscard]] double time() const { return t_; }
  /// Is the end reached?
  [[nodiscard]] bool done() const { return t_ == end_; }
  /// -1 if Odeint's time is -t, else 1.
  [[nodiscard]] double sign() const { return sign_; }
  /// Next step size, shortened to meet the end.
  [[nodiscard]] double cut() const { return last() ? end_ - t_ : step_; }
  /// Result of a trial step of size @p tried. @param accepted true if Odeint accepts it @param finite true if
  /// state and slope are finite @param next Odeint's next step size
  [[nodiscard]] Attempt finish_trial(bool accepted, bool finite, double tried, double next) {
    if (accepted && finite) {
      const bool to_end = last();
      t_ = to_end ? end_ : t_ + tried;
      // A step shortened to meet the end must not reduce the next step size.
      if (std::isfinite(next) && !(to_end && std::abs(next) < std::abs(step_))) step_ = within(next);
      return {Attempt::Result::accepted, sign_ * t_, sign_ * tried, {}};
    }
    const bool shorter = finite && std::abs(next) < std::abs(tried) && next * tried > 0;
    step_ = shorter ? next : tried / 4;
    const double t = sign_ * t_, step = sign_ * step_;
    if (t_ + step_ != t_) return {Attempt::Result::rejected, t, sign_ * tried, {}};
    return {Attempt::Result::failed, t, step,
            finite ? ivp::step_underflow(method_, t, step) : non_finite_rhs(method_, t, step)};
  }

 private:
  [[nodiscard]] double within(double step) const {
    return std::copysign(std::min(std::abs(step), largest_), step);
  }
  [[nodiscard]] bool last() const { return std::abs(end_ - t_) <= std::abs(step_) * (1 + 1e-12); }

  std::string_view method_;
  double largest_;
  double t_ = 0, end_ = 0, step_ = 0, sign_ = 1;
};

/// Dormand-Prince formula with its own dense output.
template <class State>
struct Dopri5 {
  /// Odeint's type of the formula.
  using Formula =
      boost::numeric::odeint::runge_kutta_dopri5<State, double, State, double, OdeintAlgebra<State>>;
  /// With step control.
  using Controlled = boost::numeric::odeint::controlled_runge_kutta<Formula>;
  static constexpr bool gives_slope = true;  ///< f at the end of a step is its last stage
};
/// Fehlberg's formula of order 8(7).
template <class State>
struct Fehlberg78 {
  /// Odeint's type of the formula.
  using Formula =
      boost::numeric::odeint::runge_kutta_fehlberg78<State, double, State, double, OdeintAlgebra<State>>;
  /// With step control.
  using Controlled = boost::numeric::odeint::controlled_runge_kutta<Formula>;
  static constexpr bool gives_slope = false;  ///< f at the end is evaluated for the next step
};
/// Bulirsch-Stoer extrapolation. Odeint 1.74 compares signed step sizes when it chooses the order. Backwards
/// in time it therefore chooses the most expensive order and takes thousands of steps instead of thirty.
/// Hence its time always increases; it is -t for an integration backwards.
template <class State>
struct BulirschStoer {
  /// Odeint's type of the formula.
  using Controlled =
      boost::numeric::odeint::bulirsch_stoer<State, double, State, double, OdeintAlgebra<State>>;
  static constexpr bool gives_slope = false;  ///< f at the end is evaluated for the next step
};

/// Stepper of one of the three explicit formulas for the equations E.
template <class E, class State, template <class> class Kind>
class OdeintStepper final : public PeerStepper {
 public:
  /// @param equations must outlive the stepper
  OdeintStepper(E& equations, const Odeint& method, double largest_step)
      : equations_(equations),
        tolerances_{method.relative_tolerance, method.absolute_tolerance},
        method_(method.name()),
        controlled_(make(tolerances_)),
        step_(method_, largest_step) {
    for (State* x : {&x0_, &x1_, &f0_, &f1_, &next_, &slope_}) {
      if constexpr (std::is_same_v<State, std::vector<double>>)
        x->resize(static_cast<std::size_t>(equations.size()));
    }
  }

  Status begin(double t, const double* x, double end) override {
    controlled_.emplace(make(tolerances_));
    std::copy_n(x, x1_.size(), x1_.begin());
    const bool reflected = end < t && std::is_same_v<Kind<State>, BulirschStoer<State>>;
    rhs_.sign = reflected ? -1 : 1;
    rhs_(x1_, f1_, rhs_.sign * t);
    if (!finite(f1_)) return non_finite_rhs(method_, t, end - t);
    step_.begin(t, end, initial_step(t, x, f1_.data(), equations_.size(), end, tolerances_), reflected);
    return {};
  }

  Attempt attempt(double* x, Statistics& /*statistics*/) override {
    double t = step_.time(), next_length = step_.cut();
    const double tried = next_length;
    const bool accepted = advance(t, next_length) == boost::numeric::odeint::success;
    bool is_finite = finite(next_);
    if (accepted && is_finite) {
      if constexpr (!Kind<State>::gives_slope) rhs_(next_, slope_, t);
      is_finite = finite(slope_);
    }
    const double t0 = step_.time();
    Attempt done = step_.finish_trial(accepted, is_finite, tried, next_length);
    if (!is_finite) controlled_.emplace(make(tolerances_));  // may have stored a NaN
    if (done.result != Attempt::Result::accepted) return done;
    t0_ = t0;
    std::swap(x0_, x1_);
    std::swap(f0_, f1_);
    std::swap(x1_, next_);
    std::swap(f1_, slope_);
    std::copy(x1_.begin(), x1_.end(), x);
    return done;
  }

  void at(double t, double* x) override {
    const Uncounted uncounted(equations_);
    State out = x0_;
    if constexpr (std::is_same_v<Kind<State>, Dopri5<State>>) {
      controlled_->stepper().calc_state(t, out, x0_, f0_, t0_, x1_, f1_, step_.time());
    } else if (!steps_to(step_.sign() * t, out)) {
      miss(method_, t, step_.sign() * t0_, step_.sign() * step_.time());
    }
    std::copy(out.begin(), out.end(), x);
  }

  void add_counters(Statistics& /*statistics*/) const override {}

 private:
  using Controlled = typename Kind<State>::Controlled;

  static Controlled make(const Tolerances& tolerances) {
    if constexpr (std::is_same_v<Kind<State>, BulirschStoer<State>>) {
      return Controlled(tolerances.absolute, tolerances.relative);
    } else {
      // Odeint copies uninitialised stages; those of a static object are zeros.
      static const typename Controlled::stepper_type blank;
      return Controlled({tolerances.absolute, tolerances.relative}, {}, blank);
    }
  }
  bool finite(const State& x) { return equations_.check(x.data()); }

  boost::numeric::odeint::controlled_step_result advance(double& t, double& length) {
    if constexpr (Kind<State>::gives_slope) {
      return controlled_->try_step(rhs_, x1_, f1_, t, next_, slope_, length);
    } else {
      return controlled_->try_step(rhs_, x1_, f1_, t, next_, length);
    }
  }

  /// State at @p end (Odeint's time) by steps of the same formula, usually one, from the start of the latest
  /// step. False on failure.
  bool steps_to(double end, State& x) {
    Controlled controlled = make(tolerances_);
    OdeintStep step(method_);
    State slope = f0_, next = x0_;
    x = x0_;
    step.begin(t0_, end, end - t0_);
    while (!step.done()) {
      double t = step.time(), next_length = step.cut();
      const double tried = next_length;
      const bool accepted =
          controlled.try_step(rhs_, x, slope, t, next, next_length) == boost::numeric::odeint::success;
      const Attempt attempt = step.finish_trial(accepted, finite(next), tried, next_length);
      if (attempt.result == Attempt::Result::failed) return false;
      if (attempt.result == Attempt::Result::rejected) continue;
      x = next;
      if (!step.done()) rhs_(x, slope, step.time());
    }
    return true;
  }

  E& equations_;
  Tolerances tolerances_;
  std::string_view method_;
  std::optional<Controlled> controlled_;  // optional, because not all of Odeint's types can be assigned
  OdeintStep step_;
  OdeintRhs<E, State> rhs_{&equations_};
  State x0_{}, x1_{}, f0_{}, f1_{}, next_{}, slope_{};
  double t0_ = 0;
};

/// Integrates by one of the explicit formulas. @throws std::invalid_argument for rosenbrock4, which is not
/// explicit
template <class State, class E>
[[nodiscard]] Status run_explicit_odeint(E& equations, Run& run, const Odeint& method) {
  const auto integrate_with = [&]<template <class> class Kind>(std::type_identity<Kind<State>>) {
    OdeintStepper<E, State, Kind> stepper(equations, method, run.limits.largest_step);
    return integrate_steps(method.name(), stepper, run);
  };
  switch (method.formula) {
    case Odeint::Formula::dopri5: return integrate_with(std::type_identity<Dopri5<State>>{});
    case Odeint::Formula::fehlberg78: return integrate_with(std::type_identity<Fehlberg78<State>>{});
    case Odeint::Formula::bulirsch_stoer: return integrate_with(std::type_identity<BulirschStoer<State>>{});
    case Odeint::Formula::rosenbrock4: break;
  }
  throw std::invalid_argument("odeint-rosenbrock4 is not explicit");
}

}  // namespace nlmech::peers::detail
