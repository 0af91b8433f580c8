#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "nlmech/geodesy/perturbation.hpp"

namespace nlmech::geodesy::perturbation_edges_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

Reversed fourth_order(double x, double y, double z, const Ellipsoid& e = Ellipsoid::wgs84()) {
  return reverse(Cartesian{x, y, z}, e, {4, HeightFrom::series});
}

TEST(PerturbationEdges, PolesAreExact) {
  const double b = Ellipsoid::wgs84().b();
  for (const double sign : {1.0, -1.0}) {
    const Reversed found = fourth_order(0, 0, sign * (b + 1000));
    EXPECT_EQ(found.outcome, Outcome::success);
    EXPECT_EQ(found.position.latitude, sign * pi / 2);
    EXPECT_NEAR(found.position.height, 1000, 2e-9);  // an ulp of b
    EXPECT_EQ(found.position.longitude, 0);
  }
}

TEST(PerturbationEdges, EquatorKeepsTheSignOfZero) {
  for (const double z : {0.0, -0.0}) {
    const Reversed found = fourth_order(7e6, 0, z);
    EXPECT_EQ(found.position.latitude, 0);
    EXPECT_EQ(std::signbit(found.position.latitude), std::signbit(z));
    EXPECT_NEAR(found.position.height, 7e6 - 6378137, 1e-6);  // order 4: 8e-7 m
  }
}

TEST(PerturbationEdges, LongitudeFollowsTheSignsOfZero) {
  EXPECT_EQ(fourth_order(-7e6, 0.0, 1e6).position.longitude, pi);
  EXPECT_EQ(fourth_order(-7e6, -0.0, 1e6).position.longitude, -pi);
  EXPECT_EQ(fourth_order(0, 7e6, 1e6).position.longitude, pi / 2);
  EXPECT_TRUE(std::signbit(fourth_order(7e6, -0.0, 1e6).position.longitude));
}

TEST(PerturbationEdges, NonFiniteInputIsAnOutcome) {
  for (const double bad : {nan, inf, -inf}) {
    for (const Reversed& found :
         {fourth_order(bad, 0, 7e6), fourth_order(7e6, bad, 0), fourth_order(0, 7e6, bad)}) {
      EXPECT_EQ(found.outcome, Outcome::non_finite);
      EXPECT_TRUE(std::isnan(found.position.latitude) && std::isnan(found.position.height));
    }
  }
}

TEST(PerturbationEdges, NearTheCentreIsOutsideValidity) {
  EXPECT_EQ(fourth_order(0, 0, 0).outcome, Outcome::outside_validity);
  EXPECT_EQ(fourth_order(1e3, 0, 1e3).outcome, Outcome::outside_validity);
  EXPECT_EQ(fourth_order(0, 20e3, -20e3).outcome, Outcome::outside_validity);
  EXPECT_EQ(fourth_order(5e-324, 0, 0).outcome, Outcome::outside_validity);
  EXPECT_EQ(fourth_order(2e6, 0, 2e6).outcome, Outcome::success);
}

// Nearer than 100 * rounding_of_miss eps a the stated miss is rounding of the semi-axis: by chance it is
// small, and the true one is not. On a sphere, where the series is exact, the bound is met from both sides.
TEST(PerturbationEdges, NearerThanTheRoundingOfTheAxisIsOutsideValidity) {
  const Ellipsoid e(6378137, 0.0032887243670646294);
  for (const double z : {4.4978073798573664e-08, 1e-9, 1e-100}) {
    for (const HeightFrom height : {HeightFrom::series, HeightFrom::projection})
      EXPECT_EQ(reverse(Cartesian{0, 0, -z}, e, {6, height}).outcome, Outcome::outside_validity) << z;
  }
  const double nearest = 100 * rounding_of_miss * std::numeric_limits<double>::epsilon();
  for (const double a : {1e-100, 1.0, 6378137.0, 1e100}) {
    EXPECT_EQ(fourth_order(0.99 * nearest * a, 0, 0, Ellipsoid(a, 0)).outcome, Outcome::outside_validity);
    EXPECT_EQ(fourth_order(2 * nearest * a, 0, 0, Ellipsoid(a, 0)).outcome, Outcome::success);
  }
}

TEST(PerturbationEdges, FarAwayNothingOverflows) {
  for (const double far : {1e12, 1e100, 1e300}) {
    const Reversed found = fourth_order(far, 0, far);
    EXPECT_EQ(found.outcome, Outcome::success) << far;
    // The normal's direction differs from the radius's by e^2 a/(2 R), up to a part e^2 of that. Order 4
    // keeps 7e-14 rad at any distance.
    const Ellipsoid e = Ellipsoid::wgs84();
    const double turn = e.e2() * e.a() / (2 * std::hypot(far, far));
    EXPECT_NEAR(found.position.latitude, pi / 4 + turn, e.e2() * turn + 1e-13) << far;
    EXPECT_NEAR(found.position.height / far, std::numbers::sqrt2, 1e-5) << far;
  }
}

// On a sphere the zeroth order is exact: p = 0 and every term vanishes.
TEST(PerturbationEdges, SphereIsExact) {
  const Reversed found = fourth_order(3e6, 0, 4e6, Ellipsoid(1e6, 0));
  EXPECT_DOUBLE_EQ(found.position.latitude, std::atan2(4e6, 3e6));
  EXPECT_EQ(found.position.height, 4e6);
}

// p = 1: the series does not converge at all; where it happens to be far off it says so, and it never returns
// a guess that misses by more than a hundredth.
TEST(PerturbationEdges, StrongFlatteningIsNeverASilentGuess) {
  const Ellipsoid e(6378137, 0.5);
  int refused = 0;
  for (int i = 1; i < 90; ++i) {
    const Cartesian p = forward(Geodetic{i * pi / 180, 0, 1000}, e);
    const Reversed found = reverse(p, e, {4, HeightFrom::series});
    refused += found.outcome == Outcome::outside_validity ? 1 : 0;
    if (found.outcome == Outcome::success) {
      EXPECT_LE(found.miss, 0.01 * std::hypot(p.x, p.z));
    }
  }
  EXPECT_GT(refused, 30);
}

TEST(PerturbationEdges, OrderOutOfRangeThrowsWithItsValue) {
  for (const int order : {-1, 0, 7}) {
    try {
      static_cast<void>(reverse(Cartesian{7e6, 0, 0}, Ellipsoid::wgs84(), {order, HeightFrom::series}));
      ADD_FAILURE() << "accepted order " << order;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(std::to_string(order)), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace nlmech::geodesy::perturbation_edges_test
