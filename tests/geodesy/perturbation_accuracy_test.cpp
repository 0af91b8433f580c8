#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <numbers>

#include "nlmech/geodesy/perturbation.hpp"
#include "tests/geodesy/oracle.hpp"

namespace nlmech::geodesy::perturbation_accuracy_test {
namespace {

using oracle::Real;

struct Errors {
  double latitude_deg = 0, height_m = 0;
};

/// Largest error over latitudes -90..90 deg and heights 200..35000 km against the oracle's answer for the
/// same doubles.
Errors largest_errors(const PerturbationSeries& method) {
  const Ellipsoid e = Ellipsoid::wgs84();
  Errors largest;
  for (const double height : {200e3, 300e3, 700e3, 2100e3, 3200e3, 8000e3, 12700e3, 35000e3}) {
    for (int latitude = -180; latitude <= 180; ++latitude) {
      const Cartesian p = forward(Geodetic{latitude / 2.0 * std::numbers::pi / 180, 0.5, height}, e);
      const auto truth = oracle::reverse(p, e);
      const Reversed found = reverse(p, e, method);
      EXPECT_EQ(found.outcome, Outcome::success);
      const Real in_degrees = abs(truth.latitude - found.position.latitude) * 180 / oracle::pi();
      largest.latitude_deg = std::max(largest.latitude_deg, static_cast<double>(in_degrees));
      largest.height_m =
          std::max(largest.height_m, static_cast<double>(abs(truth.height - found.position.height)));
    }
  }
  return largest;
}

// The statement of perturbation.hpp, order by order. Above order 4 the doubles themselves set the floor:
// latitude rounds at 1.4e-14 deg near the pole, heights at 7.5e-9 m.
TEST(PerturbationSeries, KeepsTheErrorStatementOfItsHeader) {
  constexpr std::array<Errors, 6> stated = {{{3.4e-4, 26},
                                             {1.2e-6, 0.06},
                                             {4.8e-9, 2.1e-4},
                                             {2.5e-11, 8.0e-7},
                                             {1.5e-13, 2.3e-8},
                                             {5.0e-14, 2.3e-8}}};
  for (int order = 1; order <= highest_order; ++order) {
    const Errors found = largest_errors({order, HeightFrom::series});
    EXPECT_LE(found.latitude_deg, stated.at(static_cast<std::size_t>(order) - 1).latitude_deg)
        << "order " << order;
    EXPECT_LE(found.height_m, stated.at(static_cast<std::size_t>(order) - 1).height_m) << "order " << order;
  }
}

// What the project set out to reach: orders 2, 3, 4 on the dissertation's range, with half a digit's rounding
// of the stated figures.
TEST(PerturbationSeries, ReachesTheTargetsOfOrders2To4) {
  constexpr std::array<Errors, 3> target = {{{1.12e-6, 5.84e-2}, {4.74e-9, 2.04e-4}, {2.42e-11, 7.9e-7}}};
  for (int order = 2; order <= 4; ++order) {
    const Errors found = largest_errors({order, HeightFrom::series});
    const Errors bound = target.at(static_cast<std::size_t>(order) - 2);
    EXPECT_LE(found.latitude_deg, bound.latitude_deg) << "order " << order;
    EXPECT_LE(found.height_m, bound.height_m) << "order " << order;
    EXPECT_GT(found.latitude_deg, 0.9 * bound.latitude_deg) << "suspiciously good at order " << order;
  }
}

// Projection turns an order-2 latitude (2e-8 rad) into a height at rounding: (M + h)/2 dphi^2 = 9e-9 m.
TEST(PerturbationSeries, ProjectedHeightOfOrder2IsAtRounding) {
  EXPECT_LE(largest_errors({2, HeightFrom::projection}).height_m, 3e-8);
}

/// Error of one point in 50 digits for the flattening f.
Real truncation_error(double latitude, double height, const Real& f, int order, bool of_height) {
  const BasicEllipsoid<Real> e(Real(6378137), f);
  const BasicGeodetic<Real> truth{latitude, 0, height};
  const auto found = reverse(forward(truth, e), e, PerturbationSeries{order, HeightFrom::series}).position;
  return abs(of_height ? Real(found.height - truth.height) : Real(found.latitude - truth.latitude));
}

// A wrong coefficient of order k leaves an error p^k, so the observed order would stop short. The next term
// of the series shifts the observed order by some p/ln 2.
TEST(PerturbationSeries, ObservedOrderInExtendedPrecision) {
  const Real f("1e-4");
  for (int order = 1; order <= highest_order; ++order) {
    for (const double latitude : {0.3, -0.9, 1.3}) {
      for (const double height : {-3e4, 5e5, 1.3e7}) {
        for (const bool of_height : {false, true}) {
          const Real coarse = truncation_error(latitude, height, f, order, of_height);
          const Real fine = truncation_error(latitude, height, Real(f / 2), order, of_height);
          const auto observed = static_cast<double>(log(coarse / fine) / log(Real(2)));
          EXPECT_NEAR(observed, order + 1, 0.02) << "order " << order << ", latitude " << latitude
                                                 << ", height " << height << ", of height " << of_height;
        }
      }
    }
  }
}

/// Largest latitude error of an order over the surface of an ellipsoid, in 50 digits.
Real largest_at_surface(const Real& f, int order) {
  const BasicEllipsoid<Real> e(Real(6378137), f);
  Real largest = 0;
  for (int i = 1; i < 90; ++i) {
    const BasicGeodetic<Real> truth{i * oracle::pi() / 180, 0, 0};
    const auto p = forward(truth, e);
    const Real R = sqrt(p.x * p.x + p.z * p.z);
    const Real parametric = detail::sum_series(p.x, p.z, R, e, order, corrected_series()).latitude;
    const Real found = atan2(e.a() * sin(parametric), e.b() * cos(parametric));
    largest = std::max(largest, Real(abs(found - truth.latitude)));
  }
  return largest;
}

// What the chapter's page says of strong flattening: about 6 an order at f = 1/10, about 2 at 1/4, nothing at
// 1/2.
TEST(PerturbationSeries, GainsLittleByOrderForStrongFlattening) {
  const auto gain = [](const char* f) {
    const Real ratio = largest_at_surface(Real(f), 4) / largest_at_surface(Real(f), 6);
    return static_cast<double>(sqrt(ratio));
  };
  EXPECT_NEAR(gain("0.1"), 6, 1);
  EXPECT_NEAR(gain("0.25"), 2.3, 0.5);
  EXPECT_LT(gain("0.5"), 1.2);
}

// There and back over random points: order 6 keeps the header's statement from the ground to 35000 km.
RC_GTEST_PROP(PerturbationSeries, ForwardThenReverse, ()) {
  const auto fraction = [] { return *rc::gen::inRange(-1000000, 1000001) / 1e6; };
  const Geodetic given{fraction() * std::numbers::pi / 2, fraction() * std::numbers::pi,
                       17.5e6 + fraction() * 17.5e6};
  const Ellipsoid e = Ellipsoid::wgs84();
  const Cartesian p = forward(given, e);
  const Reversed found = reverse(p, e, {6, HeightFrom::projection});
  RC_ASSERT(found.outcome == Outcome::success);
  // 5e-14 deg = 8.7e-16 rad of the header, and the rounding of the position on the way there: 2 ulp of R over
  // R
  const double eps = std::numeric_limits<double>::epsilon();
  RC_ASSERT(std::abs(found.position.latitude - given.latitude) <= 8.7e-16 + 2 * eps);
  RC_ASSERT(std::abs(found.position.height - given.height) <= 6 * eps * (e.a() + given.height));
  // within 1e-5 rad of a pole the position holds the longitude to fewer digits
  const double from_axis = std::hypot(p.x, p.y);
  const double turn = std::remainder(found.position.longitude - given.longitude, 2 * std::numbers::pi);
  RC_ASSERT(std::abs(turn) * from_axis <= 8 * eps * (e.a() + given.height));
}

// Oblate, spherical and prolate ellipsoids of any size: order 6 against the oracle. The truncation is of the
// order p^7 times a coefficient that grows near the centre; 60 |p|^7 holds from the surface upwards.
RC_GTEST_PROP(PerturbationSeries, AnyEllipsoid, ()) {
  const auto fraction = [] { return *rc::gen::inRange(-1000000, 1000001) / 1e6; };
  const Ellipsoid e(std::pow(10.0, 3 + 3 * fraction()), fraction() / 50);
  const Cartesian p = forward(Geodetic{fraction() * 1.57, fraction() * 3.14, e.a() * (1 + fraction())}, e);
  const Reversed found = reverse(p, e, {6, HeightFrom::projection});
  const auto truth = oracle::reverse(p, e);
  RC_ASSERT(found.outcome == Outcome::success);
  const double eps = std::numeric_limits<double>::epsilon();
  const double bound = 60 * std::pow(std::abs(e.p()), 7) + 5 * eps;
  RC_ASSERT(static_cast<double>(abs(truth.latitude - found.position.latitude)) <= bound);
  RC_ASSERT(static_cast<double>(abs(truth.height - found.position.height)) <= e.a() * (bound + 8 * eps));
}

}  // namespace
}  // namespace nlmech::geodesy::perturbation_accuracy_test
