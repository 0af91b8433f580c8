/// What the chapter's own studies claim: how energies drift, where days about an oblate Earth end, that steps
/// beyond the radius of convergence diverge, and that units do not matter.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "chapters/two_body_series/orbits/extremes.hpp"
#include "chapters/two_body_series/orbits/propagators.hpp"
#include "chapters/two_body_series/zonal/drift_runs.hpp"
#include "chapters/two_body_series/zonal/zonal.hpp"
#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::two_body_series::studies_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

double energy_slope(const Drift& d) { return Drift::slope(d.orbits, d.energy); }

TEST(Drift, SlopeOfPowers) {
  const std::vector<int> orbits = {10, 100, 1000, 10'000};
  // What comes before 100 orbits does not count. Sums of squares of logarithms, up to 85, cancel.
  EXPECT_NEAR(Drift::slope(orbits, {1, 1, std::sqrt(10.0), 10}), 0.5, 64 * eps);
  EXPECT_NEAR(Drift::slope(orbits, {5, 2, 20, 200}), 1, 64 * eps);
}

// A walk of 30 000 steps of some tenths of eps, against the same share of eps in each step, the same way:
// 5e-15 and 5e-14 after a thousand orbits are recorded.
TEST(Drift, DivisionWalksAndReciprocalsDrift) {
  DriftTask task{"", 0.1, 22, 30};
  task.phases = 16;
  const Drift walk = drift_of(task, 1000);
  task.true_division = false;
  task.phases = 2;
  const Drift line = drift_of(task, 1000);
  EXPECT_LT(walk.energy.back(), 2e-14);
  EXPECT_GT(line.energy.back(), 3 * walk.energy.back());
  EXPECT_LT(energy_slope(walk), 0.8);
  EXPECT_EQ(walk.orbits.back(), 1000);
}

// Compensation takes the rounding of sums away, which is most of it.
TEST(Drift, CompensationHelps) {
  DriftTask task{"", 0.1, 22, 30, false};
  task.phases = 16;
  const double plain = drift_of(task, 300).energy.back();
  task.compensated = true;
  EXPECT_LT(drift_of(task, 300).energy.back(), plain);
}

TEST(Drift, AdaptiveWalks) {
  DriftTask task{"", 0.7, 0, 0};
  task.tolerance = 1e-17;
  task.phases = 8;
  // 30 orbits to 1000: a walk of some twenty steps an orbit, each rounding |v|^2/2, up to six times |E|.
  EXPECT_LT(drift_of(task, 1000).energy.back(), 6 * eps * std::sqrt(20 * 1000));
}

TEST(Zonal, EndsOfADay) {
  for (const ZonalDay& d : zonal_days()) {
    const ZonalErrors plain = day_in_double(d), exact = day_in_extended(d);
    EXPECT_LT(plain.position, 1e-5) << d.name;
    EXPECT_LT(plain.velocity, 1e-8) << d.name;
    EXPECT_LT(plain.energy, 64 * eps) << d.name;  // some 200 steps of a walk of eps/2 and less
    EXPECT_LT(exact.position, 1e-9) << d.name;
    EXPECT_LT(exact.velocity, 1e-12) << d.name;
    EXPECT_LT(exact.energy, 1e-18) << d.name;  // tolerance 1e-21 in some hundred steps
  }
}

/// |dr|/a after one step of a share of an orbit from the periapsis.
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

// Scaling by powers of two touches no digit; by other numbers it rounds mu, the time and six components.
TEST(Units, DoNotMatter) {
  EXPECT_EQ(difference_between_units(0x1p23, 0x1p10), 0);
  EXPECT_EQ(difference_between_units(0x1p-40, 0x1p-33), 0);
  EXPECT_LE(difference_between_units(7309041.111, canonical_time(7309041.111)),
            16 * rounding_between_units());
  EXPECT_LE(difference_between_units(1000, 1), 16 * rounding_between_units());
}

// The propagators as integrators in general give what they give by themselves, and observers see every step.
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

  int seen = 0;
  const auto count = [&](const ivp::Step& step) {
    ++seen;
    EXPECT_EQ(parted(step.x1).position, orbit::propagate_kepler(start, step.t1 - 2, 1).state.position);
    return true;
  };
  const auto closed = kepler_integrator(1)(system, joined(start), 2, 9, count, {});
  EXPECT_EQ(seen, 16);
  EXPECT_EQ(parted(closed.x).velocity, orbit::propagate_kepler(start, 7, 1).state.velocity);
}

}  // namespace
}  // namespace nlmech::chapters::two_body_series::studies_test
