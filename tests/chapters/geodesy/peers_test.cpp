#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "chapters/geodesy/timed_methods.hpp"
#include "nlmech/peers/geodesy/geographiclib.hpp"
#include "nlmech/peers/geodesy/scalar_methods.hpp"
#include "nlmech/peers/geodesy/simd_peers.hpp"
#include "tests/geodesy/exact_reverse.hpp"

namespace nlmech::peers::geodesy::peers_test {
namespace {

using nlmech::chapters::geodesy::Points;
using nlmech::geodesy::BasicGeodetic;
namespace reference = nlmech::geodesy::reference;

const Ellipsoid wgs84 = Ellipsoid::wgs84();
constexpr double rounding = 5e-16;  // rad: two units in the last place of pi/2

struct Sample {
  Points points = nlmech::chapters::geodesy::sample_points(8192, wgs84);
  std::vector<BasicGeodetic<reference::Real>> exact;
  Sample() {
    for (std::size_t i = 0; i < points.x.size(); ++i)
      exact.push_back(reference::reverse(points.at(i), wgs84));
  }
};

const Sample& sample() {
  static const Sample s;
  return s;
}

struct Errors {
  double latitude = 0, longitude = 0, height = 0;
  void take(const Geodetic& g, const BasicGeodetic<reference::Real>& exact) {
    latitude = std::max(latitude, abs(g.latitude - exact.latitude).convert_to<double>());
    longitude = std::max(longitude, abs(g.longitude - exact.longitude).convert_to<double>());
    height = std::max(height, abs(g.height - exact.height).convert_to<double>());
  }
};

/// Largest theoretical latitude error of a method over the sample, recorded in extended precision; an error
/// in a coded formula is larger by orders of magnitude.
struct Method {
  std::string name;
  std::function<Geodetic(const Cartesian&)> reverse;
  double truncation;
  double height = 2.5e-8;  // m: three units in the last place at 35000 km
};

/// Printed in test lists instead of the bytes.
void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

std::vector<Method> methods() {
  std::vector<Method> all = {{"Bowring1976x1", Bowring1976<1>(wgs84), 8.42e-9},
                             {"Bowring1976x2", Bowring1976<2>(wgs84), 0},
                             {"Bowring1985x1", Bowring1985<1>(wgs84), 2.42e-13},
                             {"Bowring1985x2", Bowring1985<2>(wgs84), 0},
                             {"Fukushima2006x1", Fukushima2006<1>(wgs84), 3.13e-11},
                             {"Fukushima2006x2", Fukushima2006<2>(wgs84), 0},
                             {"Vermeille2002", Vermeille2002(wgs84), 0},
                             {"Vermeille2011", Vermeille2011(wgs84), 0},
                             {"Olson1996", Olson1996(wgs84), 0},
                             {"Heikkinen1982", Heikkinen1982(wgs84), 0},
                             {"LinWang1995x1", LinWang1995<1>(wgs84), 1.18e-13, 1.5e-3},
                             {"LinWang1995x2", LinWang1995<2>(wgs84), 0},
                             {"LinWang1995x3", LinWang1995<3>(wgs84), 0}};
  if (geographiclib_available()) {
    all.push_back({"GeographicLib", [](const Cartesian& p) { return geographiclib_reverse(wgs84, p); }, 0});
  }
  return all;
}

class Peer : public testing::TestWithParam<Method> {};

TEST_P(Peer, HasTheErrorThatTheoryLeavesIt) {
  Errors errors;
  for (std::size_t i = 0; i < sample().exact.size(); ++i) {
    errors.take(GetParam().reverse(sample().points.at(i)), sample().exact[i]);
  }
  const double truncation = GetParam().truncation;
  EXPECT_LE(errors.latitude, 1.02 * truncation + rounding);
  EXPECT_GE(errors.latitude, 0.9 * truncation);
  EXPECT_LE(errors.longitude, 2 * rounding);  // GeographicLib's goes through degrees
  EXPECT_LE(errors.height, GetParam().height);
}

TEST_P(Peer, FindsPolesAndEquator) {
  const double a = wgs84.a(), b = wgs84.b();
  const double least = GetParam().truncation + rounding;
  const Geodetic north = GetParam().reverse({0, 0, b + 1e5}), south = GetParam().reverse({0, 0, -b - 1e5}),
                 equator = GetParam().reverse({0, -a - 1e5, 0});
  EXPECT_NEAR(north.latitude, std::numbers::pi / 2, least);
  EXPECT_NEAR(south.latitude, -std::numbers::pi / 2, least);
  EXPECT_NEAR(equator.latitude, 0, least);
  EXPECT_NEAR(equator.longitude, -std::numbers::pi / 2, least);
  for (const Geodetic& g : {north, south, equator}) EXPECT_NEAR(g.height, 1e5, GetParam().height);
}

INSTANTIATE_TEST_SUITE_P(Methods, Peer, testing::ValuesIn(methods()),
                         [](const auto& method) { return method.param.name; });

// The difference between Vermeille's second and first method.
TEST(Vermeille2011Peer, HoldsInsideTheEvolute) {
  const Vermeille2011 peer(wgs84);
  for (const Cartesian& p : {Cartesian{1e4, 0, 1e3}, Cartesian{3e4, 2e4, 5e3}, Cartesian{2e4, 1e4, 0}}) {
    Errors errors;
    errors.take(peer(p), reference::reverse(p, wgs84));
    EXPECT_LE(errors.latitude, 1e-14);
    EXPECT_LE(errors.height, 1e-8);
  }
}

struct SimdCase {
  SimdMethod method;
  double truncation;
};

TEST(SimdPeers, HaveTheErrorsOfTheirScalarForms) {
  const SimdCase cases[] = {{SimdMethod::bowring1976_1, 8.42e-9},    {SimdMethod::bowring1976_2, 0},
                            {SimdMethod::bowring1985_1, 2.42e-13},   {SimdMethod::bowring1985_2, 0},
                            {SimdMethod::fukushima2006_1, 3.13e-11}, {SimdMethod::fukushima2006_2, 0}};
  Points p = sample().points;
  for (auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!available(set)) continue;
    for (const SimdCase& c : cases) {
      run(c.method, set, wgs84, p.x, p.y, p.z, p.latitude, p.longitude, p.height);
      Errors errors;
      for (std::size_t i = 0; i < sample().exact.size(); ++i) {
        errors.take({p.latitude[i], p.longitude[i], p.height[i]}, sample().exact[i]);
      }
      EXPECT_LE(errors.latitude, 1.02 * c.truncation + rounding)
          << to_string(c.method) << ' ' << to_string(set);
      EXPECT_GE(errors.latitude, 0.9 * c.truncation) << to_string(c.method) << ' ' << to_string(set);
      EXPECT_LE(errors.longitude, rounding);
      EXPECT_LE(errors.height, 2.5e-8) << to_string(c.method) << ' ' << to_string(set);
    }
  }
}

TEST(SimdPeers, HoldAtThePole) {
  for (auto method : {SimdMethod::bowring1976_2, SimdMethod::bowring1985_2, SimdMethod::fukushima2006_2}) {
    const std::vector<double> zero(8, 0.), z(8, -wgs84.b() - 1e5);
    std::vector<double> latitude(8), longitude(8), height(8);
    run(method, InstructionSet::baseline, wgs84, zero, zero, z, latitude, longitude, height);
    EXPECT_EQ(latitude[0], -std::numbers::pi / 2) << to_string(method);
    EXPECT_NEAR(height[0], 1e5, 5e-9) << to_string(method);
  }
}

TEST(SimdPeers, RefuseUnequalSizes) {
  std::vector<double> eight(8), nine(9);
  EXPECT_THROW(run(SimdMethod::bowring1976_1, InstructionSet::baseline, wgs84, eight, eight, eight, eight,
                   nine, eight),
               std::invalid_argument);
  EXPECT_THROW(
      run(SimdMethod::bowring1976_1, InstructionSet::baseline, wgs84, nine, nine, nine, nine, nine, nine),
      std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::peers::geodesy::peers_test
