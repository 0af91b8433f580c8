/// @file
/// Ours and the peers, each as a pass over columns of points: what the scenes and the benchmark set side by
/// side.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech::chapters::geodesy {

/// Points by column, and columns for the results.
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

/// @p n points (a multiple of 8), uniform on the sphere, half of them from -5 to 100 km high, the others up
/// to 35000 km. Each coordinate is shaken by up to a millimetre: positions made from doubles would have exact
/// angles close to doubles, and flatter every method.
[[nodiscard]] Points sample_points(std::size_t n, const nlmech::geodesy::Ellipsoid& ellipsoid);

/// One method in one form.
struct TimedMethod {
  std::string method;                   ///< "Bowring 1976, 2 iterations"
  std::optional<InstructionSet> batch;  ///< set of a batch; nothing for one point after the other
  bool answers = true;                  ///< false for a floor, which computes no position
  bool in_degrees = false;              ///< latitude and longitude come in degrees
  std::function<void(Points&)> pass;    ///< computes all results

  /// "fast, batch avx512"
  [[nodiscard]] std::string name() const;
};

/// All that this build and this processor have. GeographicLib is left out where the build has none.
[[nodiscard]] std::vector<TimedMethod> timed_methods(const nlmech::geodesy::Ellipsoid& ellipsoid);

/// One-point methods of the scene `range`: a position, or nothing where the method says that it has none.
struct OnePointMethod {
  std::string name;
  std::function<std::optional<nlmech::geodesy::Geodetic>(const nlmech::geodesy::Cartesian&)> reverse;
};
[[nodiscard]] std::vector<OnePointMethod> range_methods(const nlmech::geodesy::Ellipsoid& ellipsoid);

}  // namespace nlmech::chapters::geodesy
