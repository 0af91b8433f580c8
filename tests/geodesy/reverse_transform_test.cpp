#include "nlmech/geodesy/reverse_transform.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/geodesy/exact_reverse.hpp"
#include "tests/thrown.hpp"

namespace {
std::size_t allocations = 0;  // counted by the replaced operator new below
}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace nlmech::geodesy::reverse_transform_test {
namespace {

using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<InstructionSet> available_sets() {
  std::vector<InstructionSet> sets;
  for (auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (available(set)) sets.push_back(set);
  }
  return sets;
}

/// Equal in every bit, signs of zeros included; any two NaNs count as equal.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

struct Columns {
  std::vector<double> first, second, third;
  explicit Columns(std::size_t n) : first(n), second(n), third(n) {}
};

struct Batch {
  Columns in, out;
  explicit Batch(const std::vector<Cartesian>& points) : in(points.size()), out(points.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      in.first[i] = points[i].x, in.second[i] = points[i].y, in.third[i] = points[i].z;
    }
  }
  BatchReport run(const ReverseTransform& reverse) {
    return reverse(in.first, in.second, in.third, out.first, out.second, out.third);
  }
};

/// Uniform on the sphere, half of the heights below 100 km; shifted by a millimetre, because the exact angles
/// of a point computed from double angles are close to doubles and hide half a unit in the last place.
Cartesian random_point(std::mt19937_64& engine, const Ellipsoid& e, double lowest = -1e4,
                       double highest = 3.5e7) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double latitude = std::asin(2 * unit(engine) - 1), longitude = (2 * unit(engine) - 1) * pi;
  const double top = unit(engine) < 0.5 ? std::min(highest, 1e5) : highest;
  const Cartesian p = forward<double>({latitude, longitude, lowest + (top - lowest) * unit(engine)}, e);
  const auto offset = [&] { return 1e-3 * (2 * unit(engine) - 1); };
  return {p.x + offset(), p.y + offset(), p.z + offset()};
}

/// Points on which transformations may fail: poles, equator, antimeridian, zeros of both signs, octant
/// boundaries of the arctangent, the disc and the centre, the smallest and the largest numbers.
std::vector<Cartesian> nasty_points() {
  const double a = 6378137, b = 6356752.3142451794976, tiny = 5e-324, diagonal = std::tan(pi / 8) * a;
  std::vector<Cartesian> points;
  const std::vector<double> values = {0,      -0.,  tiny,  -tiny,    1e-310,  1e-200,  -1e-200, 1e-5,
                                      -1e-5,  1,    -1,    4e4,      -4.27e4, 4.3e4,   1e6,     -a,
                                      a,      b,    -b,    diagonal, 6.3e6,   -6.34e6, 6.35e6,  4.2e7,
                                      -4.2e7, 1e20, 1e150, 1e155,    -1e300,  1e308};
  for (double x : values) {
    for (double y : values) {
      for (double z : values) points.push_back({x, y, z});
    }
  }
  return points;
}

void expect_accurate(const GeodeticPoint& result, const Cartesian& point, const Ellipsoid& e,
                     double angle_error, double height_error) {
  const auto exact = reference::reverse(point, e);
  ASSERT_EQ(result.outcome, Outcome::success);
  const auto error = [](double value, const reference::Real& expected) {
    return abs(value - expected).convert_to<double>();
  };
  EXPECT_LE(error(result.position.latitude, exact.latitude), angle_error)
      << point.x << ' ' << point.y << ' ' << point.z;
  EXPECT_LE(error(result.position.longitude, exact.longitude), angle_error)
      << point.x << ' ' << point.y << ' ' << point.z;
  EXPECT_LE(error(result.position.height, exact.height), height_error)
      << point.x << ' ' << point.y << ' ' << point.z;
}

class EverySet : public testing::TestWithParam<InstructionSet> {
 protected:
  const Ellipsoid wgs84 = Ellipsoid::wgs84();
  const ReverseTransform reverse{wgs84, GetParam()};
};

