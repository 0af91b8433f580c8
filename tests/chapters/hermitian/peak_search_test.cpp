/// What the search for Laier's tables 4 and 5 is made of: its runs, readings, counts and surrogates.
#include "chapters/hermitian/peak_search.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/evidence/published.hpp"
#include "tests/places.hpp"

namespace nlmech::chapters::hermitian::peak_search_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A mass under a constant force: steps by hand.
ivp::System falling() {
  return ivp::System(problems::TextProblem(
      "driven-duffing",
      {{"damping", 0}, {"stiffness", 0}, {"hardening", 0}, {"force", -1}, {"frequency", 0}}));
}

void expect_state(const ivp::State& x, double position, double velocity, double within) {
  EXPECT_NEAR(x[0], position, within);
  EXPECT_NEAR(x[1], velocity, within);
}

// Two roads to the root of one step; the cubic is off by h^4 y''''/384, less than 1e-5.
TEST(PeakSearch, PlainRunIsTheLibrarys) {
  for (const Case& what : {duffing_case(), van_der_pol_case()}) {
    for (const ivp::HermitianPair& pair : peak_operators) {
      for (const double step : peak_steps) {
        const Turn turn = turn_of(what.system, {.x0 = what.x0}, pair, step, what.sign);
        const ivp::Hermitian method{.operators = pair, .step = step};
        const Peak peak = first_peak(what, method, 20);
        ASSERT_TRUE(peak.status.ok());
        EXPECT_NEAR(peak_of(turn, Reading::furthest, what.sign), peak.on_grid, 1e-11);
        EXPECT_NEAR(peak_of(turn, Reading::cubic, what.sign), peak.x, 1e-5);
        const double t1 = std::ceil(peak.t / step) * step;
        const auto end = ivp::integrate(what.system, what.x0, 0, t1, method).x;
        expect_state(turn.x[2], end[0], end[1], 1e-10);
      }
    }
  }
}

// oracle: hermitian_peaks Duffing Laier h = 0.2 with the load a step ahead
TEST(PeakSearch, LoadAheadIsThatOfTheOracle) {
  const Case what = duffing_case();
  const Turn turn = turn_of(what.system, {.x0 = what.x0, .ahead = 1}, ivp::laier, 0.2, 1);
  EXPECT_NEAR(peak_of(turn, Reading::cubic, 1), 0.5051, 1e-4);
}

// Average acceleration, h = 0.5, force -1: v falls by h a step and y by h^2/2 beside h v; without a first
// acceleration by half of that in the first step.
TEST(PeakSearch, FirstStepByHand) {
  const Program plain = {.x0 = {0, 0.3}};
  const Turn usual = turn_of(falling(), plain, ivp::newmark_pair, 0.5, 1);
  EXPECT_TRUE(usual.x[0].hasNaN());  // turned in the first step
  expect_state(usual.x[1], 0, 0.3, 0);
  expect_state(usual.x[2], 0.15 - 0.125, -0.2, 1e-15);
  expect_state(usual.x[3], 0.025 - 0.1 - 0.125, -0.7, 1e-15);
  Program odd = plain;
  odd.no_first = true;
  const Turn late = turn_of(falling(), odd, ivp::newmark_pair, 0.5, 1);
  expect_state(late.x[0], 0, 0.3, 0);
  expect_state(late.x[1], 0.15 - 0.0625, 0.05, 1e-15);
  expect_state(late.x[2], 0.0875 + 0.025 - 0.125, -0.45, 1e-15);
}

// On a linear problem one update is the root; under a load that stands still the old one is the new one.
TEST(PeakSearch, OddIterationsThatChangeNothing) {
  const problems::TextProblem linear("laier-duffing", {{"hardening", 0}}),
      still("laier-duffing", {{"frequency", 0}});
  const ivp::State rest{0, 0};
  for (const ivp::HermitianPair& pair : peak_operators) {
    const ivp::System a(linear), b(still);
    const Turn one = turn_of(a, {.x0 = rest, .updates = 1}, pair, 0.2, 1);
    const Turn all = turn_of(a, {.x0 = rest}, pair, 0.2, 1);
    const Turn old_load = turn_of(b, {.x0 = rest, .old_load = true}, pair, 0.2, 1);
    const Turn new_load = turn_of(b, {.x0 = rest}, pair, 0.2, 1);
    for (std::size_t i = 0; i < 4; ++i) {
      expect_state(one.x.at(i), all.x.at(i)[0], all.x.at(i)[1], 1e-12);
      expect_state(old_load.x.at(i), new_load.x.at(i)[0], new_load.x.at(i)[1], 1e-12);
    }
  }
}

