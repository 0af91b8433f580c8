#include "nlmech/geodesy/closest_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "nlmech/peers/geodesy/geographiclib.hpp"
#include "tests/geodesy/exact_reverse.hpp"

namespace nlmech::geodesy::closest_point_test {
namespace {

using std::numbers::pi;

struct Error {
  double latitude, height;
};

Error error_of(const Geodetic& g, const BasicGeodetic<reference::Real>& exact) {
  return {abs(g.latitude - exact.latitude).convert_to<double>(),
          abs(g.height - exact.height).convert_to<double>()};
}

// Points inside at all scales, including the neighbourhood of the evolute, where the latitude is
// ill-conditioned: there the reference accuracy is that of GeographicLib in double.
TEST(ClosestPoint, IsAsAccurateAsGeographicLib) {
  if (!peers::geodesy::geographiclib_available()) GTEST_SKIP() << "built without GeographicLib";
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(-1, 1), exponent(-8, 1);
  for (double f : {1 / 298.257223563, -1 / 298., 0.1, -0.1, 0.5, -0.5, 0.9, -5.}) {
    const Ellipsoid e(6378137, f);
    const ClosestPoint closest(e);
    Error worst{0, 0}, worst_of_peer{0, 0};
    for (int n = 0; n < 3000; ++n) {
      const double size = e.a() * std::pow(10, exponent(engine));
      const Cartesian p{unit(engine) * size, unit(engine) * size, unit(engine) * size};
      const auto exact = reference::reverse(p, e);
      const Error peer_error = error_of(peers::geodesy::geographiclib_reverse(e, p), exact),
                  error = error_of(closest(p).position, exact);
      worst = {std::max(worst.latitude, error.latitude), std::max(worst.height, error.height)};
      worst_of_peer = {std::max(worst_of_peer.latitude, peer_error.latitude),
                       std::max(worst_of_peer.height, peer_error.height)};
    }
    EXPECT_LE(worst.latitude, std::max(4e-16, 1.5 * worst_of_peer.latitude)) << f;
    // Height: four rounding errors of the size of the point.
    EXPECT_LE(worst.height, std::max(1e-7, 1.5 * worst_of_peer.height)) << f;
  }
}

TEST(ClosestPoint, TakesTheNorthernOfTwoPointsOnTheDisc) {
  const Ellipsoid e = Ellipsoid::wgs84();
  const ClosestPoint closest(e);
  const double edge = e.a() * e.e2();  // 42.7 km
  for (double r : {1e-300, 1e-9, 1., 1000., 4e4, 0.999999 * edge}) {
    const auto exact = reference::reverse({r, 0, 0}, e);
    const Geodetic north = closest({r, 0, 0.}).position, south = closest({r, 0, -0.}).position;
    EXPECT_GT(north.latitude, 0);
    // The latitude is the arc cosine of a quantity close to 1, which amplifies the error of the distance from
    // the edge.
    EXPECT_LE(error_of(north, exact).latitude, 4e-16 / std::sqrt(1 - r / edge)) << r;
    EXPECT_LE(error_of(north, exact).height, 5e-9) << r;
    EXPECT_EQ(south.latitude, -north.latitude);
    EXPECT_EQ(south.height, north.height);
    const Geodetic above = closest({r, 0, 5e-324}).position;
    EXPECT_NEAR(above.latitude, north.latitude, 4e-16);
  }
  EXPECT_EQ(closest({edge * 1.000001, 0, 0}).position.latitude, 0);
}

TEST(ClosestPoint, FindsTheCentre) {
  const Ellipsoid oblate = Ellipsoid::wgs84(), prolate(6378137, -0.1), sphere(6378137, 0);
  const Geodetic pole = ClosestPoint(oblate)({0, 0, 0}).position;
  EXPECT_EQ(pole.latitude, pi / 2);
  EXPECT_NEAR(pole.height, -oblate.b(), 1e-9);
  const Geodetic equator = ClosestPoint(prolate)({0, 0, 0}).position;
  EXPECT_EQ(equator.latitude, 0);
  EXPECT_NEAR(equator.height, -prolate.a(), 1e-9);
  EXPECT_EQ(ClosestPoint(sphere)({0, 0, 0}).position.latitude, pi / 2);
  EXPECT_EQ(ClosestPoint(sphere)({0, 0, -0.}).position.latitude, -pi / 2);
  EXPECT_EQ(ClosestPoint(sphere)({0, 0, 0}).position.height, -sphere.a());
}

TEST(ClosestPoint, KnowsTheSphereAtEveryScale) {
  for (double f : {0., 1e-300, -1e-300, 1e-90, -1e-90, 1e-20}) {
    const ClosestPoint closest(Ellipsoid(6378137, f));
    for (double size : {1e-310, 1e-290, 1e-60, 1., 1e7, 1e300}) {
      const double disc = 2 * std::abs(f) * 6378137;
      if (std::abs(f) > 1e-100 && disc > 1e-17 * size) continue;  // no longer a sphere to this point
      const Geodetic g = closest({size, 0, -size}).position;
      EXPECT_NEAR(g.latitude, -pi / 4, 4.5e-16) << f << ' ' << size;
      EXPECT_NEAR(g.height, std::sqrt(2.) * size - 6378137, 4e-16 * (size + 6378137)) << f << ' ' << size;
    }
  }
}

TEST(ClosestPoint, FindsTheSegmentOfAProlateAxis) {
  const Ellipsoid e(6378137, -0.1);
  const ClosestPoint closest(e);
  const double edge = (e.b() * e.b() - e.a() * e.a()) / e.b();
  for (double fraction : {1e-12, 0.1, 0.5, 0.9}) {
    const Cartesian p{0, 0, fraction * edge};
    const Error error = error_of(closest(p).position, reference::reverse(p, e));
    EXPECT_LE(error.latitude, 1e-15) << fraction;
    EXPECT_LE(error.height, 5e-9) << fraction;
  }
  EXPECT_EQ(closest({0, 0, 1.0001 * edge}).position.latitude, pi / 2);
}

// Points around the edge of the disc from all sides at all scales: the slowest case of Newton's method.
TEST(ClosestPoint, ConvergesAtTheEdgeOfTheDisc) {
  const Ellipsoid e = Ellipsoid::wgs84();
  const ClosestPoint closest(e);
  const double edge = e.a() * e.e2();
  for (int i = -16; i < 0; ++i) {
    for (double side : {-1., 0., 1.}) {
      for (int j = -320; j < 4; j += 2) {
        const Cartesian p{edge * (1 + side * std::pow(10, i)), 0, std::pow(10, j)};
        const auto exact = reference::reverse(p, e);
        const Geodetic g = closest(p).position;
        // Condition number: a shift of the point by eps in units of the edge rotates the normal by
        // eps/(distance to the evolute), and by at most eps^(1/2) at the cusp.
        const double beta = p.z / edge, distance = std::max(std::cbrt(beta * beta), std::abs(p.x / edge - 1));
        const double bound = 6e-16 + 6e-16 / std::sqrt(distance) + 6e-16 / distance * std::abs(g.latitude);
        EXPECT_LE(error_of(g, exact).latitude, std::min(1e-7, bound)) << p.x << ' ' << p.z;
        EXPECT_LE(error_of(g, exact).height, 5e-9);
      }
    }
  }
}

// Just outside the disc the latitude is z/(r - a e^2) times constants. The difference is exact, so the
// latitude keeps all its digits; a difference of rounded numbers would leave six.
TEST(ClosestPoint, KeepsItsDigitsNextToTheDisc) {
  const Ellipsoid e = Ellipsoid::wgs84();
  for (double hair : {1e-10, 1e-8, 1e-5}) {
    const Cartesian p{e.a() * e.e2() * (1 + hair), 0, 1e-12};
    const auto exact = reference::reverse(p, e);
    const double relative =
        abs(ClosestPoint(e)(p).position.latitude / exact.latitude - 1).convert_to<double>();
    EXPECT_LE(relative, 2e-15) << hair;
  }
}

TEST(ClosestPoint, ReachesTheLargestNumbers) {
  const Ellipsoid e = Ellipsoid::wgs84();
  for (double size : {1e20, 1e25, 1e60, 1e154, 1e155, 1e300, 1e308}) {
    const Cartesian p{size, 0, 0.5 * size};
    const GeodeticPoint result = ClosestPoint(e)(p);
    const Error error = error_of(result.position, reference::reverse(p, e));
    EXPECT_EQ(result.outcome, Outcome::success);
    EXPECT_LE(error.latitude, 2e-16) << size;
    EXPECT_LE(error.height / size, 4e-16) << size;
  }
}

TEST(ClosestPoint, AcceptsEllipsoidsOfEverySize) {
  for (double a : {1e-280, 1e-100, 1e-3, 1e10, 1e100, 1e280}) {
    const Ellipsoid e(a, 0.01);
    const Cartesian p = forward<double>({0.7, -2., 0.1 * a}, e);
    const Geodetic g = ClosestPoint(e)(p).position;
    EXPECT_NEAR(g.latitude, 0.7, 1e-15);
    EXPECT_NEAR(g.height / a, 0.1, 1e-15);
  }
}

TEST(ClosestPoint, RefusesDegenerateEllipsoids) {
  EXPECT_THROW(ClosestPoint(Ellipsoid(6e6, -1e200)), std::invalid_argument);
  EXPECT_THROW(ClosestPoint(Ellipsoid(1e300, -1e300)), std::invalid_argument);
  EXPECT_THROW(ClosestPoint(Ellipsoid(1e-310, 0.5)), std::invalid_argument);
  EXPECT_NO_THROW(ClosestPoint(Ellipsoid(6e6, -1e10)));
}

TEST(ClosestPoint, ReportsWhatIsNotFinite) {
  const ClosestPoint closest(Ellipsoid::wgs84());
  EXPECT_EQ(closest({std::nan(""), 0, 0}).outcome, Outcome::non_finite);
  EXPECT_TRUE(std::isnan(closest({0, 0, std::numeric_limits<double>::infinity()}).position.longitude));
}

}  // namespace
}  // namespace nlmech::geodesy::closest_point_test
