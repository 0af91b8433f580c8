/// Many orbits in SIMD lanes: errors against Kepler's equation in 50 digits, bitwise equal results for any
/// neighbours, rows in between, and independent failures.
#include "nlmech/orbit/ensemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/kernels/baseline.hpp"
#include "nlmech/support/kernels/rough_logarithm.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::ensemble_test {
namespace {

using namespace oracle;

constexpr InstructionSet all_sets[] = {InstructionSet::baseline, InstructionSet::avx2,
                                       InstructionSet::avx512};

double error_of(const Solution& c, const PropagationRequest& f) {
  return relative_distance(c.x.position, kepler(f.start, f.until, f.gravity.mu).position);
}

std::vector<std::uint64_t> bits_of(const Solution& c) {
  std::vector<std::uint64_t> bits = {std::bit_cast<std::uint64_t>(c.t),
                                     static_cast<std::uint64_t>(c.statistics.steps),
                                     static_cast<std::uint64_t>(c.status.outcome())};
  for (int i = 0; i < 3; ++i) {
    bits.push_back(std::bit_cast<std::uint64_t>(c.x.position[i]));
    bits.push_back(std::bit_cast<std::uint64_t>(c.x.velocity[i]));
  }
  return bits;
}

/// Ellipses, hyperbolas, falls into the centre, both directions of time, zonal fields, and invalid data.
PropagationRequest random_flight() {
  PropagationRequest f{
      random_state(*between(0.5, 2), 1, *between(0, 1.8), *between(0, pi)), *between(-20, 20), {}};
  f.gravity.mu = *rc::gen::element(0.5, 1.0, 1.7);
  switch (*rc::gen::inRange(0, 12)) {
    case 0: f.until = 0; break;
    case 1: f.start.position.setZero(); break;
    case 2: f.start.velocity[1] = std::nan(""); break;
    case 3: f.gravity.mu = -1; break;
    case 4: f.start.velocity = -0.1 * f.start.position; break;  // into the centre
    case 5: f.gravity.zonal[0] = 1e-3; break;
    case 6: f.gravity.zonal = {1e-3, *rc::gen::element(0.0, 2e-6), -1e-6, 0, 1e-7}; break;
    default: break;
  }
  return f;
}

// The error bound of AnalyticContinuation; derivation: continuation_test.cpp.
RC_GTEST_PROP(Ensemble, ErrorFollowsTheTolerance, ()) {
  const double tolerance = std::pow(10, *between(-15, -4));
  std::vector<PropagationRequest> flights;
  for (int i = 0; i < 5; ++i)
    flights.push_back({random_state(1, 1, *between(0.3, 1.8), *between(0.3, 2.8)), *between(-10, 10), {}});
  for (const InstructionSet set : all_sets) {
    if (!available(set)) continue;
    const auto ends = propagate_all(flights, {.tolerance = tolerance, .threads = 1, .instructions = set});
    for (std::size_t i = 0; i < flights.size(); ++i) {
      RC_ASSERT(ends[i].status.ok());
      RC_ASSERT(ends[i].t == flights[i].until);
      const double kappa = kepler_condition(flights[i].start, flights[i].until, 1).position;
      const auto n = static_cast<double>(ends[i].statistics.steps);
      RC_ASSERT(error_of(ends[i], flights[i]) <= kappa * (2 * n * tolerance + (8 + std::sqrt(n)) * eps));
    }
  }
}

// Every order, and orbits up to e = 0.99: as for a single orbit, the default tolerance leaves rounding errors
// only.
TEST(Ensemble, DefaultIsAtTheLevelOfRounding) {
  std::vector<PropagationRequest> flights;
  for (const double e : {0., 0.1, 0.3, 0.5, 0.7, 0.9, 0.99})
    flights.push_back({at_periapsis(e), 2 * pi * 20.25, {}});
  for (int order = 8; order <= 32; order += 2) {
    const auto ends = propagate_all(flights, {.order = order});
    for (std::size_t i = 0; i < flights.size(); ++i) {
      const double kappa = kepler_condition(flights[i].start, flights[i].until, 1).position;
      const auto n = static_cast<double>(ends[i].statistics.steps);
      EXPECT_LE(error_of(ends[i], flights[i]), kappa * (8 + std::sqrt(n)) * eps) << order << ' ' << i;
      EXPECT_EQ(ends[i].statistics.right_hand_sides, order * ends[i].statistics.steps);
    }
  }
}

// Bitwise equal results for a single orbit, other neighbours in the lanes, another order of the catalogue,
// and any number of threads; equal for AVX2 and AVX-512.
RC_GTEST_PROP(Ensemble, SameBitsWhateverFliesBeside, ()) {
  std::vector<PropagationRequest> flights;
  const int count = *rc::gen::inRange(1, 70);
  for (int i = 0; i < count; ++i) flights.push_back(random_flight());
  const TaylorEnsemble method{
      .tolerance = *rc::gen::element(1e-15, 1e-9),
      .threads = *rc::gen::inRange(1, 4),
      .instructions = *rc::gen::element(InstructionSet::baseline, best_instruction_set())};
  const auto ends = propagate_all(flights, method);
  std::vector<std::size_t> order(flights.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(*rc::gen::arbitrary<unsigned>()));
  order.resize(static_cast<std::size_t>(*rc::gen::inRange(1, count + 1)));
  std::vector<PropagationRequest> others;
  for (const std::size_t i : order) others.push_back(flights[i]);
  for (const InstructionSet set : all_sets) {
    const bool rounds_alike =
        (set == InstructionSet::baseline) == (*method.instructions == InstructionSet::baseline);
    if (!available(set) || !rounds_alike) continue;
    for (const int threads : {1, 3}) {
      const auto again =
          propagate_all(others, {.tolerance = method.tolerance, .threads = threads, .instructions = set});
      for (std::size_t k = 0; k < order.size(); ++k) RC_ASSERT(bits_of(again[k]) == bits_of(ends[order[k]]));
    }
  }
  const std::size_t one = order[0];
  const auto alone = propagate_all(std::span(&flights[one], 1), method);
  RC_ASSERT(bits_of(alone[0]) == bits_of(ends[one]));
}

// The error in any units equals that in units with mu = 1 and r = 1.
RC_GTEST_PROP(Ensemble, UnitsDoNotMatter, ()) {
  const PropagationRequest f{
      random_state(1, 1, *between(0.3, 1.8), *between(0.3, 2.8)), *between(-10, 10), {}};
  const int length = *rc::gen::inRange(-300, 300), time = *rc::gen::inRange(-300, 300);
  PropagationRequest g{
      {f.start.position * std::ldexp(1, length), f.start.velocity * std::ldexp(1, length - time)},
      std::ldexp(f.until, time),
      {}};
  RC_PRE(std::abs(3 * length - 2 * time) < 1000);
  g.gravity.mu = std::ldexp(1, 3 * length - 2 * time);
  const Solution end = propagate_all(std::span(&g, 1))[0];
  RC_ASSERT(end.status.ok());
  const double kappa = kepler_condition(f.start, f.until, 1).position;
  const auto n = static_cast<double>(end.statistics.steps);
  const Vector3<double> place = end.x.position * std::ldexp(1, -length);
  RC_ASSERT(relative_distance(place, kepler(f.start, f.until, 1).position) <=
            kappa * (2 * n * 1e-15 + (8 + std::sqrt(n)) * eps));
}

struct InnerRow {
  double t;
  State x;
};

// Rows in between are at the requested multiples and use the same series; they do not change the end state.
RC_GTEST_PROP(Ensemble, RowsBetween, ()) {
  std::vector<PropagationRequest> flights;
  for (int i = 0; i < 3; ++i)
    flights.push_back({random_state(1, 1, *between(0.3, 1.8), *between(0.3, 2.8)), *between(-10, 10), {}});
  flights[2].gravity.zonal[0] = 1e-300;  // practically a point mass, but in the lanes of zonal fields
  const double every = *between(0.7, 3);
  std::vector<std::vector<InnerRow>> rows(flights.size());
  const InnerRows wanted{every, [&](std::size_t i, double t, const State& x) { rows[i].push_back({t, x}); }};
  const auto ends = propagate_all(flights, {.threads = 2}, wanted), plain = propagate_all(flights);
  for (std::size_t i = 0; i < flights.size(); ++i) {
    RC_ASSERT(bits_of(ends[i]) == bits_of(plain[i]));
    const double until = flights[i].until, whole = std::floor(std::abs(until) / every * (1 - 1e-12));
    RC_ASSERT(static_cast<double>(rows[i].size()) == whole);
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      const double t = rows[i][k].t;
      RC_ASSERT(std::abs(t) == static_cast<double>(k + 1) * every);
      RC_ASSERT(t * until > 0);
      const auto n = static_cast<double>(ends[i].statistics.steps);
      // kappa of the state includes that of the time, which is rounded as well.
      const double bound =
          kepler_condition(flights[i].start, t, 1).position * (2 * n * 1e-15 + (8 + std::sqrt(n)) * eps);
      RC_ASSERT(relative_distance(rows[i][k].x.position, kepler(flights[i].start, t, 1).position) <= bound);
    }
  }
}