// The load does change what follows, and so does an iteration cut short on the cubic spring.
TEST(PeakSearch, OddIterationsThatChangeTheRun) {
  const Case what = duffing_case();
  const auto peak = [&](int updates, bool old_load) {
    const Program program = {.x0 = what.x0, .updates = updates, .old_load = old_load};
    return peak_of(turn_of(what.system, program, ivp::laier, 0.2, 1), Reading::cubic, 1);
  };
  EXPECT_GT(std::abs(peak(1, false) - peak(50, false)), 1e-4);
  EXPECT_LT(std::abs(peak(2, false) - peak(50, false)), 1e-5);
  EXPECT_GT(std::abs(peak(1, true) - peak(1, false)), 1e-3);
}

// y = 1 - (t - 0.3)^2 at t = -1, 0, 1, 2, upright and upside down.
TEST(PeakSearch, ReadingsOfAParabola) {
  for (const double sign : {1.0, -1.0}) {
    Turn turn{{}, 1};
    for (int i = 0; i < 4; ++i) {
      const double t = i - 1 - 0.3;
      turn.x.at(static_cast<std::size_t>(i)) = {sign * (1 - t * t), -2 * sign * t};
    }
    EXPECT_NEAR(peak_of(turn, Reading::furthest, sign), sign * 0.91, 1e-15);
    EXPECT_NEAR(peak_of(turn, Reading::before, sign), sign * 0.91, 1e-15);
    EXPECT_NEAR(peak_of(turn, Reading::after, sign), sign * 0.51, 1e-15);
    EXPECT_NEAR(peak_of(turn, Reading::parabola, sign), sign, 1e-15);
    EXPECT_NEAR(peak_of(turn, Reading::cubic, sign), sign, 1e-15);
  }
}

TEST(PeakSearch, CombinationsAreDistinctAndCounted) {
  std::set<std::pair<double, double>> starts;
  for (const ivp::State& x : searched_starts()) starts.emplace(x[0], x[1]);
  EXPECT_EQ(starts.size(), 45U);  // rest, and 11 sizes of two signs for position or velocity
  EXPECT_EQ(searched_starts().size(), 45U);
  EXPECT_EQ(van_der_pol_combinations().size(), 44U * 2 * 3 * 5);
  std::set<std::string> readings_named;
  for (const Reading reading : readings) readings_named.emplace(to_string(reading));
  EXPECT_EQ(readings_named.size(), 5U);
}

TEST(PeakSearch, FitsOfATinyExample) {
  const Nine printed = {0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3};
  Nine first = printed, second = printed, none;
  none.fill(nan);
  for (const std::size_t i : {0U, 3U, 6U}) first.at(i) += 5e-4;  // Laier's column by 5 units
  second[1] -= 3e-4;                                             // Argyris' by 3
  second[8] += 1e-4;                                             // on the edge: met
  EXPECT_EQ(rows_met(printed, printed), 9);
  EXPECT_EQ(rows_met(first, printed), 6);
  EXPECT_EQ(rows_met(second, printed), 8);
  EXPECT_EQ(rows_met(none, printed), 0);
  const std::vector<Nine> all = {none, first, second};
  const Fit fit = best_fit(all, printed);
  EXPECT_NEAR(fit.all.miss, 3, 1e-6);
  EXPECT_EQ(fit.all.number, 2U);
  EXPECT_EQ(fit.most, 8);
  EXPECT_EQ(fit.columns[0].number, 2U);  // each of the two spoils a column that is right in the other
  EXPECT_EQ(fit.columns[1].number, 1U);
  EXPECT_EQ(fit.columns[2].number, 1U);
  EXPECT_NEAR(fit.by_columns(), 0, 1e-6);
  EXPECT_EQ(best_fit(std::vector<Nine>{none}, printed).all.miss, HUGE_VAL);
}

