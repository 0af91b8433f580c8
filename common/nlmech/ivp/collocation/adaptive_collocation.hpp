/// @file
/// The project's own integrator: collocation at Radau nodes with control of step and error.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/collocation/collocation_newton.hpp"
#include "nlmech/ivp/collocation/collocation_orders.hpp"
#include "nlmech/ivp/collocation/collocation_sweeps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Collocation with polynomials at the left end and Radau nodes, the method Radau IIA of high order, step by
/// step under an error estimate; in the form for accelerations where the problem has them.
///
/// Controlled is the error of a step, |e_i| <= atol + rtol |x_i|. What steps add up to is the problem's: the
/// end of a stable stiff problem is right to a few tolerances, that of an oscillation off by about as many as
/// there are periods.
///
/// Dense output of sweeps solves the equations of the step anew up to the asked time: as accurate as the
/// steps are. What it costs is not in the statistics.
///
/// Tests hold sweeps to the tolerance in every step at the orders that the method chooses, Newton's steps
/// through transients and the jumps of van der Pol's oscillator to 3 tolerances, ends of stiff problems to 30
/// (HIRES, Robertson, van der Pol to mu = 1e4, linear systems with known solutions), and polynomials of
/// degree 2 s - 2 in time to 16 eps.
struct AdaptiveCollocation {
  static constexpr std::string_view name = "adaptive-collocation";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                                 ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                                 ///< atol, positive
  int nodes = 0;            ///< N of sweeps, the left end among them: 9, 13 or 17; 0: as is best
  double largest_step = 0;  ///< 0: the interval
  double shape = 0;  ///< c of Gaussians at the nodes, 1/time; 0: polynomials. For comparison: each length of
                     ///< a step has its own tables, and the estimate cannot count on superconvergence
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const AdaptiveCollocation& method);

namespace adaptive {

/// Which order an integration begins with: that of the nodes asked for, else what suits the tolerance.
[[nodiscard]] int first_order(const AdaptiveCollocation& method);

/// One integration from begin to end. It begins with sweeps, goes over to Newton's iteration where their
/// contraction bounds the steps more than the error does, and comes back where the steps have become short
/// against the time constants.
template <class S, class Sweeps, class Newton>
class Run : public ChosenSteps<S, Run<S, Sweeps, Newton>> {
 public:
  /// @param task outlives the run
  Run(const Task<S>& task, const AdaptiveCollocation& method)
      : Base(task, AdaptiveCollocation::name,
             {.largest = method.largest_step > 0 ? method.largest_step : std::abs(task.t1 - task.t0),
              .most_change = HUGE_VAL,
              .kept_from = 0}),
        has_newton_(!(method.shape > 0)),
        strict_{task.system,
                {caution * method.absolute_tolerance, caution * method.relative_tolerance},
                method.shape},
        setup_{task.system, {method.absolute_tolerance, method.relative_tolerance}},
        sweeps_(strict_, first_order(method), method.nodes > 0),
        newton_(setup_, first_order(method), method.nodes > 0) {}

 private:
  using Base = ChosenSteps<S, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;

  static constexpr std::string_view name = AdaptiveCollocation::name;
  // Of the tolerance in a step of sweeps: errors of an oscillation add up over its steps, and in time.
  static constexpr double caution = 0.1;
  static constexpr double safety = 0.85;            // of sweeps
  static constexpr double safety_newton = 0.93;     // their estimate is mostly too large
  static constexpr double rest = 1.2;               // a longer step has to be longer by this
  static constexpr int many_sweeps = 8;             // more than that are dearer than shorter steps
  static constexpr double most_growth = 2;          // of a step
  static constexpr double first_growth = 8;         // of the first ones, whose length was a guess
  static constexpr double telling = 1e-8;           // error of a step after which the length is no guess
  static constexpr double least_remembered = 0.01;  // of errors, which pass through zero
  static constexpr int patience = 4;                // half as many slow trials, before Newton's iteration
  static constexpr double much = 1.5;  // longer that the error would allow a step that sweeps bound
  static constexpr int calm = 20;      // steps short against the time constants, before sweeps
  static constexpr double gentle = 1;  // h |J| of such steps
  // Both engines have the same interface; each works in the order that it has come to.
  template <class Work>
  decltype(auto) engine(Work work) {
    return is_stiff_ ? newton_.current(work) : sweeps_.current(work);
  }

