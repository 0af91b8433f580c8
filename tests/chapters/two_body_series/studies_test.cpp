/// Statements of the chapter's studies: steps beyond the radius of convergence diverge, and units have no
/// influence.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "chapters/two_body_series/orbits/extremes.hpp"
#include "chapters/two_body_series/orbits/propagators.hpp"
#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::two_body_series::studies_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// |dr|/a after one step of a fraction of an orbit from the periapsis.
double error_of_a_step(double eccentricity, int steps, int order) {
  const orbit::State start = on_ellipse(eccentricity);
  const double step = revolution / steps;
  const auto end = orbit::propagate(start, 0, step, orbit::Gravity{},
                                    orbit::FixedContinuation{.step = step, .order = order});
  EXPECT_TRUE(end.status.ok());
  return position_error(start, step, 1, end.x.position);
}

// e = 0.7: 34.6 steps an orbit are the radius of convergence at the periapsis.
TEST(ConvergenceRadius, DecidesWhatAnOrderIsWorth) {
  EXPECT_NEAR(revolution / orbit::convergence_radius_at_periapsis(0.7), 34.63, 0.01);
  for (const int order : {20, 40, 60}) {
    EXPECT_GT(error_of_a_step(0.7, 25, order + 20), 50 * error_of_a_step(0.7, 25, order)) << order;
    EXPECT_LT(error_of_a_step(0.7, 50, order + 20), 0.02 * error_of_a_step(0.7, 50, order)) << order;
  }
}

TEST(Ellipses, AreWhereTheyShouldBe) {
  // M = pi: the apoapsis, a (1 + e); the velocity is the one of the vis-viva equation.
  const orbit::State far = on_ellipse(0.7, revolution / 2);
  EXPECT_NEAR(far.position[0], -1.7, 4 * eps);
  EXPECT_NEAR(far.position[1], 0, 4 * eps);
  EXPECT_NEAR(far.velocity[1], -std::sqrt(2 / 1.7 - 1), 4 * eps);
  EXPECT_EQ(position_error(far, 0, 1, far.position), 0);
}

// Scaling by powers of two changes no digit; other factors round mu, the time and six components.
TEST(Units, DoNotMatter) {
  EXPECT_EQ(difference_between_units(0x1p23, 0x1p10), 0);
  EXPECT_EQ(difference_between_units(0x1p-40, 0x1p-33), 0);
  EXPECT_LE(difference_between_units(7309041.111, canonical_time(7309041.111)),
            16 * rounding_between_units());
  EXPECT_LE(difference_between_units(1000, 1), 16 * rounding_between_units());
}

// The propagators as integrators give the results of direct calls, and observers receive every step.
TEST(Propagators, AsIntegrators) {
  const ivp::System system(problems::TextProblem("two-body", {{"mu", 1}}));
  const orbit::State start = on_ellipse(0.7, 1);
  const orbit::AnalyticContinuation method{.tolerance = 1e-12};
  const auto plain = orbit::propagate(start, 2, 9, orbit::Gravity{}, method);
  double last = 2;
  const auto observe = [&](const ivp::Step& step) {
    EXPECT_EQ(step.t0, last);
    last = step.t1;
    ivp::State end(6);
    step.dense.at(step.t1, end);
    EXPECT_LE((end - step.x1).norm(), 64 * eps * step.x1.norm());
    EXPECT_EQ(step.states.col(0), step.x1);
    return true;
  };
  const auto end = continuation_integrator(method, 1)(system, joined(start), 2, 9, observe, {});
  EXPECT_EQ(last, 9);
  EXPECT_EQ(parted(end.x).position, plain.x.position);
  EXPECT_EQ(end.statistics.steps, plain.statistics.steps);
  EXPECT_GE(end.statistics.right_hand_sides, 12 * end.statistics.steps);  // the lowest order that is chosen
  const auto limited = continuation_integrator(method, 1)(system, joined(start), 2, 9, {}, {.steps = 3});
  EXPECT_EQ(limited.status.outcome(), Outcome::step_limit);

  int steps = 0;
  const auto count = [&](const ivp::Step& step) {
    ++steps;
    EXPECT_EQ(parted(step.x1).position, orbit::propagate_kepler(start, step.t1 - 2, 1).state.position);
    return true;
  };
  const auto closed = kepler_integrator(1)(system, joined(start), 2, 9, count, {});
  EXPECT_EQ(steps, 16);
  EXPECT_EQ(parted(closed.x).velocity, orbit::propagate_kepler(start, 7, 1).state.velocity);
}

}  // namespace
}  // namespace nlmech::chapters::two_body_series::studies_test
