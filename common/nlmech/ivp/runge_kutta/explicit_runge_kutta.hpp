/// @file
/// Explicit Runge-Kutta methods with fixed steps: Euler, the classical method of order 4, Butcher's of order
/// 6.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/runge_kutta/weighted.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

/// Coefficients of an explicit method: stage i is at c[i] and uses a[i][0..i-1]; the weights are b.
///
/// Tests assert the orders 1, 4 and 6 of Euler, Rk4 and Rk6 on Duffing's oscillator (observed within 0.1),
/// and the sums of their rows and weights (4e-16).
template <std::size_t s>
struct Tableau {
  static constexpr std::size_t stages = s;  ///< number of stages
  std::array<double, s> c;                  ///< abscissae
  std::array<std::array<double, s>, s> a;   ///< strictly lower triangle
  std::array<double, s> b;                  ///< weights
};

/// Forward Euler, order 1 (Elgohary 2015, Eq. 4.3). Dense output of the same order: a shorter step.
struct Euler {
  static constexpr std::string_view name = "euler";      ///< on command lines and in tables
  static constexpr Tableau<1> tableau = {{0}, {}, {1}};  ///< coefficients
  double step = 0.01;                                    ///< step size, positive
};

/// The classical method of order 4 (W. Kutta 1901). Dense output of the same order: a shorter step.
struct Rk4 {
  static constexpr std::string_view name = "rk4";  ///< on command lines and in tables
  /// Coefficients.
  static constexpr Tableau<4> tableau = {
      {0, 0.5, 0.5, 1}, {{{}, {0.5}, {0, 0.5}, {0, 0, 1}}}, {1. / 6, 1. / 3, 1. / 3, 1. / 6}};
  double step = 0.01;  ///< step size, positive
};

/// Order 6 in 7 stages (J. C. Butcher, On Runge-Kutta processes of high order, J. Austral. Math. Soc. 4
/// (1964) 179-194). Dense output of the same order: a shorter step.
struct Rk6 {
  static constexpr std::string_view name = "rk6";  ///< on command lines and in tables
  /// Coefficients.
  static constexpr Tableau<7> tableau = {{0, 1. / 3, 2. / 3, 1. / 3, 1. / 2, 1. / 2, 1},
                                         {{{},
                                           {1. / 3},
                                           {0, 2. / 3},
                                           {1. / 12, 1. / 3, -1. / 12},
                                           {-1. / 16, 9. / 8, -3. / 16, -3. / 8},
                                           {0, 9. / 8, -3. / 8, -3. / 4, 1. / 2},
                                           {9. / 44, -9. / 11, 63. / 44, 18. / 11, 0, -16. / 11}}},
                                         {11. / 120, 0, 27. / 40, 27. / 40, -4. / 15, -4. / 15, 11. / 120}};
  double step = 0.01;  ///< step size, positive
};

/// Euler, Rk4, Rk6, or a method of the user: an aggregate with name, tableau and step.
template <class M>
concept ExplicitMethod = requires(const M& method) {
  M::tableau.stages;
  M::name;
  method.step;
};

/// Row @p i of a method's tableau, and its weights, as objects for add_stages().
/// @{
template <class M, std::size_t i>
inline constexpr auto row_of = M::tableau.a[i];
template <class M>
inline constexpr auto weights_of = M::tableau.b;
/// @}

/// Stepper of an explicit method; it owns the stages.
template <SystemLike S, ExplicitMethod M>
class ExplicitStepper : public StepperOf<S> {
 public:
  using State = typename S::State;  ///< all components
  /// @param system outlives the stepper
  explicit ExplicitStepper(const S& system)
      : StepperOf<S>(system.size()), system_(system), argument_(system.size()), x0_(system.size()) {
    for (State& k : k_) k.resize(system.size());
  }
  /// Name of the method.
  [[nodiscard]] static std::string_view name() { return M::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// Integrates from t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
    t0_ = t;
    x0_ = x0;
    advance(t, h, x0, x1);
    statistics.right_hand_sides += stages;
    return {};
  }

  /// Dense output: a step of size t - t0 from the start of the latest step, as accurate as the method.
  void at(double t, State& x) const override {
    ExplicitStepper shorter(system_);
    shorter.segment_ = segment_;
    x.resize(x0_.size());
    shorter.advance(t0_, t - t0_, x0_, x);
  }

 private:
  static constexpr std::size_t stages = M::tableau.stages;

  template <std::size_t i>
  [[gnu::always_inline]] void stage(double t, double h, const State& x0) {
    const double time = segment_(t + M::tableau.c[i] * h);
    if constexpr (i == 0) {
      system_.rhs(time, x0, k_[0]);
    } else {
      add_stages<row_of<M, i>, i>(x0, h, k_, argument_);
      system_.rhs(time, argument_, k_[i]);
    }
  }
  void advance(double t, double h, const State& x0, State& x1) {
    [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
      (stage<i>(t, h, x0), ...);
    }
    (std::make_index_sequence<stages>());
    add_stages<weights_of<M>, stages>(x0, h, k_, x1);
  }

  const S& system_;
  SmoothSegment segment_;
  std::array<State, stages> k_;
  State argument_, x0_;
  double t0_ = 0;
};

/// See integrate().
template <SystemLike S, ExplicitMethod M>
[[nodiscard]] SolutionOf<S> run(const InitialValueProblemOf<S>& problem, const M& method) {
  require_step(M::name, method.step);
  ExplicitStepper<S, M> stepper(problem.system);
  return integrate_fixed_steps(problem, method.step, stepper);
}

/// Overload for System, compiled in the library.
/// @{
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Euler& method);
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Rk4& method);
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Rk6& method);
/// @}

}  // namespace nlmech::ivp