  Status begin(double end) {
    end_ = end;
    begin_engine();
    if (!engine([](auto& e) { return e.begin_is_finite(); })) return non_finite_rhs(name, now_.t);
    control_.start(std::min(control_.rule().largest, sweeps_.current([&](const auto& e) {
      return e.first_length(now_.x, std::abs(end - now_.t));
    })));
    return {};
  }
  void begin_engine() {
    sweeps_.begin_segment(now_.t, end_, now_.x, now_.statistics);
    if (is_stiff_) newton_.begin_segment(now_.t, end_, now_.x, now_.statistics);
    control_.forget();
    is_guess_ = true;
    slow_ = 0;
    calm_ = 0;
  }

  double attempt(double t1) {
    if (is_stiff_ ? calm_ >= calm : has_newton_ && slow_ >= patience) {
      is_stiff_ = !is_stiff_;
      begin_engine();
    }
    trial_ = engine([&](auto& e) { return e.attempt(now_.t, t1, now_.statistics); });
    return trial_.converged ? trial_.error : HUGE_VAL;
  }
  [[nodiscard]] double shorter(double /*error*/) {
    if (!is_stiff_ && !trial_.converged && trial_.error == 0) slow_ += 2;
    return control_.taken() * (trial_.error > 1 ? std::clamp(safe() / root(trial_.error), 0.2, 0.9)
                                                : std::max(trial_.shorter, 0.1));
  }
  [[nodiscard]] double safe() const { return is_stiff_ ? safety_newton : safety; }
  [[nodiscard]] double root(double error) const {
    return std::pow(std::max(error, 1e-30), 1. / (is_stiff_ ? newton_.error_order() : sweeps_.error_order()));
  }

  Status accept(double t1, double error) {
    control_.accepted(control_.taken() * growth(error));
    Status status = engine([&](const auto& e) { return this->take(t1, e.end_state(), e); });
    is_stiff_ ? newton_.accept(now_.statistics) : sweeps_.accept(now_.statistics);
    return status;
  }

  // What the next step may be times as long: by the error, and by the iterations.
  [[nodiscard]] double growth(double error) {
    double change = control_.change(safe(), root(error), root(std::max(error, least_remembered)));
    is_guess_ = is_guess_ && error < telling;
    if (is_stiff_) {
      calm_ = newton_.current([](const auto& e) { return e.stiffness(); }) < gentle ? calm_ + 1 : 0;
    } else {
      // In a problem that has become stiff every second trial takes many sweeps, or does not converge.
      const bool is_slow = trial_.iterations > many_sweeps;
      slow_ = is_slow && change > much ? slow_ + 2 : std::max(0, slow_ - 1);
      if (is_slow)
        change = std::min(change, std::pow(static_cast<double>(many_sweeps) / trial_.iterations, 0.7));
    }
    if ((is_stiff_ || !has_newton_) && change >= 1 && change < rest) change = 1;
    return std::clamp(change, 0.2, is_guess_ ? first_growth : most_growth);
  }

  double end_ = 0;
  int slow_ = 0, calm_ = 0;
  bool is_stiff_ = false, is_guess_ = true, has_newton_;
  Trial trial_{};
  Setup<S> strict_, setup_;
  Sweeps sweeps_;
  Newton newton_;
};

/// Sweeps of the three orders that the control chooses from.
template <class S, bool second>
using AllSweeps = Orders<Sweeper<S, 8, second>, Sweeper<S, 12, second>, Sweeper<S, 16, second>>;
/// Newton's steps of the three orders that the control chooses from.
template <class S>
using AllNewtonSteps = Orders<NewtonSteps<S, 3>, NewtonSteps<S, 5>, NewtonSteps<S, 7>>;

}  // namespace adaptive

/// Runs adaptive-collocation.
template <SystemLike S>
struct Integrator<S, AdaptiveCollocation> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const AdaptiveCollocation& method) {
    check_options(method);
    using namespace adaptive;
    if constexpr (has_halves<S::dimension>) {
      if (task.system.second_order() && task.system.size() % 2 == 0)
        return Run<S, AllSweeps<S, true>, AllNewtonSteps<S>>(task, method).run();
    }
    return Run<S, AllSweeps<S, false>, AllNewtonSteps<S>>(task, method).run();
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<AdaptiveCollocation> = InLibrary::all;
/// @endcond

}  // namespace nlmech::ivp
