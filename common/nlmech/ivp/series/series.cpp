#include "nlmech/ivp/series/series.hpp"

#include <utility>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/step_control.hpp"

namespace nlmech::ivp {

namespace taylor_series {
namespace {

/// The series of a step: coefficients in powers of tau = (t - t0)/T with a power of two for T.
class Expansion : public DenseOutput {
 public:
  /// @param system outlives the expansion
  Expansion(const System& system, int order)
      : taylor_(system.taylor(order)), size_(system.size()), order_(order), carry_(State::Zero(size_)) {}

  /// Starts an interval on which the right-hand side is smooth.
  void begin_segment(double begin, double end, const State& x) {
    segment_ = SmoothSegment(begin, end);
    taylor_.begin_segment(segment_(begin), x);
  }
  /// Computes the coefficients at (t, x) with T = @p scale.
  void expand(double t, const State& x, double scale) {
    t0_ = t;
    scale_ = scale;
    taylor_.expand(segment_(t), x, scale);
  }
  /// The last terms of the series. @param x the state at its start
  [[nodiscard]] Tail tail(const State& x, double atol, double rtol) const {
    Tail tail;
    for (int i = 0; i < size_; ++i) {
      const double* const c = taylor_.coefficients(i);
      tail.add(x[i], c[1], c[order_ - 1], c[order_], atol, rtol);
    }
    return tail;
  }
  /// Time at which to evaluate f for the time @p t; see SmoothSegment.
  [[nodiscard]] double inside(double t) const { return segment_(t); }

  /// The state @p x1 at t0 + @p h. The rounding error is stored for accept().
  void advance(double h, const State& x0, State& x1) {
    const double s = h / scale_;
    next_carry_.resize(size_);
    for (int i = 0; i < size_; ++i) {
      add_increment(x0[i], carry_[i], increment(taylor_.coefficients(i), order_, s), x1[i], next_carry_[i]);
    }
  }
  /// Continues from the end of the latest advance().
  void accept() { carry_ = next_carry_; }
  /// dx/dt of the series at t0 + @p h, component @p i.
  [[nodiscard]] double slope_at(double h, int i) const {
    return slope(taylor_.coefficients(i), order_, h / scale_) / scale_;
  }

  /// Dense output of the latest step.
  void at(double t, State& x) const override {
    x.resize(size_);
    const double s = (t - t0_) / scale_;
    for (int i = 0; i < size_; ++i) {
      const double* const c = taylor_.coefficients(i);
      x[i] = c[0] + increment(c, order_, s);
    }
  }
  /// The same series, shorter.
  [[nodiscard]] bool is_as_accurate_as_step() const override { return true; }
  /// By the sums of |c_k s^k|.
  bool bound_change(double t1, State& least, State& most) const override {
    most.resize(size_);
    const double s = (t1 - t0_) / scale_;
    for (int i = 0; i < size_; ++i) most[i] = largest_increment(taylor_.coefficients(i), order_, s);
    least = -most;
    return true;
  }

 private:
  TapedTaylor<System> taylor_;
  int size_, order_;
  SmoothSegment segment_;
  State carry_, next_carry_;
  double t0_ = 0, scale_ = 1;
};

/// Stepper of fixed step size and order.
class FixedStepper : public Stepper {
 public:
  /// @param problem outlives the stepper
  FixedStepper(const InitialValueProblem& problem, int order)
      : Stepper(problem.system.size()), expansion_(problem.system, order), order_(order) {}

  /// Name of the method.
  [[nodiscard]] std::string_view name() const { return Series::name; }
  /// See Stepper.
  void begin_segment(double begin, double end) {
    begin_ = begin;
    end_ = end;
    is_new_ = true;
  }
  /// Integrates from t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
    if (std::exchange(is_new_, false)) expansion_.begin_segment(begin_, end_, x0);
    expansion_.expand(t, x0, power_of_two(std::abs(h)));
    statistics.right_hand_sides += order_;
    if (!expansion_.tail(x0, 1, 0).is_finite()) return non_finite_coefficients(Series::name, t, order_);
    expansion_.advance(h, x0, x1);
    expansion_.accept();
    return {};
  }
  /// Dense output of the latest step.
  void at(double t, State& x) const override { expansion_.at(t, x); }