TEST(Ensemble, FailuresAreTheirOwn) {
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<PropagationRequest> flights(7, PropagationRequest{at_periapsis(0.5), 40, {}});
  flights[0].start.position.setZero();
  flights[1].start.velocity[2] = inf;
  flights[2].gravity.mu = 0;
  flights[3].until = std::nan("");
  flights[4].start.velocity = {0, 0, 0};
  flights[5].until = 0;
  const auto ends = propagate_all(flights);
  const Outcome outcomes[] = {Outcome::collision,  Outcome::non_finite, Outcome::outside_validity,
                              Outcome::non_finite, Outcome::collision,  Outcome::success,
                              Outcome::success};
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_EQ(ends[i].status.outcome(), outcomes[i]) << ends[i].status.text();
  EXPECT_NEAR(ends[4].t, pi / std::sqrt(8.) * std::pow(0.5, 1.5), 1e-6);  // free fall from r = 1/2
  EXPECT_EQ(ends[5].x.position, flights[5].start.position);
  EXPECT_EQ(bits_of(ends[6]), bits_of(propagate_all(std::span(&flights[6], 1))[0]));
  for (const Solution& end : propagate_all(flights, {}, {}, {.steps = 7})) EXPECT_LE(end.statistics.steps, 7);
  EXPECT_EQ(propagate_all(flights, {}, {}, {.steps = 7})[6].status.outcome(), Outcome::step_limit);
  EXPECT_EQ(propagate_all(flights, {}, {}, {.seconds = 0})[6].status.outcome(), Outcome::time_limit);
  EXPECT_TRUE(propagate_all({}).empty());
}

