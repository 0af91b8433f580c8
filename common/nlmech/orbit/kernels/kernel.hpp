/// @file
/// The face that the Taylor kernels of all instruction sets show to AnalyticContinuation. Internal.
#pragma once

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

}  // namespace nlmech::orbit::kernels
