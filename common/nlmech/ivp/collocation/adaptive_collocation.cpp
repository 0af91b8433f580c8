#include "nlmech/ivp/collocation/adaptive_collocation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/collocation/collocation_newton.hpp"
#include "nlmech/ivp/collocation/collocation_sweeps.hpp"
#include "nlmech/ivp/failures.hpp"

namespace nlmech::ivp {

void check_options(const AdaptiveCollocation& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 0, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
  require_within(method.name, "shape", method.shape, 0, largest);
  if (method.nodes != 0 && method.nodes != 9 && method.nodes != 13 && method.nodes != 17)
    throw std::invalid_argument(
        fmt::format("{}: nodes must be 9, 13 or 17 (0: by the tolerance), is {}", method.name, method.nodes));
}

namespace adaptive {
namespace {

/// Order control: one engine in several orders, with the interface of the engine. After each step the engine
/// decides whether a neighbouring order is cheaper, which then continues from its trial function.
/// @tparam Engine engines of increasing order for the same system
template <class... Engine>
class Orders {
 public:
  static constexpr int count = sizeof...(Engine);  ///< number of orders

  /// @param order first order, from 0
  /// @param is_fixed is the order constant?
  Orders(const Setup& setup, int order, bool is_fixed)
      : engines_(for_each_of<Engine>(setup)...), order_(order), is_fixed_(is_fixed) {}

  /// Calls @p work with the current engine and returns its result.
  template <class Work>
  decltype(auto) current(Work&& work) {
    return at<0>(*this, order_, work);
  }
  /// The same for a constant engine.
  template <class Work>
  decltype(auto) current(Work&& work) const {
    return at<0>(*this, order_, work);
  }

  /// See the engine.
  void begin_segment(double t, double end, const State& x, Statistics& statistics) {
    current([&](auto& e) { e.begin_segment(t, end, x, statistics); });
    steps_ = 0;
  }
  /// See the engine.
  Trial attempt(double t, double t1, Statistics& statistics) {
    return current([&](auto& e) { return e.attempt(t, t1, statistics); });
  }
  /// Power of the step size in the error estimate.
  [[nodiscard]] int error_order() const {
    return current([](const auto& e) { return e.error_order(); });
  }
  /// Accepts the trial and changes the order if another one is cheaper.
  void accept(Statistics& statistics) {
    const int better = current([&](auto& e) {
      const int change = e.better_order();
      e.accept(statistics);
      return change;
    });
    ++steps_;
    const int next = std::clamp(order_ + better, 0, count - 1);
    if (is_fixed_ || next == order_ || steps_ < max_slow_trials) return;
    current([&](const auto& from) {
      at<0>(*this, next, [&](auto& to) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(to)>, std::decay_t<decltype(from)>>)
          to.continue_from(from);
      });
    });
    order_ = next;
    steps_ = 0;
  }

 private:
  static constexpr int max_slow_trials = 4;  // steps with an order before the next change

  template <class>
  static const Setup& for_each_of(const Setup& setup) {
    return setup;
  }
  template <int i, class Self, class Work>
  static decltype(auto) at(Self& self, int order, Work&& work) {
    if constexpr (i + 1 < count) {
      if (order != i) return at<i + 1>(self, order, work);
    }
    return work(std::get<static_cast<std::size_t>(i)>(self.engines_));
  }

  std::tuple<Engine...> engines_;
  int order_;
  bool is_fixed_;
  int steps_ = 0;
};

// First order of an integration: by the option `nodes`, or by the tolerance.
int first_order(const AdaptiveCollocation& method) {
  if (method.nodes > 0) return (method.nodes - 9) / 4;
  // Tolerances below which 13 and 17 nodes are cheaper, for problems of a few components.
  if (method.relative_tolerance > 3e-6) return 0;
  return method.relative_tolerance > 3e-11 ? 1 : 2;
}

/// One integration. It starts with sweeps, changes to Newton's iteration when their contraction limits the
/// step size more than the error does, and changes back when the steps are short against the time constants.
template <class Sweeps, class Newton>
class Run : public AdaptiveStepLoop<System, Run<Sweeps, Newton>> {
 public:
  /// @param problem outlives the run
  Run(const InitialValueProblem& problem, const AdaptiveCollocation& method)
      : Base(problem, AdaptiveCollocation::name,
             {.largest = method.largest_step > 0 ? method.largest_step : std::abs(problem.t1 - problem.t0),
              .most_change = HUGE_VAL,
              .kept_from = 0}),
        has_newton_(!(method.shape > 0)),
        strict_{problem.system,
                {tolerance_factor * method.absolute_tolerance, tolerance_factor * method.relative_tolerance},
                method.shape},
        setup_{problem.system, {method.absolute_tolerance, method.relative_tolerance}},
        sweeps_(strict_, first_order(method), method.nodes > 0),
        newton_(setup_, first_order(method), method.nodes > 0) {}