 private:
  Expansion expansion_;
  int order_;
  double begin_ = 0, end_ = 0;
  bool is_new_ = true;
};

/// One integration with adaptive steps.
class Run : public AdaptiveStepLoop<System, Run> {
 public:
  /// @param problem outlives the run
  Run(const InitialValueProblem& problem, const Rule& rule)
      : Base(problem, Series::name, Rule::steps),
        rule_(rule),
        log2_safety_(rule.log2_safety()),
        expansion_(problem.system, rule.order),
        next_(problem.x0),
        f_(problem.x0) {}

 private:
  using Base = AdaptiveStepLoop<System, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;
  using Base::problem_;
  using Base::take;

  Status begin(double end) {
    expansion_.begin_segment(now_.t, end, now_.x);
    problem_.system.rhs(expansion_.inside(now_.t), now_.x, f_);
    ++now_.statistics.right_hand_sides;
    if (!f_.allFinite()) return non_finite_rhs(Series::name, now_.t);
    scale_ = rule_.first_scale(now_.x, f_, std::abs(end - now_.t));
    before_ = 0;
    return {};
  }

  [[nodiscard]] bool expand(Tail& tail) {
    for (int attempt = 0; attempt < Rule::attempts; ++attempt) {
      expansion_.expand(now_.t, now_.x, scale_);
      now_.statistics.right_hand_sides += rule_.order;
      tail = expansion_.tail(now_.x, rule_.absolute_tolerance, rule_.relative_tolerance);
      if (tail.is_finite()) return true;
      scale_ = Rule::smaller(scale_);
    }
    return false;
  }
  // The step size follows from the coefficients, independent of the last step.
  Status prepare() {
    Tail tail;
    if (!expand(tail)) return non_finite_coefficients(Series::name, now_.t, rule_.order);
    const double length = rule_.length(tail, scale_, log2_safety_);
    is_tested_ = length > 2 * before_;
    control_.start(length);
    return {};
  }

  double attempt(double t1) {
    const double h = t1 - now_.t;
    expansion_.advance(h, now_.x, next_);
    return !is_tested_ || slope_agrees(t1, h) ? 0 : HUGE_VAL;
  }
  [[nodiscard]] double shorter(double /*error*/) const { return control_.taken() / 2; }
  [[nodiscard]] Status missed(double /*t1*/, double /*error*/) const {
    return step_underflow(Series::name, now_.t, control_.length());
  }

  [[nodiscard]] bool slope_agrees(double t1, double h) {
    if (!next_.allFinite()) return false;
    problem_.system.rhs(expansion_.inside(t1), next_, f_);
    ++now_.statistics.right_hand_sides;
    return rule_.slope_agrees(next_, f_, h, [&](int i) { return expansion_.slope_at(h, i); });
  }
  Status accept(double t1, double /*error*/) {
    if (!next_.allFinite()) return non_finite_state(Series::name, now_.t, t1 - now_.t);
    expansion_.accept();
    before_ = control_.taken();
    scale_ = Rule::next_scale(scale_, before_);
    return take(t1, next_, expansion_);
  }

  Rule rule_;
  double log2_safety_, scale_ = 1, before_ = 0;
  bool is_tested_ = true;
  Expansion expansion_;
  State next_, f_;
};

}  // namespace
}  // namespace taylor_series

int series_order(double relative_tolerance) {
  // Measured: above 1e-9 the fixed cost of a step equals that of its terms, so higher orders are cheaper.
  const double digits = -std::log(relative_tolerance);
  return std::min(static_cast<int>(std::ceil(std::max(1 + 0.75 * digits, 9 + 0.36 * digits))), 40);
}

void check_options(const Series& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 1e-18, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "step", method.step, 0, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
  if (method.order != 0) require_within(method.name, "order", method.order, 2, 100);
}

Solution run(const InitialValueProblem& problem, const Series& method) {
  check_options(method);
  const taylor_series::Rule rule = rule_of(method);
  if (method.step > 0) {
    taylor_series::FixedStepper stepper(problem, rule.order);
    return integrate_fixed_steps(problem, method.step, stepper);
  }
  return taylor_series::Run(problem, rule).run();
}

}  // namespace nlmech::ivp
