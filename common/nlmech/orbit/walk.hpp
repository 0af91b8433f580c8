/// @file
/// The walk from step to step that both kinds of analytic continuation share. Internal to the component.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kernels/kernel.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::orbit::detail {

/// What a walk needs to know of its method.
struct WalkOptions {
  std::string_view name;                       ///< of the method, in sentences
  int most_order;                              ///< largest degree that it will ask for
  bool compensated;                            ///< carry rounding errors
  bool kernel;                                 ///< may the unrolled kernels be used?
  bool true_division;                          ///< see FixedContinuation
  std::optional<InstructionSet> instructions;  ///< of the kernels
};

/// State, time and series on the way. All numbers are in units 2^a of length and 2^b of time, which follow
/// the body where its time scale changes by much: powers of two change no digit.
class Walk : public BasicDenseOutput<State> {
 public:
  Walk(const State& start, double t0, double t1, const Gravity& gravity, const WalkOptions& options,
       const Observer& observer, const Limits& limits);

  /// The series about the state, to degree @p order.
  void expand(int order);
  /// Moves by @p h in the walk's units, by the series of position and velocity to these degrees.
  void advance(double h, int position_degree, int velocity_degree);
  /// Ends the step: time, observer, limits. @p h in the walk's units, and whether it leads to the end.
  [[nodiscard]] Status finish(double h, bool last);
  /// A step's length in user's units.
  [[nodiscard]] double in_time(double h) const { return h * time_unit_; }
  /// Distance to the end in the walk's units, with sign.
  [[nodiscard]] double remaining() const { return ((t1_ - t_) - t_low_) / time_unit_; }
  /// Is a step this short lost in the time?
  [[nodiscard]] bool is_lost(double h) const {
    const double scale = std::max({std::abs(t_), std::abs(t1_), std::abs(t1_ - t0_)});
    return !(std::abs(in_time(h)) > std::numeric_limits<double>::epsilon() * scale);
  }
  /// The failure for it: a collision, if the body is on its way into the centre.
  [[nodiscard]] Status lost(double h) const;
  /// |r_k|^2 of the latest series.
  [[nodiscard]] double square_of(int k) const { return square(series_.row[k]); }
  /// Square of the larger of |v| and the circular speed.
  [[nodiscard]] double speed_square() const {
    return std::max(square(body_.velocity), mu_ / std::sqrt(square(body_.position)));
  }
  /// Is the body so fast that gravity hardly shows in the series? Then it says nothing of its convergence.
  [[nodiscard]] bool is_fast() const {
    return square(body_.velocity) > 1e3 * (mu_ / std::sqrt(square(body_.position)));
  }
  /// Chooses units anew if the last step, @p h, says that the time scale is no longer theirs.
  void follow_units(double h) {
    if (!(std::abs(h) < most_drift && std::abs(h) > 1 / most_drift)) choose_units();
  }
  /// Exponent of the cost in the order: by how many per cent work grows when the order grows by one per cent.
  [[nodiscard]] double cost_exponent() const;
  /// Has the walk arrived (or nowhere to go)?
  [[nodiscard]] bool arrived() const { return t_ == t1_; }
  /// The result.
  [[nodiscard]] Solution result(Status status) const;

  /// By the latest series; beyond the step too, as far as it converges.
  void at(double t, State& x) const override;

 private:
  /// To the 200th power, in a square of the last coefficient, it stays within doubles.
  static constexpr double most_drift = 16;

  static double square(const double* x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }
  void choose_units();
  [[nodiscard]] bool unrolled(int order) const;
  [[nodiscard]] State user_state() const;

  WalkOptions options_;
  const Observer& observer_;
  const Limits& limits_;
  Gravity gravity_;  ///< in the user's units
  const kernels::Kernel* kernel_;
  kernels::Body body_{};
  kernels::Coefficients series_{};
  std::optional<Expansion<double>> expansion_;  ///< made when it is needed
  double t_, t_low_ = 0, t1_, t0_, start_radius_;
  int length_exponent_ = 0, time_exponent_ = 0;
  double length_unit_ = 1, time_unit_ = 1, mu_ = 1;
  int order_ = 0, position_degree_ = 0, velocity_degree_ = 0;
  double step_begin_ = 0;
  State before_;
  Statistics statistics_;
  Stopwatch watch_;
};

}  // namespace nlmech::orbit::detail