 private:
  using Base = AdaptiveStepLoop<System, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;

  static constexpr std::string_view name = AdaptiveCollocation::name;
  // Fraction of the tolerance for a step of sweeps: errors of an oscillation accumulate.
  static constexpr double tolerance_factor = 0.1;
  static constexpr double safety = 0.85;         // safety factor of sweeps
  static constexpr double safety_newton = 0.93;  // of Newton's iteration, whose estimate is mostly too large
  static constexpr double rest = 1.2;            // smallest factor by which a step size is increased
  static constexpr int many_sweeps = 8;          // more sweeps cost more than shorter steps
  static constexpr double most_growth = 2;       // largest factor on the step size
  static constexpr double first_growth = 8;      // the same for the first steps, whose size is a guess
  static constexpr double significant_error = 1e-8;  // error above which the step size is no guess
  static constexpr double least_remembered = 0.01;   // smallest error to remember: errors pass through zero
  static constexpr int max_slow_trials = 4;  // twice the number of slow trials before Newton's iteration
  static constexpr double strong_growth =
      1.5;  // factor that the error allows on a step size limited by sweeps
  static constexpr int steps_before_sweeps = 20;  // steps short against the time constants before sweeps
  static constexpr double nonstiff_limit = 1;     // largest h |J| of such steps
  // Calls @p work with the current engine; both have the same interface.
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
    nonstiff_steps_ = 0;
  }

  double attempt(double t1) {
    if (is_stiff_ ? nonstiff_steps_ >= steps_before_sweeps : has_newton_ && slow_ >= max_slow_trials) {
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

  // Factor on the step size for the next step, by the error and by the iterations.
  [[nodiscard]] double growth(double error) {
    double change = control_.change(safe(), root(error), root(std::max(error, least_remembered)));
    is_guess_ = is_guess_ && error < significant_error;
    if (is_stiff_) {
      nonstiff_steps_ = newton_.current([](const auto& e) { return e.stiffness(); }) < nonstiff_limit
                            ? nonstiff_steps_ + 1
                            : 0;
    } else {
      // In a problem that becomes stiff every second trial takes many sweeps or does not converge. Two such
      // trials suffice: with more, sweeps dominate the cost of a problem such as HIRES.
      const bool is_slow = trial_.iterations > many_sweeps;
      slow_ = is_slow && change > strong_growth ? slow_ + 2 : std::max(0, slow_ - 1);
      if (is_slow)
        change = std::min(change, std::pow(static_cast<double>(many_sweeps) / trial_.iterations, 0.7));
    }
    if ((is_stiff_ || !has_newton_) && change >= 1 && change < rest) change = 1;
    return std::clamp(change, 0.2, is_guess_ ? first_growth : most_growth);
  }

  double end_ = 0;
  int slow_ = 0, nonstiff_steps_ = 0;
  bool is_stiff_ = false, is_guess_ = true, has_newton_;
  Trial trial_{};
  Setup strict_, setup_;
  Sweeps sweeps_;
  Newton newton_;
};

/// Sweeps of the three orders.
template <bool second>
using AllSweeps = Orders<Sweeper<8, second>, Sweeper<12, second>, Sweeper<16, second>>;
/// Newton's iteration of the three orders.
using AllNewtonSteps = Orders<NewtonSteps<3>, NewtonSteps<5>, NewtonSteps<7>>;

}  // namespace
}  // namespace adaptive

Solution run(const InitialValueProblem& problem, const AdaptiveCollocation& method) {
  check_options(method);
  using namespace adaptive;
  if (problem.system.second_order() && problem.system.size() % 2 == 0)
    return Run<AllSweeps<true>, AllNewtonSteps>(problem, method).run();
  return Run<AllSweeps<false>, AllNewtonSteps>(problem, method).run();
}

}  // namespace nlmech::ivp