// In its own units the end time exceeds the range of double.
TEST(Ensemble, AFlightThatCannotGoOnKnowsItsTime) {
  const Gravity zonal{.radius = 1e-300, .zonal = {1e-3}};
  const std::vector<PropagationRequest> flights = {{{{1e-300, 0, 0}, {0, 1, 0}}, 86400, {}},
                                                   {{{1e-300, 0, 0}, {0, 1, 0}}, 86400, zonal},
                                                   {{{1, 0, 0}, {1e200, 0, 0}}, 1e300, {}}};
  for (const Solution& end : propagate_all(flights)) {
    EXPECT_FALSE(end.status.ok());
    EXPECT_EQ(end.t, 0) << end.status.text();
  }
}

// A day in the Earth's field with several tolerances: a step has an error of one tolerance, amplified as in
// Kepler's motion, to the per mille of J_2. The rounding error of a day is added.
TEST(Ensemble, ZonalFlightsFollowTheTolerance) {
  const PropagationRequest f{low_orbit, 86400, earth(6)};
  const Solution exact = propagate(f.start, 0, f.until, f.gravity);
  const double kappa = kepler_condition(f.start, f.until, f.gravity.mu).position;
  for (const InstructionSet set : all_sets) {
    if (!available(set)) continue;
    for (const double tolerance : {1e-5, 1e-8, 1e-11, 1e-15}) {
      const Solution end = propagate_all(std::span(&f, 1), {.tolerance = tolerance, .instructions = set})[0];
      ASSERT_TRUE(end.status.ok()) << end.status.text();
      EXPECT_EQ(end.t, f.until);
      const auto n = static_cast<double>(end.statistics.steps);
      const double off = (end.x.position - exact.x.position).norm() / exact.x.position.norm();
      EXPECT_LE(off, kappa * (2 * n * tolerance + 2 * (8 + std::sqrt(n)) * eps)) << tolerance;
    }
  }
}

