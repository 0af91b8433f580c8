/// @file
/// Batches of the peers that vectorise, for every instruction set that our own kernel has.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/geodesy/instruction_set.hpp"

namespace nlmech::peers::geodesy {

/// `two_arctangents` is no method but the floor of all: load, the two arctangents that every method needs,
/// store.
enum class SimdMethod {
  two_arctangents,
  bowring1976_1,
  bowring1976_2,
  bowring1985_1,
  bowring1985_2,
  fukushima2006_1,
  fukushima2006_2
};
inline constexpr std::size_t simd_method_count = 7;

[[nodiscard]] std::string_view to_string(SimdMethod method) noexcept;

struct SimdArrays {
  const double *x, *y, *z;
  double *latitude, *longitude, *height;
  std::size_t size;  ///< a multiple of 8
};

/// Ellipsoid in units of its equatorial radius.
struct UnitEllipsoid {
  double a, inverse_a;
  double b, e2, second_e2;  ///< b/a, first and second eccentricity squared
};

using SimdBatch = void (*)(const UnitEllipsoid&, const SimdArrays&) noexcept;
using SimdTable = std::array<SimdBatch, simd_method_count>;

extern const SimdTable baseline_peers;
extern const SimdTable avx2_peers;
extern const SimdTable avx512_peers;

/// Runs @p method over the batch. @throws std::invalid_argument if the sizes differ or are no multiple of 8,
/// or if the processor does not have @p set
void run(SimdMethod method, nlmech::geodesy::InstructionSet set, const nlmech::geodesy::Ellipsoid& ellipsoid,
         std::span<const double> x, std::span<const double> y, std::span<const double> z,
         std::span<double> latitude, std::span<double> longitude, std::span<double> height);

}  // namespace nlmech::peers::geodesy