// Accuracy stated in the header: 4e-16 rad is the sum of all rounding errors (half an ulp of the result,
// three of the quotient, two of the distance from the axis); the errors of this sample are smaller, and are
// asserted.
TEST_P(EverySet, KeepsItsAccuracyStatement) {
  std::mt19937_64 engine(20240611);
  for (int n = 0; n < 8000; ++n) {
    const Cartesian point = random_point(engine, wgs84);
    const GeodeticPoint result = reverse(point);
    expect_accurate(result, point, wgs84, 3.5e-16, result.position.height < 1e5 ? 2.5e-9 : 2.2e-8);
  }
}

TEST_P(EverySet, HoldsAtEveryDepthAndDistance) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> exponent(-3, 12), unit(-1, 1);
  for (int n = 0; n < 5000; ++n) {
    const double size = std::pow(10, exponent(engine));
    const Cartesian point{unit(engine) * size, unit(engine) * size, unit(engine) * size};
    // Near the edge of the disc the condition number of the latitude grows as r - a e^2 decreases.
    const double r = std::hypot(point.x, point.y), edge = wgs84.a() * wgs84.e2();
    const double condition = 1 + edge / std::max(1e-300, std::hypot(r - edge, point.z));
    expect_accurate(reverse(point), point, wgs84, 4.5e-16 * condition, std::max(5e-9, 6e-16 * size));
  }
}

TEST_P(EverySet, TreatsNastyPointsAsTheClosestPointDoes) {
  const ClosestPoint exact(wgs84);
  for (const Cartesian& point : nasty_points()) {
    const GeodeticPoint fast = reverse(point), slow = exact(point);
    ASSERT_EQ(fast.outcome, slow.outcome);
    const Geodetic &f = fast.position, &s = slow.position;
    EXPECT_NEAR(f.latitude, s.latitude, 4.5e-16) << point.x << ' ' << point.y << ' ' << point.z;
    EXPECT_NEAR(f.longitude, s.longitude, 4.5e-16) << point.x << ' ' << point.y << ' ' << point.z;
    EXPECT_EQ(std::signbit(f.latitude), std::signbit(point.z));
    EXPECT_EQ(std::signbit(f.longitude), std::signbit(point.y));
    const double R = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    if (std::isfinite(s.height)) {
      EXPECT_NEAR(f.height, s.height, std::max(5e-9, 1e-15 * R));
    }
    EXPECT_LE(std::abs(f.latitude), pi / 2);
    EXPECT_LE(std::abs(f.longitude), pi);
  }
}

TEST_P(EverySet, IsExactAtPolesEquatorAndAntimeridian) {
  const double a = wgs84.a(), b = wgs84.b();
  EXPECT_TRUE(same(reverse({0, 0, b + 1000}).position.latitude, pi / 2));
  EXPECT_TRUE(same(reverse({0, 0, -b}).position.latitude, -pi / 2));
  EXPECT_NEAR(reverse({0, 0, b + 1000}).position.height, 1000, 1e-9);
  EXPECT_TRUE(same(reverse({a, 0, 0}).position.latitude, 0.));
  EXPECT_TRUE(same(reverse({a, 0, -0.}).position.latitude, -0.));
  EXPECT_TRUE(same(reverse({a, 0, 0}).position.height, 0.));
  EXPECT_TRUE(same(reverse({-a, 0., 0}).position.longitude, pi));
  EXPECT_TRUE(same(reverse({-a, -0., 0}).position.longitude, -pi));
  EXPECT_TRUE(same(reverse({0., a, 0}).position.longitude, pi / 2));
  EXPECT_TRUE(same(reverse({0., -0., b}).position.longitude, -0.));
  EXPECT_TRUE(same(reverse({-0., 0., b}).position.longitude, pi));
}

