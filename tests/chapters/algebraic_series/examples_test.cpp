/// Basis of the chapter's scenes: references, sections, rotation numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/sections.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::algebraic_series::examples_test {
namespace {

// 16 digits; double holds half a unit of that. oracle: algebraic_series_motions Lorenz as doubles ?(40),
// Duffing as doubles ?(100), oscillator as doubles *, bodies y of 4, bodies z of 1
TEST(References, AreThoseOfExtrapolation) {
  const auto lorenz = lorenz_example().reference(40);
  EXPECT_NEAR(static_cast<double>(lorenz[0]), 2.230074535271301, 1e-15);
  EXPECT_NEAR(static_cast<double>(lorenz[1]), 6.273839989510206, 2e-15);
  EXPECT_NEAR(static_cast<double>(lorenz[2]), 26.28210081730743, 8e-15);
  const auto duffing = forced_duffing_example().reference(100);
  EXPECT_NEAR(static_cast<double>(duffing[0]), 0.6948913708446650, 1e-15);
  EXPECT_NEAR(static_cast<double>(duffing[1]), 3.554260292257302, 1e-15);
  const auto oscillator = oscillator_example().reference(375 + std::numbers::pi);
  EXPECT_NEAR(static_cast<double>(oscillator[0]), -0.302938936512579, 2e-14);
  EXPECT_NEAR(static_cast<double>(oscillator[1]), -0.198146428424555, 2e-14);
  const auto bodies = bodies_example().reference(3000);
  EXPECT_NEAR(static_cast<double>(bodies[10]), 3.071464269641001, 1e-15);
  EXPECT_NEAR(static_cast<double>(bodies[2]), 0.1432282180354737, 1e-16);
}

// The same series in 35 digits at other times: the largest observed difference was 3.5e-14.
TEST(References, OfTheOscillatorIsGoodEnough) {
  using Digits35 = ExtendedReal<35>;
  const problems::TextProblem problem("oscillator");
  const problems::ReferenceTrajectory<Digits35, problems::TextProblem> exact(
      problem, problem.initial_state().cast<Digits35>(), problem.initial_time, problem.initial_time + 751);
  ASSERT_TRUE(exact.status().ok());
  for (int k = 1; k <= 375; ++k) {
    const double t = std::numbers::pi + 2 * k;
    const ivp::LongState miss = exact(Digits35(t)).cast<long double>() - oscillator_example().reference(t);
    EXPECT_LE(static_cast<double>(miss.cwiseAbs().maxCoeff()), 1e-13) << t;
  }
}

// A rotation by a constant angle from each section to the next: the average equals that angle.
TEST(RotationNumber, OfATurnIsItsAngle) {
  for (const double turns : {0.1, 8.0 / 31, 0.4999, 0.73}) {
    std::vector<ivp::State> circle;
    for (int k = 0; k < 400; ++k) {
      const double angle = -2 * std::numbers::pi * turns * k;
      circle.push_back({std::cos(angle), std::sin(angle)});
    }
    EXPECT_NEAR(rotation_number(circle), turns, 1e-13);
  }
}

// On an ellipse the angle advances unevenly; the weighted average has an error far below 1/400.
TEST(RotationNumber, OfAnEllipseConverges) {
  const double turns = std::sqrt(2.0) - 1;
  std::vector<ivp::State> ellipse;
  for (int k = 0; k < 400; ++k) {
    const double angle = -2 * std::numbers::pi * turns * k;
    ellipse.push_back({std::cos(angle), 0.5 * std::sin(angle)});
  }
  EXPECT_NEAR(rotation_number(ellipse), turns, 1e-10);
}

TEST(IslandRadius, LooksAtEvery31stSection) {
  std::vector<ivp::State> sections(100, ivp::State{7, 7});
  for (const std::size_t k : {0U, 31U, 62U, 93U}) sections[k] = {1, 0.01 * static_cast<double>(k)};
  EXPECT_DOUBLE_EQ(island_radius(sections, {1, 0}, 0, 40), 0.31);
  EXPECT_DOUBLE_EQ(island_radius(sections, {1, 0}, 32, 100), 0.93);
}

TEST(Departure, FindsTheFirstTime) {
  const Departure found{"success", {1, 2, 3}, {0.1, 2, 0.3}};
  EXPECT_EQ(found.first_above(1), 2);
  EXPECT_EQ(found.first_above(3), std::nullopt);
  EXPECT_EQ(found.greatest(1.5), 0.1);
  EXPECT_EQ(found.greatest(10), 2);
}

TEST(Samples, AreAtEqualTimesUpToTheEnd) {
  const auto& c = forced_duffing_example();
  const auto samples = sampled(c.system, c.x0, 0, 1, published_series(0.35, 20), 0.1);
  ASSERT_EQ(samples.size(), 11U);
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_NEAR(samples[i].t, 0.1 * static_cast<double>(i), 1e-15);
}

}  // namespace
}  // namespace nlmech::chapters::algebraic_series::examples_test
