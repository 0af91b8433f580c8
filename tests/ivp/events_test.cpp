/// Events: location of zeros, order, and end of the integration.
#include "nlmech/ivp/events.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::events_test {
namespace {

using testing::eps;
using testing::nan;

constexpr Series accurate = {.relative_tolerance = 1e-15, .absolute_tolerance = 1e-15};

// The event function x[0] - level.
Event passes(double level, Crossing crossing = Crossing::either, bool ends = false) {
  return {[level](double, const State& x) { return x[0] - level; }, crossing, ends};
}

System falling() { return testing::typed("x'' = -1"); }

// Any level, frequency and direction of time: the number and the times of the crossings of a cosine.
RC_GTEST_PROP(Events, AreThoseOfTheCosine, ()) {
  const double frequency = *rc::gen::inRange(1, 40) / 10.;
  const double level = *rc::gen::inRange(-90, 90) / 100.;
  const bool backwards = *rc::gen::arbitrary<bool>();
  const double t1 = backwards ? -10.1 : 10.1;
  const auto [end, hits, open] = integrate_with_events(System(testing::Oscillator{.frequency = frequency}),
                                                       State{1, 0}, 0, t1, accurate, {passes(level)});
  RC_ASSERT(end.status.ok());
  std::vector<double> exact;
  const double turn = 2 * std::numbers::pi, angle = std::acos(level);
  for (int k = 0; k < 10; ++k) {
    for (const double a : {k * turn + angle, (k + 1) * turn - angle})
      if (a / frequency < 10.1) exact.push_back(std::copysign(a / frequency, t1));
  }
  RC_ASSERT(hits.size() == exact.size());
  // The slope at a crossing is sin(angle) >= 0.43: an error of the state of 100 eps is at most doubled in the
  // angle.
  for (std::size_t k = 0; k < exact.size(); ++k)
    RC_ASSERT(std::abs(hits[k].t - exact[k]) <= 300 * eps * 10.1);
}

TEST(Events, DirectionCountsAlongTheWay) {
  const System system(testing::Oscillator{});
  const auto count = [&](Crossing crossing, double t1) {
    return integrate_with_events(system, State{1, 0}, 0, t1, Series{}, {passes(0, crossing)}).hits.size();
  };
  EXPECT_EQ(count(Crossing::falling, 12), 2U);  // pi/2 and 5 pi/2
  EXPECT_EQ(count(Crossing::rising, 12), 2U);   // 3 pi/2 and 7 pi/2
  EXPECT_EQ(count(Crossing::falling, -3), 1U);  // in negative time the cosine decreases as well
  EXPECT_EQ(count(Crossing::rising, -3), 0U);
}

TEST(Events, OfOneStepComeInTheirOrder) {
  const System system = falling();  // exact for every step size
  const auto down = integrate_with_events(system, State{1, 0}, 0, 4, Series{.order = 4, .step = 4},
                                          {passes(0.25), passes(0.75), passes(0.5)});
  ASSERT_EQ(down.hits.size(), 3U);
  EXPECT_EQ(down.solution.statistics.steps, 1);
  EXPECT_EQ(down.hits[0].event, 1U);
  EXPECT_EQ(down.hits[1].event, 2U);
  EXPECT_EQ(down.hits[2].event, 0U);
  EXPECT_NEAR(down.hits[1].t, 1, 2 * eps);
}

// A ball that rebounds with half its speed v: a fall of duration 1, then arcs of duration 2 v. Each
// integration starts on the ground, and one step covers the whole interval: event functions are sampled 1.25
// apart.
TEST(Events, ThatEndTheIntegrationAllowToGoOn) {
  const System system = falling();
  double t = 0, expected = 0, speed = 1;
  State x{0.5, 0};
  for (int bounce = 0; bounce < 20; ++bounce) {
    const auto [end, hits, open] = integrate_with_events(system, x, t, t + 10, accurate,
                                                         {passes(0, Crossing::falling, true), passes(10)});
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    ASSERT_EQ(hits.size(), 1U);
    expected += bounce == 0 ? 1 : 2 * speed;
    EXPECT_NEAR(end.t, expected, 8 * eps * expected) << bounce;
    EXPECT_NEAR(end.x[1], -speed, 16 * eps);
    EXPECT_EQ(end.t, hits[0].t);
    speed /= 2;
    t = end.t;
    x = State{0, speed};
  }
}

// The dense output has order 4: halving the step size divides the error of the event time by about 16.
TEST(Events, OfOtherMethodsAreAsAccurateAsTheirDenseOutput) {
  const System system(testing::Oscillator{});
  const auto error = [&](double step) {
    const auto found = integrate_with_events(system, State{1, 0}, 0, 3, Rk4{.step = step}, {passes(0)});
    EXPECT_EQ(found.hits.size(), 1U);
    return std::abs(found.hits[0].t - std::numbers::pi / 2);
  };
  EXPECT_LT(error(0.05), 1e-6);
  EXPECT_GT(error(0.1) / error(0.05), 8);
}

// Within the tolerance of 1e-9; the corrected state is on the surface, to rounding.
TEST(Events, OfEmbeddedMethodsAreAsAccurateAsTheirSteps) {
  const auto error = [&](const auto& method) {
    const auto found =
        integrate_with_events(System(testing::Oscillator{}), State{1, 0}, 0, 3, method, {passes(0)});
    EXPECT_EQ(found.hits.size(), 1U);
    EXPECT_LE(std::abs(found.hits[0].x[0]), 4 * eps);
    return std::abs(found.hits[0].t - std::numbers::pi / 2);
  };
  EXPECT_LT(error(Ode45{}), 1e-9);
  EXPECT_LT(error(Dop853{}), 1e-9);
}

// One step from 0 to 10 and an event function with 63 zeros: bounds find all of them, signs at 8 sampled
// times do not.
TEST(Events, WithBoundsNoZeroIsPassedOver) {
  Event event{[](double t, const State&) { return std::sin(20 * t); }};
  const auto count = [&] {
    const Series one_step{.order = 4, .step = 10};
    return integrate_with_events(falling(), State{0, 0}, 0, 10, one_step, {event}).hits;
  };
  EXPECT_LT(count().size(), 10U);
  event.bounds = [](const program::Interval& t, std::span<const program::Interval>) { return sin(20 * t); };
  event.rate_bounds = [](const program::Interval& t, std::span<const program::Interval>) {
    return 20 * cos(20 * t);
  };
  const std::vector<Hit> hits = count();
  ASSERT_EQ(hits.size(), 63U);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    EXPECT_NEAR(hits[k].t, static_cast<double>(k + 1) * std::numbers::pi / 20, 4 * eps * 10);
    EXPECT_EQ(hits[k].direction, k % 2 == 0 ? -1 : 1);
  }
}

