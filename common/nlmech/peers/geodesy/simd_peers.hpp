/// @file
/// Batches of the vectorised peers, for every instruction set of the nlmech kernel.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech::peers::geodesy {

/// Vectorised methods. `two_arctangents` is a lower limit of the cost of all methods: load, the two
/// arctangents that every method needs, store.
enum class SimdMethod {
  two_arctangents,
  bowring1976_1,
  bowring1976_2,
  bowring1985_1,
  bowring1985_2,
  fukushima2006_1,
  fukushima2006_2
};
/// Number of methods.
inline constexpr std::size_t simd_method_count = 7;

/// Name of a method: "Bowring 1976, 2 iterations".
[[nodiscard]] std::string_view to_string(SimdMethod method) noexcept;

/// Columns of points and of results.
struct SimdArrays {
  const double* x;    ///< m
  const double* y;    ///< m
  const double* z;    ///< m
  double* latitude;   ///< rad
  double* longitude;  ///< rad
  double* height;     ///< m
  std::size_t size;   ///< a multiple of 8
};

/// Ellipsoid in units of its equatorial radius.
struct UnitEllipsoid {
  double a;          ///< equatorial radius, m
  double inverse_a;  ///< 1/a
  double b;          ///< polar radius over a
  double e2;         ///< first eccentricity squared
  double second_e2;  ///< second eccentricity squared
};

/// One method compiled for one instruction set.
using SimdBatch = void (*)(const UnitEllipsoid&, const SimdArrays&) noexcept;
/// All methods of one instruction set, in the order of SimdMethod.
using SimdTable = std::array<SimdBatch, simd_method_count>;

/// Tables for each instruction set of the build.
/// @{
extern const SimdTable baseline_peers;
extern const SimdTable avx2_peers;
extern const SimdTable avx512_peers;
/// @}

/// Runs @p method over the batch. @throws std::invalid_argument if the sizes differ or are no multiple of 8,
/// or if the processor does not have @p set
void run(SimdMethod method, InstructionSet set, const nlmech::geodesy::Ellipsoid& ellipsoid,
         std::span<const double> x, std::span<const double> y, std::span<const double> z,
         std::span<double> latitude, std::span<double> longitude, std::span<double> height);

}  // namespace nlmech::peers::geodesy
