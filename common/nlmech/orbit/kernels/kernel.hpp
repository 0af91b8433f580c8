/// @file
/// Interface of the Taylor kernels of all instruction sets: of single orbits, for AnalyticContinuation, and
/// of orbits in lanes, for propagate_all(). Internal.
#pragma once

#include <cstdint>

namespace nlmech::orbit::kernels {

/// The smallest and largest order with unrolled sums, and the largest order at all.
inline constexpr int least_unrolled = 4, most_unrolled = 40, most = 100;

/// Taylor coefficients of the position, r(t + h) = sum over k of row[k] h^k; x, y, z and a pad.
struct alignas(64) Coefficients {
  double row[most + 1][4];
};

/// A state and the rounding errors of its sums; x, y, z and a pad.
struct alignas(64) Body {
  double position[4], velocity[4], position_low[4], velocity_low[4];
};

/// Functions for the unperturbed problem r'' = -mu r / |r|^3.
struct Kernel {
  /// Rows 0 to @p order, from least_unrolled to most_unrolled, out of rows 0 and 1.
  void (*expand)(double mu, int order, Coefficients& c) noexcept;
  /// What position and velocity (x, y, z, pad) change by within @p h, from rows 1 to @p order; any order
  /// from 2.
  void (*increments)(const Coefficients& c, int order, double h, double* position, double* velocity) noexcept;
  /// Adds them to a state.
  void (*advance)(const Coefficients& c, int order, double h, bool compensated, Body& body) noexcept;
};

extern const Kernel baseline_kernel;
extern const Kernel avx2_kernel;
extern const Kernel avx512_kernel;

/// Orders of the ensemble kernel: even ones, from the least to the largest.
inline constexpr int least_ensemble_order = 8, most_ensemble_order = 32;

/// A step longer or shorter than so much of the lane's unit asks for others. To the 80th power, in a square
/// of the last coefficient, it stays within doubles.
inline constexpr double most_lane_drift = 512;

/// Lanes of the widest kernel.
inline constexpr int most_lanes = 16;

/// One number a lane.
struct alignas(64) Row {
  double lane[most_lanes];
};

/// Orbits side by side, each in units of its own. The kernel reads and writes all rows.
struct LaneBlock {
  Row position[3];      ///< now
  Row velocity[3];      ///< now
  Row position_low[3];  ///< rounding errors of its sums
  Row velocity_low[3];  ///< rounding errors of its sums
  Row mu;               ///< gravitational parameter
  Row remaining;        ///< time to go, positive
  Row remaining_low;    ///< the rest of it: both together are exact
  Row least_step;       ///< a shorter one is lost in the time
  Row step;             ///< length of the latest step
  Row chosen;           ///< the same without regard to the end
  Row next_row;         ///< time from now to the next row asked for, or 1e300
  // The latest step in which a row was due, for what lies within it.
  Row first_position[3];                ///< where it began
  Row first_velocity[3];                ///< where it began
  Row first[most_ensemble_order + 1];   ///< coefficients of the first universal function in time
  Row second[most_ensemble_order + 1];  ///< and of the second
};

/// What is the same for all lanes and orbits.
struct LaneSettings {
  int order = 0;             ///< even
  double wanted = 0;         ///< 2 log2 of the tolerance
  double longest = 0;        ///< log2 of the longest step in units of r over speed
  double last_weight = 0;    ///< 2 log2 of the order ...
  double last_power = 0;     ///< ... and 1/2 over the order less one
  double before_weight = 0;  ///< the same for the order before
  double before_power = 0;   ///< the same for the order before
};

/// Lanes in which something happened, one bit each.
struct LaneEvents {
  unsigned arrived = 0;    ///< nothing remains
  unsigned lost = 0;       ///< the step is lost in the time, or no number: the lane stands where it was
  unsigned row_due = 0;    ///< the next row lies within the step
  unsigned drifted = 0;    ///< the step is far from 1 in units of the lane
  std::int64_t steps = 0;  ///< made by every lane that is not lost
};

/// Steps all lanes until something happens in one, at most @p limit times.
using EnsembleSteps = LaneEvents (*)(LaneBlock& block, const LaneSettings& settings,
                                     std::int64_t limit) noexcept;

/// One kernel.
struct EnsembleKernel {
  int lanes;            ///< how many, at most most_lanes
  EnsembleSteps steps;  ///< see there
};

extern const EnsembleKernel baseline_ensemble;
extern const EnsembleKernel avx2_ensemble;
extern const EnsembleKernel avx512_ensemble;

}  // namespace nlmech::orbit::kernels