TEST_P(EverySet, ReportsWhatIsNotFinite) {
  for (double bad : {nan, infinity, -infinity}) {
    for (int place = 0; place < 3; ++place) {
      Cartesian point{7e6, 1, 1};
      (place == 0 ? point.x : place == 1 ? point.y : point.z) = bad;
      const GeodeticPoint result = reverse(point);
      EXPECT_EQ(result.outcome, Outcome::non_finite);
      EXPECT_TRUE(std::isnan(result.position.latitude) && std::isnan(result.position.longitude) &&
                  std::isnan(result.position.height));
    }
  }
  const double huge = std::numeric_limits<double>::max();
  const GeodeticPoint far = reverse({huge, huge, huge});  // its distance, sqrt(3) huge, is not representable
  EXPECT_EQ(far.outcome, Outcome::non_finite);
  EXPECT_NEAR(far.position.latitude, std::atan(std::sqrt(0.5)), 2e-16);
}

TEST_P(EverySet, BatchEqualsOnePointBitForBitInEveryPlace) {
  std::mt19937_64 engine(3);
  for (std::size_t size = 0; size <= 17; ++size) {
    for (std::size_t odd = 0; odd <= size; ++odd) {
      std::vector<Cartesian> points(size);
      for (Cartesian& point : points) point = random_point(engine, wgs84);
      if (odd < size) points[odd] = {3e4, -2e4, 1e3};  // inside the disc: the slower path
      Batch batch(points);
      const BatchReport report = batch.run(reverse);
      EXPECT_EQ(report.points, size);
      EXPECT_EQ(report.fallbacks, odd < size ? 1u : 0u);
      EXPECT_TRUE(report.status().ok());
      for (std::size_t i = 0; i < size; ++i) {
        const Geodetic one = reverse(points[i]).position;
        EXPECT_TRUE(same(batch.out.first[i], one.latitude)) << size << ' ' << i;
        EXPECT_TRUE(same(batch.out.second[i], one.longitude)) << size << ' ' << i;
        EXPECT_TRUE(same(batch.out.third[i], one.height)) << size << ' ' << i;
      }
    }
  }
}

TEST_P(EverySet, BatchEqualsOnePointOnNastyPoints) {
  std::vector<Cartesian> points = nasty_points();
  points[5] = {nan, 1, 1};
  points[77] = {1, -infinity, 1};
  Batch batch(points);
  const BatchReport report = batch.run(reverse);
  EXPECT_EQ(report.non_finite, 2u);
  EXPECT_EQ(report.first_non_finite, 5u);
  EXPECT_EQ(report.status().outcome(), Outcome::non_finite);
  EXPECT_TRUE(tests::holds(report.status().sentence(), "2 of 27000 points"));
  EXPECT_TRUE(tests::holds(report.status().sentence(), "index 5"));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Geodetic one = reverse(points[i]).position;
    EXPECT_TRUE(same(batch.out.first[i], one.latitude) && same(batch.out.second[i], one.longitude) &&
                same(batch.out.third[i], one.height))
        << points[i].x << ' ' << points[i].y << ' ' << points[i].z;
  }
}

TEST_P(EverySet, MayOverwriteItsInputs) {
  std::mt19937_64 engine(4);
  std::vector<Cartesian> points(101);
  for (Cartesian& point : points) point = random_point(engine, wgs84);
  points[13] = points[100] = {0, 0, 0};  // redone by the slower path after the outputs were stored
  Batch apart(points), inside(points), turned(points);
  apart.run(reverse);
  reverse(inside.in.first, inside.in.second, inside.in.third, inside.in.first, inside.in.second,
          inside.in.third);
  reverse(turned.in.first, turned.in.second, turned.in.third, turned.in.third, turned.in.first,
          turned.in.second);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(same(apart.out.first[i], inside.in.first[i]) &&
                same(apart.out.second[i], inside.in.second[i]) &&
                same(apart.out.third[i], inside.in.third[i]));
    EXPECT_TRUE(same(apart.out.first[i], turned.in.third[i]) &&
                same(apart.out.second[i], turned.in.first[i]) &&
                same(apart.out.third[i], turned.in.second[i]));
  }
}

