/// @file
/// Interface of the Taylor kernels of all instruction sets: single orbits for AnalyticContinuation,
/// vectorised orbits for propagate_all(). Internal.
#pragma once

#include <cstdint>

namespace nlmech::orbit::kernels {

/// Smallest and largest order with unrolled sums, and largest order.
inline constexpr int least_unrolled = 4, most_unrolled = 40, most = 100;

/// A state and the rounding errors of its sums; x, y, z and padding.
struct alignas(64) Body {
  double position[4], velocity[4], position_low[4], velocity_low[4];
};

/// Taylor series of a Kepler orbit: r(t + h) = r + G(h) first + H(h) second with first = v and second =
/// -(mu/|r|) r. Row m has the coefficients 2 m and 2 m + 1: G_2m, H_2m, G_2m+1, H_2m+1.
struct alignas(64) Series {
  double value[most_unrolled / 2 + 1][4];  ///< of G and H
  double rate[most_unrolled / 2 + 1][4];   ///< of G' and H': G_k and H_k times k
  double first[4], second[4];              ///< x, y, z and padding
};

/// Kernel functions for the unperturbed problem r'' = -mu r / |r|^3.
struct Kernel {
  /// Computes the series about a state to @p order, from least_unrolled to most_unrolled.
  void (*expand)(double mu, int order, const Body& body, Series& s) noexcept;
  /// Changes of position and velocity (x, y, z, padding) in the time @p h, with the order of expand().
  void (*increments)(const Series& s, int order, double h, double* position, double* velocity) noexcept;
  /// Adds these changes to a state.
  void (*advance)(const Series& s, int order, double h, bool compensated, Body& body) noexcept;
};

extern const Kernel baseline_kernel;
extern const Kernel avx2_kernel;
extern const Kernel avx512_kernel;

/// Smallest and largest order of the ensemble kernel; orders are even.
inline constexpr int least_ensemble_order = 8, most_ensemble_order = 32;

/// Ratio of step size and time unit of a lane (or its inverse) above which units are changed. Its 80th power,
/// in the square of the last coefficient, does not overflow.
inline constexpr double most_lane_drift = 512;

/// Number of lanes of the widest kernel.
inline constexpr int most_lanes = 16;

/// One number per lane.
struct alignas(64) Row {
  double lane[most_lanes];
};

/// States of the orbits in all lanes, each in its own units. The kernel reads and writes all rows.
struct LaneBlock {
  Row position[3];      ///< now
  Row velocity[3];      ///< now
  Row position_low[3];  ///< rounding errors of its sums
  Row velocity_low[3];  ///< rounding errors of its sums
  Row mu;               ///< gravitational parameter
  Row remaining;        ///< remaining time, positive
  Row remaining_low;    ///< low-order part of the remaining time; the sum is exact
  Row least_step;       ///< a shorter step is lost in the time
  Row step;             ///< size of the latest step
  Row chosen;           ///< step size before limiting by the end
  Row next_row;         ///< time from now to the next output row, or 1e300
  // Data of the latest step with a due row, for dense output.
  Row first_position[3];                ///< where it began
  Row first_velocity[3];                ///< where it began
  Row first[most_ensemble_order + 1];   ///< Taylor coefficients of the first universal function
  Row second[most_ensemble_order + 1];  ///< Taylor coefficients of the second universal function
};

/// Settings common to all lanes and orbits.
struct LaneSettings {
  int order = 0;             ///< even
  double wanted = 0;         ///< 2 log2 of the tolerance
  double longest = 0;        ///< log2 of the largest step size in units of r/|v|
  double last_weight = 0;    ///< 2 log2(order) ...
  double last_power = 0;     ///< 0.5/(order - 1)
  double before_weight = 0;  ///< 2 log2(order - 1)
  double before_power = 0;   ///< 0.5/(order - 2)
};

/// Events of the lanes, one bit per lane.
struct LaneEvents {
  unsigned arrived = 0;    ///< the end is reached
  unsigned lost = 0;       ///< the step is lost in the time or not finite; the state is unchanged
  unsigned row_due = 0;    ///< the next output row lies within the step
  unsigned drifted = 0;    ///< the step size is far from 1 in units of the lane
  std::int64_t steps = 0;  ///< steps of every lane that is not lost
};

/// Takes steps in all lanes until an event in one of them, at most @p limit.
using EnsembleSteps = LaneEvents (*)(LaneBlock& block, const LaneSettings& settings,
                                     std::int64_t limit) noexcept;

/// Ensemble kernel of one instruction set.
struct EnsembleKernel {
  int lanes;            ///< number of lanes, at most most_lanes
  EnsembleSteps steps;  ///< the step function
};

extern const EnsembleKernel baseline_ensemble;
extern const EnsembleKernel avx2_ensemble;
extern const EnsembleKernel avx512_ensemble;

}  // namespace nlmech::orbit::kernels