// Fall into the centre of an oblate body: fails as AnalyticContinuation does, at a time in the user's units,
// with each row once.
TEST(Ensemble, AZonalFlightThatFails) {
  PropagationRequest f{{{7e6, 0, 0}, {0, 0, 0}}, 86400, earth(2)};
  std::vector<double> times;
  const InnerRows rows{50, [&](std::size_t, double t, const State&) { times.push_back(t); }};
  const Solution end = propagate_all(std::span(&f, 1), {}, rows)[0];
  const Solution alone = propagate(f.start, 0, f.until, f.gravity);
  EXPECT_EQ(end.status.outcome(), alone.status.outcome()) << end.status.text();
  EXPECT_FALSE(end.status.ok());
  EXPECT_EQ(end.t, alone.t);
  ASSERT_EQ(times.size(), static_cast<std::size_t>(alone.t / 50));
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_EQ(times[k], 50.0 * static_cast<double>(k + 1));
  EXPECT_EQ(propagate_all(std::span(&f, 1), {}, {}, {.steps = 3})[0].status.outcome(), Outcome::step_limit);
}

// A time so long that every step is below its rounding: fails at once, as AnalyticContinuation does and as
// for a point mass.
TEST(Ensemble, ZonalStepsMoveTheTime) {
  for (const double until : {1e40, -1e40}) {
    std::vector<PropagationRequest> flights(2, PropagationRequest{low_orbit, until, earth(2)});
    flights[1].gravity = earth();
    for (const Solution& end : propagate_all(flights)) {
      EXPECT_EQ(end.status.outcome(), Outcome::step_underflow) << end.status.text();
      EXPECT_EQ(end.t, 0);
      EXPECT_EQ(end.x.position, low_orbit.position);
    }
  }
}

// The limit of wall time holds for the whole ensemble: orbits in progress end where they are, others at their
// start.
TEST(Ensemble, SecondsAreOfTheWhole) {
  for (const int degree : {0, 2}) {
    const std::vector<PropagationRequest> flights(200, PropagationRequest{low_orbit, 1e10, earth(degree)});
    std::vector<double> shown(flights.size());
    const InnerRows rows{3600, [&](std::size_t i, double t, const State&) { shown[i] = t; }};
    const auto ends = propagate_all(flights, {.threads = 1}, rows, {.seconds = 0.2});
    EXPECT_GT(ends[0].t, 3600);
    EXPECT_LT(ends[199].t, ends[0].t);
    for (std::size_t i = 0; i < flights.size(); ++i) {
      EXPECT_EQ(ends[i].status.outcome(), Outcome::time_limit) << ends[i].status.text();
      EXPECT_GE(ends[i].t, shown[i]);
      EXPECT_LT(ends[i].t, 1e10);
    }
  }
}

TEST(Ensemble, RefusesOptions) {
  const std::vector<PropagationRequest> none;
  EXPECT_THROW((void)propagate_all(none, {.tolerance = 0}), std::invalid_argument);
  EXPECT_THROW((void)propagate_all(none, {.order = 7}), std::invalid_argument);
  EXPECT_THROW((void)propagate_all(none, {.order = 9}), std::invalid_argument);
  EXPECT_THROW((void)propagate_all(none, {.order = 34}), std::invalid_argument);
  EXPECT_THROW((void)propagate_all(none, {.threads = -1}), std::invalid_argument);
  EXPECT_THROW((void)propagate_all(none, {}, {.every = 0}), std::invalid_argument);
}

// The error bounds stated in the header, against the library's functions; the step-size control needs no
// more.
TEST(RoughLogarithm, IsAsExactAsStated) {
  using Two = simd::Pack<simd::Baseline, 2>;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-1000, 1000);
  for (int i = 0; i < 20000; ++i) {
    const double x = exponent(random), y = std::exp2(x);
    EXPECT_NEAR(rough_log2(Two::all(y))[0], x, 6e-5);
    EXPECT_NEAR(rough_exp2(Two::all(x))[1] / y, 1, 1.1e-4);
  }
  EXPECT_NEAR(rough_exp2(Two::all(2000))[0] / 0x1p1000, 1, 1.1e-4);
  EXPECT_NEAR(rough_exp2(Two::all(-2000))[0] / 0x1p-1000, 1, 1.1e-4);
}

}  // namespace
}  // namespace nlmech::orbit::ensemble_test