// Columns keep their shape and their peak, or not even that; the same seed gives the same tables.
TEST(PeakSearch, SurrogatesAreLikeThePrintedTable) {
  const double exact = table_4().exact;
  const Nine printed = table_4().printed();
  const auto tables = surrogates(printed, exact, Surrogates::same_peak, 50);
  ASSERT_EQ(tables.size(), 50U);
  EXPECT_EQ(tables, surrogates(printed, exact, Surrogates::same_peak, 50));
  EXPECT_NE(tables, surrogates(printed, exact, Surrogates::same_peak, 50, 2));
  EXPECT_EQ(std::set<Nine>(tables.begin(), tables.end()).size(), 50U);
  for (const Nine& table : tables) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double scale = (table.at(k) - exact) / (printed.at(k) - exact);
      EXPECT_GT(scale, 0.49);
      EXPECT_LT(scale, 1.51);
      for (const std::size_t i : {3 + k, 6 + k}) {
        EXPECT_NEAR(table.at(i), exact + scale * (printed.at(i) - exact), 1e-4);
        EXPECT_NEAR(std::round(table.at(i) * 1e4), table.at(i) * 1e4, 1e-9);
      }
    }
  }
  double least = 1, most = 0;
  for (const Nine& table : surrogates(printed, exact, Surrogates::any_peak, 200)) {
    least = std::min(least, table[6]);
    most = std::max(most, table[6]);
  }
  EXPECT_LT(least, 0.3);  // 0.53 by 0.5 to 1.5
  EXPECT_GT(most, 0.75);
}

TEST(PeakSearch, ChanceCountsThePrintedTable) {
  EXPECT_EQ(chance_of(std::vector<double>{1, 2, 3}, 2), 0.75);
  EXPECT_EQ(chance_of(std::vector<double>{1, 2, 3}, 0.5), 0.25);
  EXPECT_EQ(chance_of(std::vector<double>{1, 2, 3}, 4), 1);
}

/// The first peak of (11) from rest: Runge and Kutta's steps of 1/2000 of the way, to where the velocity is
/// 0.
double exact_peak() {
  using State = std::array<double, 2>;
  const auto slope = [](double t, const State& x) {
    return State{x[1], 0.5 * std::cos(0.5 * t) - 0.4 * x[1] - x[0] - 0.5 * x[0] * x[0] * x[0]};
  };
  const auto at = [&](double end_time) {
    State x = {0, 0};
    const double h = end_time / 2000;
    for (int i = 0; i < 2000; ++i) {
      const auto moved = [&](const State& k, double by) { return State{x[0] + by * k[0], x[1] + by * k[1]}; };
      const double t = i * h;
      const State k1 = slope(t, x), k2 = slope(t + h / 2, moved(k1, h / 2)),
                  k3 = slope(t + h / 2, moved(k2, h / 2)), k4 = slope(t + h, moved(k3, h));
      for (const std::size_t c : {0U, 1U}) x[c] += h / 6 * (k1[c] + 2 * k2[c] + 2 * k3[c] + k4[c]);
    }
    return x;
  };
  double time = 2.45;
  for (int i = 0; i < 5; ++i) {
    const State x = at(time);
    time -= x[1] / slope(time, x)[1];
  }
  return at(time)[0];
}

// The paper names no start of Table 4. From rest all three methods agree with the motion: order 4, or 2, at a
// step of 0.2.
TEST(PeakSearch, PeakFromRestIsThatOfTheMotion) {
  const double exact = exact_peak();
  EXPECT_NEAR(exact, 0.53826530480162931, 1e-12);  // oracle: transversal_motions Laier's Duffing peak
  for (const ivp::HermitianPair& pair : peak_operators) {
    const double tolerance = pair.name == ivp::newmark_pair.name ? 2e-3 : 2e-6;
    for (const double step : peak_steps) {
      const Peak peak = first_peak(duffing_case(), {.operators = pair, .step = step}, 20);
      ASSERT_TRUE(peak.status.ok());
      EXPECT_NEAR(peak.x, exact, tolerance);
    }
  }
}

// What the list of printed numbers says of the searches is what they are.
TEST(PeakSearch, IsWhatThePublishedRowsSay) {
  const auto count = [](const std::vector<Combination>& all, const Nine& printed) {
    int most = 0;
    for (const Combination& c : all) most = std::max(most, rows_met(c.peaks, printed));
    return std::pair{static_cast<int>(all.size()), std::to_string(most) + " of 9"};
  };
  const auto duffing = count(duffing_combinations(), table_4().printed());
  const auto van_der_pol = count(van_der_pol_combinations(), table_5().printed());
  int rows = 0;
  for (const scene::PublishedValue& value : scene::read_published(NLMECH_SOURCE_DIR)) {
    if (value.source != "laier") continue;
    const auto& [tried, explains] = value.place == "table-4" ? duffing : van_der_pol;
    EXPECT_EQ(value.tried, tried) << value.name();
    EXPECT_EQ(value.explains, explains) << value.name();
    ++rows;
  }
  EXPECT_EQ(rows, 18);
}

}  // namespace
}  // namespace nlmech::chapters::hermitian::peak_search_test
