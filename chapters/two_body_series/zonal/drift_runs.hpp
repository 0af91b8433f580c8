/// @file
/// How energy and position drift over thousands of orbits.
#pragma once

#include <string>
#include <vector>

#include "nlmech/orbit/continuation.hpp"

namespace nlmech::chapters::two_body_series {

/// Analytic continuation on an ellipse, and how often.
struct DriftTask {
  std::string name;  ///< "compensated, divided"
  double eccentricity;
  int order;  ///< of the series; 0: adaptive
  int steps;  ///< an orbit
  bool compensated = true;
  bool true_division = true;
  double tolerance = 0;  ///< adaptive
  int phases = 8;        ///< mean anomalies at the start, equidistant
};

/// Root mean squares over the phases.
struct Drift {
  std::vector<int> orbits;
  std::vector<double> energy;    ///< of |E/E_0 - 1|
  std::vector<double> position;  ///< of |dr|/a

  /// Exponent of growth from 100 orbits on, by least squares of logarithms.
  [[nodiscard]] static double slope(const std::vector<int>& orbits, const std::vector<double>& errors);
};

/// Runs it to @p orbits. Energies in long double; positions against Kepler's solution in long double.
/// @throws Failure if a run fails
[[nodiscard]] Drift drift_of(const DriftTask& task, int orbits);

}  // namespace nlmech::chapters::two_body_series