// x = 1 - t^2/2 is 0 at sqrt 2, and x^2 touches zero there.
TEST(Events, DoubleZerosAreHitsWithoutDirection) {
  Event square{[](double, const State& x) { return x[0] * x[0]; }};
  square.bounds = [](const program::Interval&, std::span<const program::Interval> x) {
    return program::square(x[0]);
  };
  square.rate_bounds = [](const program::Interval&, std::span<const program::Interval> x) {
    return 2 * (x[0] * x[1]);
  };
  const auto found = [&] { return integrate_with_events(falling(), State{1, 0}, 0, 3, Series{}, {square}); };
  const EventSolution either = found();
  ASSERT_EQ(either.hits.size(), 1U);
  EXPECT_EQ(either.hits[0].direction, 0);
  EXPECT_NEAR(either.hits[0].t, std::sqrt(2), 1e-8);
  square.crossing = Crossing::falling;
  EXPECT_TRUE(found().hits.empty());
  EXPECT_EQ(found().open.size(), 1U);  // reported as an open event
}

// The time of a double zero of a function of time alone is a double, whose neighbours have another value.
RC_GTEST_PROP(Events, DoubleZerosOfTimeAreHits, ()) {
  const double at = *rc::gen::inRange(100, 900) / 1000.;
  Event square{[=](double t, const State&) { return (t - at) * (t - at); }};
  square.bounds = [=](const program::Interval& t, std::span<const program::Interval>) {
    return program::square(t - program::Interval(at));
  };
  square.rate_bounds = [=](const program::Interval& t, std::span<const program::Interval>) {
    return 2 * (t - program::Interval(at));
  };
  const std::vector<Hit> hits = integrate_with_events(falling(), State{1, 0}, 0, 1, Series{}, {square}).hits;
  RC_ASSERT(hits.size() == 1U);
  RC_ASSERT(std::abs(hits[0].t - at) <= 4 * eps);
}

// max(sin(w t + p), 0) within one step: a hit where it comes to zero, and a rest from there until it leaves.
RC_GTEST_PROP(Events, WhatIsZeroInPartsIsHitWhereItComesToZero, ()) {
  const double w = *rc::gen::inRange(5, 40) / 10., p = *rc::gen::inRange(1, 62) / 10., pi = std::numbers::pi;
  Event positive{[=](double t, const State&) { return std::max(std::sin(w * t + p), 0.); }};
  const auto sine = [=](const program::Interval& t) { return sin(w * t + program::Interval(p)); };
  positive.bounds = [=](const program::Interval& t, std::span<const program::Interval>) {
    return program::Interval(std::max(sine(t).low, 0.), std::max(sine(t).high, 0.));
  };
  positive.rate_bounds = [=](const program::Interval& t, std::span<const program::Interval>) {
    const program::Interval rate = w * cos(w * t + program::Interval(p)), none(0);
    return sine(t).high < 0 ? none : sine(t).low > 0 ? rate : hull(none, rate);
  };
  const Series one_step{.order = 4, .step = 10};
  const auto [end, hits, open] = integrate_with_events(falling(), State{0, 0}, 0, 10, one_step, {positive});
  RC_ASSERT(end.status.ok());
  std::vector<double> from, to;  // of the rests
  for (double k = 1; (k * pi - p) / w < 10; k += 2) {
    if (((k + 1) * pi - p) / w < 0) continue;
    from.push_back(std::max((k * pi - p) / w, 0.));
    to.push_back(std::min(((k + 1) * pi - p) / w, 10.));
  }
  const std::size_t before = !from.empty() && from[0] == 0 ? 1 : 0;  // rests that began before the start
  RC_ASSERT(open.size() == from.size());
  RC_ASSERT(hits.size() == from.size() - before);
  const double few = 100 * eps / w;  // rounding of the angle, of up to 46
  for (std::size_t k = 0; k < open.size(); ++k) {
    RC_ASSERT(open[k].rests);
    RC_ASSERT(std::abs(open[k].t0 - from[k]) <= few);
    RC_ASSERT(std::abs(open[k].t1 - to[k]) <= few);
    if (k >= before) RC_ASSERT(hits[k - before].t == open[k].t0);
  }
}

