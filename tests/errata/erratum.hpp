/// @file
/// Evidence for an entry of `tables/errata/<chapter>.csv`: the printed and the corrected form as numbers,
/// against an oracle that uses neither.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string_view>

namespace nlmech::tests {

/// Three numbers for the same quantity.
struct Evidence {
  double printed = 0;    ///< the printed form, taken literally; may be NaN if that is its error
  double corrected = 0;  ///< the corrected form
  double oracle = 0;  ///< the same quantity by other means: closed form, extended precision, other equations
  double tolerance = 0;  ///< tolerance of the corrected form from the oracle, in units of `scale`
  double scale = 0;      ///< unit of distances; 0: the oracle's magnitude, or 1 if that is zero
};

/// Smallest error of a printed form in tolerances: excludes rounding errors.
inline constexpr double clearly = 10;

/// Expects the corrected form within the tolerance and the printed one at least ten tolerances away, and says
/// so in a line that the test of the lists reads: `erratum ID misses X within Y`. An entry may have several.
/// @param id  the entry's name, unique over all chapters, such as "homotopy-2.20"
inline void expect_erratum(std::string_view id, const Evidence& e) {
  const double scale = e.scale > 0 ? e.scale : e.oracle != 0 ? std::abs(e.oracle) : 1;
  const double printed = std::abs(e.printed - e.oracle) / scale;
  const double corrected = std::abs(e.corrected - e.oracle) / scale;
  EXPECT_GT(e.tolerance, 0) << id;
  EXPECT_LE(corrected, e.tolerance) << id << ": corrected " << e.corrected << ", oracle " << e.oracle;
  EXPECT_FALSE(printed <= clearly * e.tolerance)
      << id << ": printed " << e.printed << ", oracle " << e.oracle;
  std::printf("erratum %.*s misses %.2g within %.2g\n", static_cast<int>(id.size()), id.data(), printed,
              e.tolerance);
}

}  // namespace nlmech::tests
