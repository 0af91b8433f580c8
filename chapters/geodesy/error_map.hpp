/// @file
/// Error of the reverse transformation over latitude and height (Elgohary 2015, section 2.4.2 and Eq. 2.54).
#pragma once

#include <vector>

#include "nlmech/geodesy/perturbation.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::geodesy {

/// Largest magnitude on a grid and its position.
struct Extreme {
  double magnitude = 0, latitude_deg = 0, height_km = 0;
};

/// Errors "true minus found" on a grid; `[i * latitudes + j]` belongs to height i and latitude j.
struct ErrorMap {
  std::vector<double> latitude_deg, height_km;
  std::vector<double> latitude_error_deg, height_error_m;
  Extreme latitude, height;
};

/// Variants of the series.
enum class Form {
  corrected,  ///< corrected coefficients, double precision
  extended,   ///< corrected coefficients, 64-bit significand: truncation error only
  projected,  ///< height by projection instead of by the series
  printed,    ///< Table 2.6 as printed, with C8's equals sign and C9's dimension corrected; orders up to 4
  literal     ///< `printed` with the last term of C9 as printed, b in metres
};

/// Latitudes -90..90 deg in steps of 0.25 (quick: 2), heights 200..35000 km in 60 (quick: 30) equal ratios.
/// True positions by Eq. 2.40 in extended precision, rounded to the arithmetic under test.
[[nodiscard]] ErrorMap error_map(Form form, int order, bool quick, double longitude_deg = 30);

/// error_map() as a result of the chapter.
[[nodiscard]] scene::Result<ErrorMap> map_of(Form form, int order);

}  // namespace nlmech::chapters::geodesy
