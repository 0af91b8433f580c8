/// Reference solutions against closed forms and published digits: their accuracy, and their stated
/// uncertainty.
#include "nlmech/comparison/reference/reference_of.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::comparison::reference_test {
namespace {

/// A candidate that returns constant states, or a failure.
Candidate giving(const std::string& name, double value, bool arrives = true) {
  return {name, false, [=](const ReferenceRequest& way, double, StatesAt& states) {
            states = StatesAt::Constant(way.x0.size(), static_cast<Eigen::Index>(way.times.size()), value);
            return arrives ? Status() : Status::failure(Outcome::step_limit, name + ": too many steps");
          }};
}

const ReferenceRequest one_step = {ExtendedState::Constant(1, 1.0L), 0, {1}};

// A NaN in any component is reported; later components must not hide it.
TEST(RelativeError, KeepsWhatIsNoNumber) {
  const Vector<double, 3> size(1, 1, 1);
  const Vector<long double, 3> exact(1, 2, 4);
  EXPECT_EQ(relative_error({1, 2, 5}, exact, size), 0.25);
  for (int i = 0; i < 3; ++i) {
    Vector<double, 3> found(1, 2, 5);
    found[i] = NAN;
    EXPECT_TRUE(std::isnan(relative_error(found, exact, size))) << i;
  }
}

TEST(Agree, KnowsNoMoreThanTheTwoHaveInCommon) {
  const Reference r = agree({giving("a", 1), giving("b", 1 + 1e-5)}, one_step, {}, 1);
  ASSERT_TRUE(r.status.ok());
  EXPECT_NEAR(r.uncertainty() / 1e-5, 1, 1e-9);  // rounding error of 1 + 1e-5 is 1e-16
  EXPECT_EQ(r.text(), "a and b agree to 5.0 digits");
}

TEST(Agree, AThirdDecides) {
  const Reference r = agree({giving("a", 1), giving("wrong", 0), giving("c", 1 + 1e-12)}, one_step, {}, 1);
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(r.first.name, "a");
  EXPECT_EQ(r.second.name, "c");
  EXPECT_EQ(static_cast<double>(r.states(0, 0)), 1);
}

TEST(Agree, StopsAtTheFirstTwoThatSuffice) {
  const Reference r = agree({giving("a", 1), giving("b", 1 + 1e-9), giving("c", 1)}, one_step,
                            {.relative = 1e-8, .absolute = 1e-8}, 1);
  EXPECT_EQ(r.second.name, "b");
}

TEST(Agree, SaysWhyThereIsNone) {
  const Reference apart = agree({giving("a", 1), giving("b", 2)}, one_step, {}, 1);
  EXPECT_EQ(apart.status.outcome(), Outcome::not_converged);
  EXPECT_NE(apart.text().find("a and b, differ by"), std::string::npos) << apart.text();
  EXPECT_FALSE(apart.undetermined);
  const Reference alone = agree({giving("a", 1), giving("b", 1, false)}, one_step, {}, 1);
  EXPECT_FALSE(alone.status.ok());
  EXPECT_NE(alone.text().find("b (step_limit)"), std::string::npos) << alone.text();
}

// Reference: cn and sn dn in 50 digits at 16 times, in both directions of time. The oracle's doubles have
// rounding errors of 1e-16.
TEST(ReferenceOf, TheDuffingOscillatorByTaylorSeries) {
  for (const double end : {20.0, -20.0}) {
    const std::vector<double> times = times_to_check(0, end, 16);
    ASSERT_EQ(times.size(), 16U);
    EXPECT_EQ(times.back(), end);
    const Reference r = reference_of(problems::TextProblem("duffing"), {1, 0}, 0, times, {}, {});
    ASSERT_TRUE(r.status.ok()) << r.text();
    EXPECT_TRUE(r.first.extended && r.second.extended) << r.text();
    EXPECT_LT(r.difference.maxCoeff(), 1e-16);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Vector<double, 2> exact = oracle::duffing(times[k]);
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(static_cast<double>(r.states(i, static_cast<Eigen::Index>(k))), exact[i], 3e-16);
    }
  }
}

// At t = 0 the derivatives of the switch underflow in any precision, and the Taylor coefficients of the pulse
// show only that it is far. (log cosh(675) - log cosh(475))/100 = 2 to 400 digits; sqrt(pi)/2 to 1e-4343.
TEST(ReferenceOf, SeriesDoNotLeapAcrossWhatTheirCoefficientsDoNotShow) {
  const auto end_of = [](const std::string& equation, double end) {
    const WorkLimit effort{.largest_step = reference_step_limit(0, end, 1e9)};
    const Reference r = reference_of(ivp::testing::typed_problem(equation), ivp::State::Zero(1), 0,
                                     times_to_check(0, end, 16), {}, effort);
    EXPECT_TRUE(r.status.ok() && r.first.extended) << r.text();
    return static_cast<double>(r.states(0, 15));
  };
  EXPECT_NEAR(end_of("x' = tanh(100 (t - 4.75))", 11.5), 2, 1e-15);
  EXPECT_NEAR(end_of("x' = exp(-((t - 50)/0.5)^2)", 100), std::sqrt(std::acos(-1.0)) / 2, 1e-15);
}

