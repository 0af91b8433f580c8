#include "nlmech/geodesy/ellipsoid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/geodesy/oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::geodesy::ellipsoid_test {
namespace {

using oracle::Real;

TEST(Ellipsoid, Wgs84DerivedConstants) {
  const Ellipsoid e = Ellipsoid::wgs84();
  // From the defining a and 1/f in 50 digits: b = a (1 - f), e^2 = f (2 - f), p = 1/(1/f - 1). Tolerance: two
  // roundings.
  EXPECT_NEAR(e.b(), 6356752.314245179, 2e-9);
  EXPECT_NEAR(e.e2(), 6.694379990141317e-3, 2e-18);
  EXPECT_NEAR(e.p(), 0.0033640898209764189, 1e-18);
}

TEST(Ellipsoid, RefusesImpossibleShapesByValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double a : {0.0, -1.0, nan, inf}) EXPECT_THROW(Ellipsoid(a, 0.0), std::invalid_argument) << a;
  for (const double f : {1.0, 2.0, nan, inf, -inf})
    EXPECT_THROW(Ellipsoid(1.0, f), std::invalid_argument) << f;
  EXPECT_TRUE(
      tests::holds(tests::thrown<std::invalid_argument>([] { return Ellipsoid(-6378137, 0); }), "-6378137"));
}

// Eq. 2.40 in double against 50 digits: rounding errors only, a few ulp of the largest radius.
TEST(Forward, AgreesWithExtendedPrecision) {
  const Ellipsoid e = Ellipsoid::wgs84();
  const BasicEllipsoid<Real> exact(Real(e.a()), Real(e.f()));
  for (const double latitude : {-1.5, -0.7, 0.0, 0.3, 1.2}) {
    for (const double height : {-1e6, 0.0, 3.5e7}) {
      const Cartesian p = forward(Geodetic{latitude, 2.5, height}, e);
      const auto q = forward(BasicGeodetic<Real>{latitude, 2.5, height}, exact);
      const double tolerance = 4 * std::numeric_limits<double>::epsilon() * (e.a() + std::abs(height));
      EXPECT_NEAR(p.x, static_cast<double>(q.x), tolerance);
      EXPECT_NEAR(p.y, static_cast<double>(q.y), tolerance);
      EXPECT_NEAR(p.z, static_cast<double>(q.z), tolerance);
    }
  }
}

TEST(Oracle, InvertsForwardTo40Digits) {
  for (const double f : {1 / 298.257223563, 0.0, 0.1, -0.1}) {
    const BasicEllipsoid<Real> e(Real(6378137), Real(f));
    for (const double latitude : {-1.57, -0.4, 1e-9, 0.8}) {
      for (const double height : {-1e5, 10.0, 4e7}) {
        const BasicGeodetic<Real> reference{latitude, 0.5, height};
        const auto found = oracle::reverse(forward(reference, e), e);
        EXPECT_LT(abs(found.latitude - reference.latitude), Real(1e-40));
        EXPECT_LT(abs(found.height - reference.height), Real(1e-33));
      }
    }
  }
}

}  // namespace
}  // namespace nlmech::geodesy::ellipsoid_test
