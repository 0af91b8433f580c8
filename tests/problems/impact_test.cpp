#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nlmech/ivp/system.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/program/power_series.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::impact_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
double before(double t) { return std::nextafter(t, -infinity); }

/// The oscillator under an impact; its acceleration at rest in the middle is the force.
struct Impact {
  explicit Impact(const program::Settings& settings = {}) : text("impact", settings) {}
  template <class T>
  [[nodiscard]] T force(const T& t) const {
    Vector<T, 1> a;
    text.acceleration(t, Vector<T, 1>(T(0)), Vector<T, 1>(T(0)), a);
    return a[0];
  }
  TextProblem text;
};

// Eq. 4.24 with a (t1 - t) for the printed a (1 - t). The two differ once t1 is not 1: the corrected force is
// continuous and ends at 0, the printed one is neither.
TEST(ImpactForce, IsATriangleForEveryDuration) {
  for (const double t1 : {1.0, 3.0, 0.25}) {
    const Impact problem({{"slope", 2}, {"duration", t1}});
    EXPECT_EQ(problem.force(t1 / 2), t1);
    EXPECT_NEAR(problem.force(before(t1 / 2)), t1, 4 * epsilon * t1);
    EXPECT_NEAR(problem.force(before(t1)), 0, 4 * epsilon * t1);
    EXPECT_EQ(problem.force(t1 / 4), t1 / 2);
    EXPECT_EQ(problem.force(3 * t1 / 4), t1 / 2);
    for (const double outside : {-1.0, before(0), 0.0, t1, t1 + 1, 1e300})
      EXPECT_EQ(problem.force(outside), 0);
  }
  // An impact of three units: the printed branch jumps from +3 to -1 in its middle.
  const Impact problem({{"slope", 2}, {"duration", 3}});
  const auto printed = [](double t) { return 2 * (1 - t); };
  EXPECT_NEAR(problem.force(before(1.5)) - problem.force(1.5), 0, 4 * epsilon * 3);
  EXPECT_EQ(problem.force(1.5) - printed(1.5), 4);
  // Its momentum is the area of the triangle. Rectangles are exact for straight pieces; a rounding each.
  const auto momentum = [](const auto& force) {
    double sum = 0;
    for (int k = 0; k < 300; ++k) sum += force((k + 0.5) / 100) / 100;
    return sum;
  };
  nlmech::tests::expect_erratum(
      "rbf_ivp-4.24", {.printed = momentum([&](double t) { return t < 1.5 ? problem.force(t) : printed(t); }),
                       .corrected = momentum([&](double t) { return problem.force(t); }),
                       .oracle = 3.0 * 3 / 2,
                       .tolerance = 300 * epsilon});
}

TEST(ImpactForce, BranchesOnTheValueOfTime) {
  const Impact problem;
  EXPECT_EQ(problem.force(Dual<double, 1>::variable(0.25, 0)).partial[0], 2);
  EXPECT_EQ(problem.force(Dual<double, 1>::variable(0.5, 0)).partial[0], -2);
  EXPECT_EQ(problem.force(Dual<double, 1>::variable(1, 0)).partial[0], 0);
  const auto falling = problem.force(PowerSeries<double>::variable(0.75, 3));
  EXPECT_EQ(falling[0], 0.5);
  EXPECT_EQ(falling[1], -2);
  EXPECT_EQ(falling[2], 0);
}

TEST(ImpactForce, AddsToTheFreeOscillator) {
  const ivp::System system(TextProblem("impact", {{"natural_frequency", 2}, {"hardening", 3}}));
  ivp::State f;
  system.rhs(0.75, {0.5, 7}, f);
  EXPECT_EQ(f, (ivp::State{7, 0.5 - 4 * 0.5 - 3 * 0.125}));
  EXPECT_EQ(system.switches(), 0);  // its times are announced
}

using Times = std::vector<double>;

TEST(ImpactDiscontinuities, LieStrictlyBetweenInTheDirectionOfTravel) {
  const TextProblem problem("impact", {{"duration", 3}});
  EXPECT_EQ(problem.discontinuities(0, 500), (Times{1.5, 3}));
  EXPECT_EQ(problem.discontinuities(500, 0), (Times{3, 1.5}));
  EXPECT_EQ(problem.discontinuities(-1, 10), (Times{0, 1.5, 3}));
  EXPECT_EQ(problem.discontinuities(10, -1), (Times{3, 1.5, 0}));
  EXPECT_EQ(problem.discontinuities(1.5, 3), Times{});
  EXPECT_EQ(problem.discontinuities(1, 1.5), Times{});
  EXPECT_EQ(problem.discontinuities(1, 2), Times{1.5});
  EXPECT_EQ(problem.discontinuities(2, 2), Times{});
  EXPECT_EQ(TextProblem("impact", {{"duration", 0}}).discontinuities(-5, 5), Times{});
  EXPECT_THROW(TextProblem("impact", {{"duration", -1}}), InputError);
}

// Between announced times the force is a polynomial, at each of them its slope jumps: found by looking.
RC_GTEST_PROP(ImpactDiscontinuities, AreWhereTheSlopeOfTheForceJumps, ()) {
  const Impact problem({{"slope", *between(0.5, 3)}, {"duration", *between(0.1, 4)}});
  const auto slope = [&](double t) { return problem.force(Dual<double, 1>::variable(t, 0)).partial[0]; };
  const Times times = problem.text.discontinuities(-1, 5);
  RC_ASSERT(times.size() == 3U);
  for (const double t : times) RC_ASSERT(slope(before(t)) != slope(t));
  double from = -1;
  for (const double to : {times[0], times[1], times[2], 5.0}) {
    for (const double part : {0.1, 0.5, 0.9}) RC_ASSERT(slope(from) == slope(from + part * (to - from)));
    from = to;
  }
}

}  // namespace
}  // namespace nlmech::problems::tests::impact_test
