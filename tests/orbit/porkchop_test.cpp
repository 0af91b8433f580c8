/// Grids of transfers: every cell against a single solution of Lambert's problem, bitwise equal results for
/// any number of threads, and Hohmann's transfer as the known minimum.
#include "nlmech/orbit/transfer/porkchop.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <stdexcept>

#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::porkchop_test {
namespace {

using namespace oracle;

/// Two inclined ellipses with mu = 1, over about a synodic period.
PorkchopProblem two_orbits() {
  PorkchopProblem p;
  p.from = {state_of(from_axis(1, 0.02, 0.1, 0.3, 1.8, 0), 1), 0.5};
  p.to = {state_of(from_axis(1.52, 0.09, 0.03, 0.9, 5, 1), 1), -2};
  p.departures = {0, 13, 41};
  p.arrivals = {5, 40, 53};
  p.most_revolutions = 3;
  return p;
}

void expect_same_bits(const PorkchopCell& a, const PorkchopCell& b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a.v_departure), std::bit_cast<std::uint64_t>(b.v_departure));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a.v_arrival), std::bit_cast<std::uint64_t>(b.v_arrival));
  EXPECT_EQ(a.revolutions, b.revolutions);
  EXPECT_EQ(a.long_way, b.long_way);
  EXPECT_EQ(a.branch, b.branch);
}

TEST(Porkchop, EveryCellIsTheBestOfAllArcs) {
  const PorkchopProblem p = two_orbits();
  const Porkchop grid = porkchop(p, 1);
  ASSERT_TRUE(grid.status.ok()) << grid.status.text();
  int revolving = 0, without = 0;
  for (std::size_t i = 0; i < 41; i += 3) {
    for (std::size_t j = 0; j < 53; ++j) {
      const double leave = p.departures.at(static_cast<int>(i)), arrive = p.arrivals.at(static_cast<int>(j));
      const PorkchopCell& cell = grid.at(i, j);
      if (arrive <= leave) {
        EXPECT_FALSE(cell.exists());
        ++without;
        continue;
      }
      const State from = propagate_kepler(p.from.state, leave - p.from.epoch, 1).state;
      const State to = propagate_kepler(p.to.state, arrive - p.to.epoch, 1).state;
      double least = HUGE_VAL, departure = 0;
      for (const SolvedArc& a : lambert_arcs({from.position, to.position, arrive - leave, 1}, 3)) {
        const double d = (a.solution.v1 - from.velocity).norm();
        const double sum = d + (a.solution.v2 - to.velocity).norm();
        if (sum < least) {
          least = sum;
          departure = d;
        }
      }
      // The same solver; only the rounding of the sums differs.
      EXPECT_NEAR(cell.v_departure + cell.v_arrival, least, 16 * eps * least);
      EXPECT_NEAR(cell.v_departure, departure, 16 * eps * (1 + departure));
      revolving += cell.revolutions > 0;
    }
  }
  EXPECT_GT(revolving, 100);
  EXPECT_GT(without, 10);
}

TEST(Porkchop, SameBitsForAnyNumberOfThreads) {
  const PorkchopProblem p = two_orbits();
  const Porkchop one = porkchop(p, 1);
  for (const int threads : {0, 2, 3, 16, 64}) {
    const Porkchop many = porkchop(p, threads);
    ASSERT_EQ(many.cells.size(), one.cells.size());
    for (std::size_t k = 0; k < one.cells.size(); ++k) expect_same_bits(one.cells[k], many.cells[k]);
    EXPECT_EQ(many.statistics.steps, one.statistics.steps);
  }
}

// Between circles of radius 1 and 2 the cheapest transfer at any time is Hohmann's half ellipse with 180
// degrees (W. Hohmann, 1925): v = (2/r - 2/(r_1 + r_2))^(1/2) at both ends. A grid that contains its times
// finds it, and no cell is cheaper.
TEST(Porkchop, HohmannsTransferIsTheMinimum) {
  const double half = pi * std::pow(1.5, 1.5);
  const double v1 = std::sqrt(2 / 1. - 2 / 3.), v2 = std::sqrt(2 / 2. - 2 / 3.);
  PorkchopProblem p;
  p.from.state = {{1, 0, 0}, {0, 1, 0}};
  p.to.state = {{2, 0, 0}, {0, std::sqrt(0.5), 0}};
  // Departs at the angle t, arrives half a revolution later where the other body is at t2/sqrt(8): t + pi =
  // t2/sqrt(8) + 2 pi k.
  const double rate = std::sqrt(0.125), leave = (half * rate - pi + 2 * pi) / (1 - rate);
  p.departures = {leave - 3, leave + 3, 121};
  p.arrivals = {leave + half - 3, leave + half + 3, 121};
  const Porkchop grid = porkchop(p);
  double least = HUGE_VAL;
  for (const PorkchopCell& cell : grid.cells) {
    if (cell.exists()) least = std::min(least, cell.v_departure + cell.v_arrival);
  }
  // Rounding of the times shifts the positions by some eps; the cost is stationary.
  EXPECT_NEAR(least, (v1 - 1) + (std::sqrt(0.5) - v2), 64 * eps);
}