// Agreement to the required absolute accuracy suffices, also where the state is nearly zero.
TEST(Agree, OnWhatIsNearlyZero) {
  EXPECT_TRUE(agree({giving("a", 1e-14), giving("b", 2e-14)}, one_step, {1e-9, 1e-9}, 1).status.ok());
}

// Published digits of the test set at 1e11 (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II,
// IV.10); a Taylor series cannot reach that time.
TEST(ReferenceOf, RobertsonByTwoMethods) {
  const Reference r = reference_of(problems::TextProblem("robertson"), {1, 0, 0}, 0, {1e11},
                                   {.relative = 1e-9, .absolute = 1e-18}, {});
  ASSERT_TRUE(r.status.ok()) << r.text();
  EXPECT_FALSE(r.first.extended) << r.text();
  const Vector<double, 3> exact = {0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050};
  for (int i = 0; i < 3; ++i) {
    const double error = std::abs(static_cast<double>(r.states(i, 0)) - exact[i]);
    // Both methods may have errors in the same direction, a few times as large as their difference; 16 digits
    // are published.
    EXPECT_LE(error, 10 * r.difference(i, 0) + 1e-15 * exact[i]) << i;
    EXPECT_LT(r.difference(i, 0), 1e-7 * exact[i]) << i;
  }
}

// Published digits of the test set for eps = 1e-6 at tau = 2 (E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II, IV.10): mu = 1000, t = mu tau, v = (dx/dtau)/mu. The interval contains two fast
// transitions.
TEST(ReferenceOf, StiffVanDerPolByTwoMethods) {
  const Reference r = reference_of(problems::TextProblem("van-der-pol", {{"mu", 1000}}), {2, 0}, 0,
                                   times_to_check(0, 2000, 8), {}, {});
  if (!r.status.ok()) GTEST_SKIP() << "this build has one stiff method alone: " << r.text();
  EXPECT_LT(r.uncertainty(), 1e-9) << r.text();
  EXPECT_NEAR(static_cast<double>(r.states(0, 7)), 1.706167732170483, 1e-9);
  EXPECT_NEAR(static_cast<double>(r.states(1, 7)), -0.8928097010247975e-3, 1e-12);
}

// Lyapunov exponent 0.906: an error of 1e-19 grows by exp(54) = 3e23 to t = 60.
TEST(ReferenceOf, ChaosBeyondExtendedPrecisionIsSaid) {
  const Reference r = reference_of(problems::TextProblem("lorenz"), {0, 1, 0}, 0, {60}, {}, {});
  EXPECT_FALSE(r.status.ok());
  EXPECT_TRUE(r.undetermined) << r.text();
  const Reference half = reference_of(problems::TextProblem("lorenz"), {0, 1, 0}, 0, {25}, {}, {});
  ASSERT_TRUE(half.status.ok()) << half.text();
  EXPECT_GT(half.uncertainty(), 1e-18);  // exp(22) = 4e9 times some 1e-20
}

TEST(ReferenceOf, NoWayToGoIsTheInitialState) {
  const Reference r =
      reference_of(problems::TextProblem("duffing"), {0.5, -2}, 3, times_to_check(3, 3, 64), {}, {});
  ASSERT_TRUE(r.status.ok()) << r.text();
  EXPECT_EQ(r.states.cast<double>().col(0), Eigen::Vector2d(0.5, -2));
}

TEST(LookAt, TimesAreFiniteHoweverFarTheEnd) {
  EXPECT_EQ(times_to_check(0, 1e308, 64).size(), 64U);
  for (const double t : times_to_check(-1e308, 1e308, 64)) EXPECT_TRUE(std::isfinite(t));
  EXPECT_EQ(times_to_check(1, std::nextafter(1, 2), 64).size(), 1U);
}

TEST(ReferenceOf, GivesUpWithinItsWork) {
  const Reference r = reference_of(problems::TextProblem("duffing", {{"natural_frequency", 1e12}}), {1, 0}, 0,
                                   {1}, {}, {.work = 0.01});
  EXPECT_FALSE(r.status.ok());
  EXPECT_NE(r.text().find("step_limit"), std::string::npos) << r.text();
}

}  // namespace
}  // namespace nlmech::comparison::reference_test