TEST_P(EverySet, AllocatesNothing) {
  std::mt19937_64 engine(5);
  std::vector<Cartesian> points(100, Cartesian{1, 2, 3});
  for (std::size_t i = 0; i < 50; ++i) points[2 * i] = random_point(engine, wgs84);
  Batch batch(points);
  const std::size_t before = allocations;
  batch.run(reverse);
  EXPECT_EQ(allocations, before);
}

// Every form of the kernel (polynomial alone, one and two corrections, none) on oblate and prolate
// ellipsoids.
TEST_P(EverySet, IsAccurateForEveryFlattening) {
  std::mt19937_64 engine(6);
  bool seen[4] = {};
  for (double inverse : {298.257223563, 299.1528128, 293.465, 169.8, 100., 30., 15.4, 10.2, 8.,      4., 2.,
                         1.01,          -298.,       -100.,   -20.,  -10., -7., -2.,  -0.1, infinity}) {
    const Ellipsoid e(6378137, 1 / inverse);
    const ReverseTransform transform(e, GetParam());
    seen[transform.corrections() + 1] = true;
    const double size = std::max(e.a(), e.b());
    // The latitude is ill-conditioned where the curvature of the ellipsoid is great: a/b or b/a, squared.
    const double ratio = size / std::min(e.a(), e.b()), condition = ratio * ratio;
    for (int n = 0; n < 500; ++n) {
      const Cartesian point = random_point(engine, e, -0.002 * std::min(e.a(), e.b()), 3.5e7);
      expect_accurate(transform(point), point, e, 4.5e-16 * condition, 6e-16 * (size + 3.5e7));
    }
  }
  for (bool form : seen) EXPECT_TRUE(form);
}

TEST(ReverseTransform, GivesTheSameBitsWithAvx2AndAvx512) {
  if (!available(InstructionSet::avx512)) GTEST_SKIP() << "no AVX-512 here";
  const ReverseTransform four(Ellipsoid::wgs84(), InstructionSet::avx2),
      eight(Ellipsoid::wgs84(), InstructionSet::avx512);
  std::mt19937_64 engine(8);
  for (int n = 0; n < 5000; ++n) {
    const Cartesian point = random_point(engine, Ellipsoid::wgs84());
    const Geodetic a = four(point).position, b = eight(point).position;
    EXPECT_TRUE(same(a.latitude, b.latitude) && same(a.longitude, b.longitude) && same(a.height, b.height));
  }
}

TEST(ReverseTransform, HasTheSymmetriesOfTheEllipsoidBitForBit) {
  const ReverseTransform reverse(Ellipsoid::wgs84());
  std::mt19937_64 engine(9);
  for (int n = 0; n < 2000; ++n) {
    const Cartesian p = random_point(engine, Ellipsoid::wgs84());
    const Geodetic g = reverse(p).position, south = reverse({p.x, p.y, -p.z}).position,
                   west = reverse({p.x, -p.y, p.z}).position;
    EXPECT_TRUE(same(south.latitude, -g.latitude) && same(south.height, g.height));
    EXPECT_TRUE(same(west.longitude, -g.longitude) && same(west.latitude, g.latitude));
  }
}

TEST(ReverseTransform, RefusesUnequalSizes) {
  const ReverseTransform reverse(Ellipsoid::wgs84());
  std::vector<double> three(3), four(4);
  EXPECT_TRUE(tests::holds(
      tests::thrown<std::invalid_argument>([&] { return reverse(three, three, three, three, four, three); }),
      "are 3 3 3 3 4 3"));
}

TEST(ReverseTransform, RefusesAnInstructionSetThatIsAbsent) {
  for (auto set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (!available(set)) {
      EXPECT_THROW(ReverseTransform(Ellipsoid::wgs84(), set), std::invalid_argument);
    }
  }
  EXPECT_TRUE(available(best_instruction_set()));
  EXPECT_EQ(ReverseTransform(Ellipsoid::wgs84()).instruction_set(), best_instruction_set());
}

INSTANTIATE_TEST_SUITE_P(Sets, EverySet, testing::ValuesIn(available_sets()),
                         [](const auto& set) { return std::string(to_string(set.param)); });

}  // namespace
}  // namespace nlmech::geodesy::reverse_transform_test
