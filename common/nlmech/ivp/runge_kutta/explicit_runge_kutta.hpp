/// @file
/// Explicit Runge-Kutta methods of fixed step: Euler, the classical one of order 4, Butcher's of order 6.
#pragma once

#include <array>
#include <string_view>

#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

/// Coefficients of an explicit method: stage i is at c[i] and uses a[i][0..i-1]; weights b.
///
/// Tests hold Euler, Rk4 and Rk6 to the orders 1, 4 and 6 on Duffing's oscillator, observed within 0.1, and
/// the sums of their rows and weights to 4e-16.
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
  double step = 0.01;                                    ///< length of a step, positive
};

/// The classical method of order 4 (W. Kutta 1901). Dense output of the same order: a shorter step.
struct Rk4 {
  static constexpr std::string_view name = "rk4";  ///< on command lines and in tables
  /// Coefficients.
  static constexpr Tableau<4> tableau = {
      {0, 0.5, 0.5, 1}, {{{}, {0.5}, {0, 0.5}, {0, 0, 1}}}, {1. / 6, 1. / 3, 1. / 3, 1. / 6}};
  double step = 0.01;  ///< length of a step, positive
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
  double step = 0.01;  ///< length of a step, positive
};

/// Euler, Rk4, Rk6, or a user's own: an aggregate with name, tableau and step.
template <class M>
concept ExplicitMethod = requires(const M& method) {
  M::tableau.stages;
  M::name;
  method.step;
};

/// One step of an explicit method; the stages live in the stepper.
template <SystemLike S, ExplicitMethod M>
class ExplicitStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;  ///< components of the state
  /// @param system outlives the stepper
  explicit ExplicitStepper(const S& system)
      : Stepper<n>(system.size()), system_(system), argument_(system.size()), x0_(system.size()) {
    for (State<n>& k : k_) k.resize(system.size());
  }
  /// The method's.
  [[nodiscard]] static std::string_view name() { return M::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// From t to t + h.
  Status step(double t, double h, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    t0_ = t;
    x0_ = x0;
    advance(t, h, x0, x1);
    statistics.right_hand_sides += stages;
    return {};
  }

  /// A step of the length t - t0 from the begin of the latest step: as accurate as the method itself.
  void at(double t, State<n>& x) const override {
    ExplicitStepper shorter(system_);
    shorter.segment_ = segment_;
    shorter.advance(t0_, t - t0_, x0_, x);
  }

 private:
  static constexpr std::size_t stages = M::tableau.stages;

  void advance(double t, double h, const State<n>& x0, State<n>& x1) {
    for (std::size_t i = 0; i < stages; ++i) {
      argument_ = x0;
      for (std::size_t j = 0; j < i; ++j) {
        if (M::tableau.a[i][j] != 0) argument_ += (h * M::tableau.a[i][j]) * k_[j];
      }
      system_.rhs(segment_(t + M::tableau.c[i] * h), argument_, k_[i]);
    }
    x1 = x0;
    for (std::size_t i = 0; i < stages; ++i) {
      if (M::tableau.b[i] != 0) x1 += (h * M::tableau.b[i]) * k_[i];
    }
  }

  const S& system_;
  SmoothSegment segment_;
  std::array<State<n>, stages> k_;
  State<n> argument_, x0_;
  double t0_ = 0;
};

/// Runs an explicit method.
template <SystemLike S, ExplicitMethod M>
struct Integrator<S, M> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const M& method) {
    require_step(M::name, method.step);
    ExplicitStepper<S, M> stepper(task.system);
    return walk(task, method.step, stepper);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<Euler> = InLibrary::all;
template <>
inline constexpr InLibrary in_library<Rk4> = InLibrary::all;
template <>
inline constexpr InLibrary in_library<Rk6> = InLibrary::all;
/// @endcond

}  // namespace nlmech::ivp