// In one plane the positions of a cell can be exactly opposite; the transfer is then in the plane of the
// departure body.
TEST(Porkchop, OppositePositionsHaveATransfer) {
  PorkchopProblem p;
  p.from.state = {{1, 0, 0}, {0, 1, 0}};
  p.to.state = {{-2, 0, 0}, {0, -std::sqrt(0.5), 0}};
  p.departures = {0, 0, 1};
  p.arrivals = {8 * std::acos(0.0) * std::sqrt(8.), 8 * std::acos(0.0) * std::sqrt(8.),
                1};  // two of its periods
  p.to.epoch = p.arrivals.first;
  const Porkchop grid = porkchop(p);
  ASSERT_TRUE(grid.at(0, 0).exists());
  LambertProblem lambert{{1, 0, 0}, {-2, 0, 0}, p.arrivals.first, 1, Vector3<double>(0, 0, 1)};
  EXPECT_NEAR(grid.at(0, 0).v_departure, (solve_lambert(lambert).v1 - p.from.state.velocity).norm(),
              64 * eps);
  // For positions in the same direction there is no transfer.
  p.to.state = {{2, 0, 0}, {0, std::sqrt(0.5), 0}};
  EXPECT_FALSE(porkchop(p).at(0, 0).exists());
}

// Return to the same position after full revolutions: the period of one or two of them gives the speed, v^2 =
// 2/r - 1/a, in the direction of the departure body.
TEST(Porkchop, OnePositionHasATransferByWholeRevolutions) {
  PorkchopProblem p;
  p.from.state = {{1, 0, 0}, {0, 1, 0}};
  p.to.state = {{1, 0, 0}, {0, 1.2, 0}};
  p.departures = {0, 0, 1};
  p.arrivals = {5, 5, 1};
  p.to.epoch = 5;
  EXPECT_FALSE(porkchop(p).at(0, 0).exists());
  p.most_revolutions = 2;
  const double speed = std::sqrt(2 - std::pow(2 * pi / 5, 2. / 3));  // one revolution; two would cost more
  const PorkchopCell cell = porkchop(p).at(0, 0);
  EXPECT_EQ(cell.revolutions, 1);
  EXPECT_NEAR(cell.v_departure, 1 - speed, 16 * eps);
  EXPECT_NEAR(cell.v_arrival, 1.2 - speed, 16 * eps);
}

TEST(Porkchop, FailuresAreToldAndMistakesRefused) {
  PorkchopProblem p = two_orbits();
  p.arrivals = {1e60, 2e60, 3};
  EXPECT_EQ(porkchop(p).status.outcome(), Outcome::outside_validity);
  const auto refused = [](auto change, int threads = 0) {
    PorkchopProblem q = two_orbits();
    change(q);
    EXPECT_THROW((void)porkchop(q, threads), std::invalid_argument);
  };
  refused([](auto& q) { q.mu = 0; });
  refused([](auto& q) { q.from.state.position = {0, 0, 0}; });
  refused([](auto& q) { q.to.state.velocity = {0, NAN, 0}; });
  refused([](auto& q) { q.to.epoch = NAN; });
  refused([](auto& q) { q.departures = {1, 0, 3}; });
  refused([](auto& q) { q.arrivals = {0, HUGE_VAL, 3}; });
  refused([](auto& q) { q.departures.count = 0; });
  refused([](auto& q) { q.departures.count = q.arrivals.count = 50'000; });
  refused([](auto& q) { q.most_revolutions = -1; });
  refused([](auto&) {}, -1);
}

}  // namespace
}  // namespace nlmech::orbit::porkchop_test
