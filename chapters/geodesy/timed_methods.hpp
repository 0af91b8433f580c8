/// @file
/// nlmech and peer methods, each as a pass over columns of points, for the scenes and the benchmark.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech::chapters::geodesy {

/// Input and result columns of points.
struct Points {
  explicit Points(std::size_t n) : x(n), y(n), z(n), latitude(n), longitude(n), height(n) {}
  [[nodiscard]] nlmech::geodesy::Cartesian at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const nlmech::geodesy::Geodetic& g) {
    latitude[i] = g.latitude;
    longitude[i] = g.longitude;
    height[i] = g.height;
  }
  std::vector<double> x, y, z, latitude, longitude, height;
};

/// @p n points (a multiple of 8), uniform on the sphere: half at heights from -5 to 100 km, half from 0 to
/// 35000 km. Each coordinate is perturbed by up to a millimetre. Without that the exact angles would be close
/// to doubles, and all methods would appear more accurate.
[[nodiscard]] Points sample_points(std::size_t n, const nlmech::geodesy::Ellipsoid& ellipsoid);

/// A method, one point at a time or in batches.
struct TimedMethod {
  std::string method;                   ///< name, such as "Bowring 1976, 2 iterations"
  std::optional<InstructionSet> batch;  ///< instruction set of a batch; nothing for one point at a time
  bool answers = true;                  ///< false if it computes no position, only a lower bound of the time
  bool in_degrees = false;              ///< are the results in degrees?
  std::function<void(Points&)> pass;    ///< computes all results

  /// Name with the form, such as "fast, batch avx512".
  [[nodiscard]] std::string name() const;
};

/// All methods available in this build and on this processor; GeographicLib is optional.
[[nodiscard]] std::vector<TimedMethod> timed_methods(const nlmech::geodesy::Ellipsoid& ellipsoid);

/// One-point method of the scene `range`: returns a position, or nothing if the method reports failure.
struct OnePointMethod {
  std::string name;
  std::function<std::optional<nlmech::geodesy::Geodetic>(const nlmech::geodesy::Cartesian&)> reverse;
};
[[nodiscard]] std::vector<OnePointMethod> range_methods(const nlmech::geodesy::Ellipsoid& ellipsoid);

}  // namespace nlmech::chapters::geodesy
