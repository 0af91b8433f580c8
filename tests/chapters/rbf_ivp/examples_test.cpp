/// The three examples: their solutions against independent numbers and equations.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/examples/histories.hpp"
#include "chapters/rbf_ivp/examples/runs.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"

namespace nlmech::chapters::rbf_ivp::examples_test {
namespace {

constexpr double stated = 2e-16;  // accuracy of the reference that Case states

/// Components of the reference against 25 digits of a 60-digit Taylor solution.
void expect_reference(const Case& c, double t, const ivp::LongState& digits) {
  const ivp::LongState error = c.reference(t) - digits;
  for (Eigen::Index i = 0; i < error.size(); ++i)
    EXPECT_LE(static_cast<double>(std::abs(error[i])), stated)
        << c.name << ", component " << i << " at " << t;
}

TEST(Examples, ReferencesAtKnownTimes) {
  expect_reference(free_duffing_case(), 500, {0.6356014706573872618142369L, 1.0071778004510543827621357L});
  expect_reference(impact_case(), 1, {0.2345637237526737363950751L, 0.4279799258511257045665702L});
  expect_reference(impact_case(), 500, {-0.4043016339378515331621024L, -0.2507612394654356943494855L});
  // With the decimals of Table 4.5 rounded to double.
  Vector<Extended, 6> chain;
  chain << 0.1621748860002473897017669L, 0.3465729515799769464131827L, 0.7582358883258392394078843L,
      -0.08899514991998155626594779L, -0.1639274778294406028186595L, -0.2083204784161271014782796L;
  expect_reference(three_mass_case(), 200, chain);
}

// The elliptic solution against an independent Taylor series, also at quarters of the period: there many
// formulas compute dn as a quotient of vanishing numbers, including Boost's, which has an error of 5e-4.
TEST(Examples, EllipticSolutionIsTheTaylorSeries) {
  const problems::ReferenceTrajectory<Extended, problems::TextProblem> series(
      problems::TextProblem("duffing"), {1, 0}, 0, 500);
  const Case& c = free_duffing_case();
  const double P = duffing_period();
  for (int i = 0; i < 4000; ++i) {
    const double t = i < 400 ? i * P / 4 : 0.125 * i;
    const Vector<Extended, 2> error = c.reference(t) - series(t);
    EXPECT_LE(static_cast<double>(error.cwiseAbs().maxCoeff()), stated) << "t = " << t;
  }
}

TEST(Examples, PeriodAndAmplitudes) {
  EXPECT_NEAR(duffing_period(), 4.7680220291024608063, 9e-16);  // one unit in the last place
  EXPECT_EQ(free_duffing_case().amplitude[0], 1);
  EXPECT_NEAR(free_duffing_case().amplitude[1], std::sqrt(1.5), 3e-16);  // from the energy: v^2 = 1 + 1/2
  // 60 digits; a handful of roundings
  EXPECT_NEAR(impact_case().amplitude[0], 0.46508746209705230229, 3e-16);
  EXPECT_NEAR(2 * impact_case().half_period, 5.8305608540698689919, 4e-15);
}

// Trace and determinant of M^-1 K by hand.
TEST(Examples, ChainFrequencies) {
  const Eigen::Vector3d squares = chain_frequencies().cwiseAbs2();
  EXPECT_NEAR(squares.sum(), 4, 1e-14);
  EXPECT_NEAR(squares.prod(), 1, 1e-14);
  EXPECT_LT(squares[0], squares[1]);
}

TEST(Measures, RootMeanSquare) {
  EXPECT_EQ(root_mean_square(std::array{3.0, -4.0, 0.0, 5.0}), std::sqrt(50.0 / 4));
  EXPECT_THROW(static_cast<void>(root_mean_square({})), std::invalid_argument);
}

TEST(Measures, StateErrorDividesByAmplitudes) {
  const Case& c = free_duffing_case();
  EXPECT_NEAR(normalised_state_error(c, {3e-3, 4e-3 * std::sqrt(1.5)}), 5e-3, 1e-17);
}

/// A record of errors 1, 2, 3, 4 at the times 1, 2, 3, 4, every second one at the end of a step.
Record staircase() {
  Record record;
  for (int k = 1; k <= 4; ++k)
    record.values.push_back({double(k), k % 2 == 0, {0, 0}, {double(k), 10.0 * k}});
  return record;
}

TEST(Measures, RmsErrorChoosesPointsAndTime) {
  const Record record = staircase();
  EXPECT_DOUBLE_EQ(rms_error(record, 0, Points::ends), std::sqrt(20.0 / 3));  // with the start
  EXPECT_DOUBLE_EQ(rms_error(record, 0, Points::all), std::sqrt(30.0 / 4));
  EXPECT_DOUBLE_EQ(rms_error(record, 1, Points::all, 3), 10 * std::sqrt(14.0 / 3));
  EXPECT_DOUBLE_EQ(rms_error(record, 0, Points::ends, 2 * (1 - 1e-15)), std::sqrt(4.0 / 2));
}

// Data that a run records: ends and nodes in the order of time, dense output in the window, errors at
// rounding level for a method that is exact.
TEST(Records, HoldWhatTheMethodGave) {
  const double P = duffing_period();
  const auto kept = record(free_duffing_case(), 2 * P, throughout(ivp::Mcpi{.step = P / 2, .order = 40}), P);
  ASSERT_EQ(kept.values.size(), 160U);
  ASSERT_EQ(kept.window.size(), 401U);
  EXPECT_EQ(kept.statistics.steps, 4);
  for (std::size_t i = 0; i < kept.values.size(); ++i) {
    EXPECT_EQ(kept.values[i].end, i % 40 == 39);
    EXPECT_TRUE(i == 0 || kept.values[i].t > kept.values[i - 1].t);
    EXPECT_LT(kept.values[i].error.norm(), 1e-12);  // Picard's tolerance 1e-13 over four steps
  }
  for (const auto& drawn : kept.window)
    EXPECT_LT(error_at(free_duffing_case(), drawn.t, drawn.x).norm(), 1e-12);
}

TEST(Records, FailureCarriesTheSentenceOfTheMethod) {
  const auto hopeless = throughout(ivp::Mcpi{.step = 3 * duffing_period(), .order = 20});
  EXPECT_THROW(static_cast<void>(record(free_duffing_case(), 500, hopeless)), Failure);
}

TEST(Thinning, KeepsTheGreatestOfEachPart) {
  std::vector<TimeError> errors;
  for (int i = 1; i <= 1000; ++i) errors.push_back({i / 100.0, i % 100 == 37 ? 5.0 : 1.0});
  const std::vector<TimeError> thin = greatest_by_bin(errors, 0, 10, 10);
  ASSERT_EQ(thin.size(), 10U);
  for (const TimeError& p : thin) {
    EXPECT_EQ(p.error, 5);
    EXPECT_NEAR(std::fmod(p.t, 1), 0.37, 1e-12);
  }
}

TEST(Growth, IsThePowerOfTime) {
  std::vector<TimeError> errors;
  for (int i = 1; i <= 500; ++i) errors.push_back({double(i), i < 50 ? 1e3 : 1e-9 * std::pow(i, 1.7)});
  EXPECT_NEAR(growth_exponent(errors), 1.7, 1e-12);
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::examples_test
