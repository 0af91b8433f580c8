/// @file
/// Error of the reverse transformation over latitude and height (Elgohary 2015, section 2.4.2 and Eq. 2.54).
#pragma once

#include <vector>

#include "nlmech/geodesy/perturbation.hpp"

namespace nlmech::chapters {

/// Largest magnitude on a grid, and where it stands.
struct Extreme {
  double magnitude = 0, latitude_deg = 0, height_km = 0;
};

/// Errors "true minus found" on a grid; `[i * latitudes + j]` belongs to height i and latitude j.
struct ErrorMap {
  std::vector<double> latitude_deg, height_km;
  std::vector<double> latitude_error_deg, height_error_m;
  Extreme latitude, height;
};

/// Arithmetic in which the transformation under test runs.
enum class Arithmetic {
  double_precision,
  extended  ///< 64-bit significand: shows the truncation error of the series below the rounding of doubles
};

/// Latitudes -90..90 deg in steps of 0.25 (quick: 1), heights 200..35000 km in 60 (quick: 30) equal ratios,
/// longitude 30 deg unless told. True positions come from Eq. 2.40 in extended precision, rounded to the
/// arithmetic under test.
[[nodiscard]] ErrorMap error_map(const geodesy::PerturbationSeries& method, const geodesy::SeriesTable& table,
                                 Arithmetic arithmetic, bool quick, double longitude_deg = 30);

}  // namespace nlmech::chapters