// The bouncing ball in one integration: each arc takes half the time of the arc before. The rebounds
// accumulate at t = 3.
TEST(Events, ChangeTheState) {
  Event ground = passes(0, Crossing::falling);
  ground.bounds = [](const program::Interval&, std::span<const program::Interval> x) { return x[0]; };
  ground.rate_bounds = [](const program::Interval&, std::span<const program::Interval> x) { return x[1]; };
  ground.change = [](double, State& x) { x[1] = -x[1] / 2; };
  const auto to = [&](double t1) {
    return integrate_with_events(falling(), State{0.5, 0}, 0, t1, accurate, {ground});
  };
  const EventSolution some = to(2.9);
  ASSERT_TRUE(some.solution.status.ok()) << some.solution.status.text();
  ASSERT_EQ(some.hits.size(), 5U);  // at 1, 2, 2.5, 2.75, 2.875
  EXPECT_NEAR(some.hits[4].t, 2.875, 32 * eps * 3);
  EXPECT_NEAR(some.hits[4].after[1], 1. / 32, 64 * eps);
  EXPECT_NEAR(some.solution.x[0], 0.025 / 32 - 0.025 * 0.025 / 2, 64 * eps);
  const EventSolution all = to(4);
  EXPECT_EQ(all.solution.status.outcome(), Outcome::outside_validity);
  EXPECT_NEAR(all.solution.t, 3, 1e-9);
  // The third rebound ends the integration.
  ground.ends = 3;
  EXPECT_NEAR(to(4).solution.t, 2.5, 32 * eps * 3);
  EXPECT_EQ(to(4).hits.size(), 3U);
}

TEST(Events, MistakesAndFunctionsWithoutValue) {
  const System system(testing::Oscillator{});
  EXPECT_THROW((void)integrate_with_events(system, State{1, 0}, 0, 3, Series{}, {Event{}}),
               std::invalid_argument);
  Event no_rate = passes(0);
  no_rate.bounds = [](const program::Interval&, std::span<const program::Interval> x) { return x[0]; };
  EXPECT_THROW((void)integrate_with_events(system, State{1, 0}, 0, 3, Series{}, {no_rate}),
               std::invalid_argument);
  const auto [end, hits, open] = integrate_with_events(
      system, State{1, 0}, 0, 3, Series{},
      {{[](double t, const State&) { return t < 1 ? 1. : nan; }, Crossing::either, false}});
  EXPECT_EQ(end.status.outcome(), Outcome::non_finite);
  EXPECT_NE(end.status.text().find("event"), std::string::npos) << end.status.text();
  EXPECT_TRUE(hits.empty());
}

// The event function has values at the sampled times, 0.5 apart, and is NaN within the interval of the zero.
TEST(Events, NoValueOnTheWayToTheZero) {
  const auto value = [](double t, const State&) { return t <= 1 ? 1. : t < 1.5 ? nan : -1.; };
  for (const bool ends : {false, true}) {
    const auto [end, hits, open] = integrate_with_events(
        falling(), State{1, 0}, 0, 4, Series{.order = 4, .step = 4}, {{value, Crossing::either, ends}});
    EXPECT_EQ(end.status.outcome(), Outcome::non_finite) << ends;
    EXPECT_TRUE(hits.empty()) << ends;
  }
}

TEST(Events, TheObserverStillEndsTheIntegration) {
  const System system(testing::Oscillator{});
  const auto [end, hits, open] = integrate_with_events(system, State{1, 0}, 0, 30, Series{}, {passes(0)},
                                                       [](const Step& step) { return step.t1 < 2; });
  EXPECT_EQ(end.status.outcome(), Outcome::interrupted);
  EXPECT_EQ(hits.size(), end.t > 1.5 * std::numbers::pi ? 2U : 1U);
}

}  // namespace
}  // namespace nlmech::ivp::events_test
