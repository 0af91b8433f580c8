/// Many trajectories at once: results bitwise equal to integrate(), for any number of threads and, for
/// series, any content of the other SIMD lanes.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::integrate_all_test {
namespace {

/// A driven, damped pendulum; its force jumps at t = @p jump if that is positive.
System pendulum(double jump = 0) {
  const std::string more = jump > 0 ? fmt::format(" + max(sign({} - t), 0)", jump) : "";
  return testing::typed("x'' = cos(2 t) - sin(x) - 0.1 x'" + more);
}

/// x'' = -x.
struct Circle {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& f) const {
    f[0] = x[1];
    f[1] = -x[0];
  }
};

void expect_same(const Solution& a, const Solution& b) {
  EXPECT_EQ(a.t, b.t);
  ASSERT_EQ(a.x.size(), b.x.size());
  for (Eigen::Index i = 0; i < a.x.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.x[i]), std::bit_cast<std::uint64_t>(b.x[i]));
  EXPECT_EQ(a.status.text(), b.status.text());
  EXPECT_EQ(a.status.outcome(), b.status.outcome());
  EXPECT_EQ(a.statistics.steps, b.statistics.steps);
  EXPECT_EQ(a.statistics.rejected, b.statistics.rejected);
  EXPECT_EQ(a.statistics.right_hand_sides, b.statistics.right_hand_sides);
}

/// Compares with single integrations, by one thread and by three. @returns the single integrations
template <class Method>
std::vector<Solution> expect_bits_by_threads(const std::vector<Start>& starts, const Method& method) {
  std::vector<Solution> alone;
  for (const Start& start : starts) alone.push_back(detail::alone(start, method));
  for (const int threads : {1, 3}) {
    const auto together = integrate_all(std::span<const Start>(starts), method, threads);
    EXPECT_EQ(together.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      expect_same(together[i], alone[i]);
      EXPECT_EQ(together[i].statistics.seconds, 0);
    }
  }
  return alone;
}

/// Compares also with AVX2 registers, where the processor has them and steps are adaptive.
void expect_bits_of_one(const std::vector<Start>& starts, const Series& method) {
  const auto alone = expect_bits_by_threads(starts, method);
  const std::span<const Start> all(starts);
  if (method.step > 0 || !available(InstructionSet::avx2)) return;
  const auto narrow = integrate_all(all, method, 1, InstructionSet::avx2);
  for (std::size_t i = 0; i < alone.size(); ++i) expect_same(narrow[i], alone[i]);
}

Series with(double tolerance, int order = 0) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance, .order = order};
}

// Any states, intervals and parameters; some members have other equations, which cannot share SIMD registers
// with the rest.
RC_GTEST_PROP(SeriesEnsemble, HasTheBitsOfOne, ()) {
  const auto number = [](double low, double high) {
    return low + (high - low) * (*rc::gen::inRange(0, 1000001)) * 1e-6;
  };
  const std::size_t count = *rc::gen::inRange<std::size_t>(0, 60);
  std::vector<System> systems;
  systems.emplace_back(problems::TextProblem("lorenz"));
  for (int k = 0; k < 5; ++k) {
    const double sigma = *rc::gen::element(1.0, 9.5, 10.25);  // sigma = 1 saves one operation
    systems.emplace_back(problems::TextProblem("lorenz", {{"sigma", sigma}, {"r", number(0.5, 60)}}));
  }
  std::vector<Start> starts;
  for (std::size_t i = 0; i < count; ++i) {
    const double t0 = number(-1, 1);
    starts.push_back({&systems[*rc::gen::inRange<std::size_t>(0, systems.size())],
                      {number(-20, 20), number(-20, 20), number(-5, 40)},
                      t0,
                      t0 + number(-0.3, 2),
                      {},
                      {.steps = 200}});
  }
  expect_bits_of_one(starts, with(std::pow(10, -number(2, 13)), *rc::gen::element(0, 2, 3, 11, 30)));
}

// Twelve kinds of equations in turn, more than the number of kinds that may wait for a full register: bitwise
// equal to single integrations, also for baseline registers.
TEST(SeriesEnsemble, ManyKinds) {
  std::vector<System> systems;
  for (int power = 1; power <= 12; ++power)
    systems.push_back(testing::typed(fmt::format("x' = -x^{}", power)));
  std::vector<Start> starts;
  for (int i = 0; i < 100; ++i)
    starts.push_back({&systems[static_cast<std::size_t>(i) % 12], State{0.3 + 0.01 * i}, 0, 1.0 + i, {}, {}});
  expect_bits_of_one(starts, with(1e-10));
  const std::span<const Start> all(starts);
  const auto together = integrate_all(all, with(1e-10), 2, InstructionSet::baseline);
  for (std::size_t i = 0; i < starts.size(); i += 7)
    expect_same(integrate_all(all.subspan(i, 1), with(1e-10), 1, InstructionSet::baseline)[0], together[i]);
}

TEST(SeriesEnsemble, EquationsWithTheTime) {
  const System smooth = pendulum(), jumping = pendulum(1.5);
  std::vector<Start> starts;
  for (int i = 0; i < 40; ++i) {
    const System* system = i % 3 == 0 ? &jumping : &smooth;
    starts.push_back({system, State{0.1 * i, 1}, 0.1 * i, 3 + 0.2 * (i % 7), {}, {}});
  }
  starts[5].t1 = starts[5].t0;
  starts[6].t1 = -2;
  expect_bits_of_one(starts, with(1e-10));
  Series bounded = with(1e-6);
  bounded.largest_step = 0.05;
  expect_bits_of_one(starts, bounded);
  expect_bits_of_one(starts, {.order = 8, .step = 0.1});  // fixed steps: parallel by threads only
}

// A failure ends as in a single integration, with the same message, and does not affect the other members.
TEST(SeriesEnsemble, FailuresAreTheirOwn) {
  // Poles at t = 1/x(0); gaps in the series, so that the first step is tested, rejected and halved; no finite
  // slope at x = 0, or coefficients that overflow from x = 1e-300.
  const System pole = testing::typed("x' = x^2"), gap = testing::typed("x' = t^20"),
               singular = testing::typed("x' = 1/x");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Start> poles, gaps, singulars;
  for (int i = 0; i < 37; ++i) {
    poles.push_back({&pole, State{i % 5 == 2 ? 0.9 : 2 - 0.1 * i}, 0, i % 4 == 0 ? 3. : 1., {}, {}});
    gaps.push_back({&gap, State{0.01 * i}, i % 3 == 0 ? 0 : 0.01 * i, 2, {}, {}});
    singulars.push_back({&singular, State{i % 4 == 1 ? 0 : std::pow(10, -9 * i)}, 0, 1, {}, {}});
  }
  poles[3].x0[0] = nan;
  poles[4].limits.steps = 3;
  poles[5].limits.seconds = 0;
  gaps[7].limits.steps = 2;
  expect_bits_of_one(poles, with(1e-12));
  expect_bits_of_one(gaps, with(1e-9, 10));
  expect_bits_of_one(singulars, with(1e-9));
  const auto ends = integrate_all(std::span<const Start>(poles), with(1e-12));
  EXPECT_EQ(ends[0].status.outcome(), Outcome::step_underflow);
  EXPECT_EQ(ends[3].status.outcome(), Outcome::non_finite);
  EXPECT_EQ(ends[4].status.outcome(), Outcome::step_limit);
  EXPECT_EQ(ends[5].status.outcome(), Outcome::time_limit);
  EXPECT_TRUE(ends[7].status.ok());
  EXPECT_GT(integrate_all(std::span<const Start>(gaps), with(1e-9, 10))[0].statistics.rejected, 0);
}

// Observers receive the steps and the dense output of their own trajectory, and end it alone.
TEST(SeriesEnsemble, ObserversSeeTheirOwn) {
  const System system(problems::TextProblem("lorenz"));
  constexpr std::size_t count = 45;
  std::vector<std::vector<double>> seen(count), alone(count);
  const auto starts = [&](std::vector<std::vector<double>>& to) {
    std::vector<Start> all;
    for (std::size_t i = 0; i < count; ++i) {
      const Observer look = [&to, i](const Step& step) {
        const State x = step.at(step.t0 + 0.3 * (step.t1 - step.t0));
        to[i].insert(to[i].end(), {step.t0, step.t1, step.times[0], step.states(2, 0), step.x0[0], x[0], x[2],
                                   static_cast<double>(step.index)});
        return i != 17 || step.t1 < 0.7;
      };
      const double k = static_cast<double>(i);
      all.push_back({&system, State{0.1 * k, 1, 20 - k}, 0, 1 + 0.1 * k, look, {}});
    }
    return all;
  };
  const auto from = starts(seen);
  const auto ends = integrate_all(std::span<const Start>(from), with(1e-9), 2);
  for (const Start& start : starts(alone)) (void)detail::alone(start, with(1e-9));
  EXPECT_EQ(seen, alone);
  EXPECT_EQ(ends[17].status.outcome(), Outcome::interrupted);
  EXPECT_TRUE(ends[18].status.ok());
}

// Systems of two and three components together; bounds and invariants of a problem are checked.
TEST(SeriesEnsemble, OtherSizes) {
  const System lorenz(problems::TextProblem("lorenz")), swinging = pendulum();
  std::vector<Start> starts;
  for (int i = 0; i < 25; ++i) {
    if (i % 2 == 0) {
      starts.push_back({&lorenz, State{1, 1. * i, 20}, 0, 1, {}, {}});
    } else {
      starts.push_back({&swinging, State{1, 0.1 * i}, 0, 5, {}, {}});
    }
  }
  expect_bits_of_one(starts, with(1e-8));
  const System reactions(problems::TextProblem("robertson"));
  std::vector<Start> cells(5, {&reactions, State{1, 0, 0}, 0, 0.01, {}, {}});
  expect_bits_of_one(cells, with(1e-3));
}

TEST(SeriesEnsemble, OneSystemAndManyStates) {
  const System system(problems::TextProblem("lorenz"));
  std::vector<State> states;
  for (int i = 0; i < 33; ++i) states.push_back({1, 0.1 * i, 20});
  const std::span<const State> all(states);
  const auto ends = integrate_all(system, all, 0, 3, with(1e-9), 2);
  for (std::size_t i = 0; i < states.size(); ++i)
    expect_same(ends[i], detail::alone({&system, states[i], 0, 3, {}, {}}, with(1e-9)));
}

// Runs too short to repay machine code count together, of typed and of compiled equations: the code of the
// next run is there, or was found to be impossible, and is not made again.
TEST(SeriesCode, IsSharedByShortRuns) {
  if (!available(InstructionSet::avx2)) GTEST_SKIP() << "machine code needs AVX2";
  const System typed = pendulum(), copy = typed, compiled{Circle{}};
  const Series method = with(1e-9);
  for (const System* system : {&typed, &copy, &compiled}) {
    std::int64_t steps = 0;
    for (int run = 0; steps < TapeExpansion::repays_after && run < 100; ++run) {
      const Solution s = integrate(*system, {1, 0.01 * run}, 0, 10, method);
      ASSERT_LT(s.statistics.steps, TapeExpansion::repays_after / 2);
      steps += s.statistics.steps;
    }
    bool is_made_now = false;
    const auto code = system->series_codes().of(system->record(0), series_order(1e-9), 1, 1);
    static_cast<void>(
        (*code)([&] { return is_made_now = true, std::shared_ptr<machine_code::Coefficients>(); }));
    EXPECT_FALSE(is_made_now);
  }
  const System switching = testing::typed("x' = 1 - 2 sign(x)");
  EXPECT_EQ(&switching.series_codes(), &switching.in_mode({1}).series_codes());
}

TEST(SeriesEnsemble, RefusesWhatOneRefuses) {
  const System system = testing::typed("x' = x^2");
  const auto all = [](const Start& start, const Series& method) {
    return integrate_all(std::span<const Start>(&start, 1), method);
  };
  EXPECT_THROW((void)all({&system, State{1}, 0, 0.5, {}, {}}, with(-1)), std::invalid_argument);
  EXPECT_THROW((void)all({&system, State{1}, 0, std::nan(""), {}, {}}, with(1e-9)), std::invalid_argument);
  EXPECT_TRUE(integrate_all(std::span<const Start>(), with(1e-9)).empty());
}

// Other methods: fixed and adaptive steps, both directions of time, and a discontinuity.
TEST(IntegrateAll, HasTheBitsOfOne) {
  const System lorenz(problems::TextProblem("lorenz")), jumping = pendulum(1);
  std::vector<Start> chaos, jumps;
  for (int i = 0; i < 29; ++i) {
    chaos.push_back({&lorenz, State{std::sin(1.7 * i), 1, 0.1 * i}, 0.5, i % 2 == 0 ? 1.237 : 0.1, {}, {}});
    jumps.push_back({&jumping, State{std::sin(1.7 * i), 1}, 0, 2, {}, {}});
  }
  const Ode45 chosen{.relative_tolerance = 1e-6, .absolute_tolerance = 1e-6};
  expect_bits_by_threads(chaos, Rk4{.step = 0.01});
  expect_bits_by_threads(jumps, Rk4{.step = 0.03});
  expect_bits_by_threads(chaos, chosen);
  expect_bits_by_threads(jumps, chosen);
  expect_bits_by_threads({}, chosen);
}

// A member that overflows or starts at NaN fails as in a single integration; the others continue.
TEST(IntegrateAll, FailuresAreTheirOwn) {
  const System system = testing::typed("x' = x^2");
  std::vector<State> from;
  for (int i = 0; i < 9; ++i) from.push_back({0.1 * i});
  from[1][0] = 50;
  from[4][0] = std::numeric_limits<double>::quiet_NaN();
  const std::span<const State> states(from);
  const auto ends = integrate_all(system, states, 0, 1, Rk4{.step = 0.01});
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(ends[i].status.outcome(), i == 1 || i == 4 ? Outcome::non_finite : Outcome::success) << i;
    if (i == 1 || i == 4) continue;
    // Order 4: 0.01^4 times derivatives near 1/(1 - 0.8)^5.
    EXPECT_NEAR(ends[i].x[0], from[i][0] / (1 - from[i][0]), 1e-5);
  }
  EXPECT_EQ(integrate_all(system, states, 0, 1, Rk4{.step = 0.01}, 1, {.steps = 5})[0].status.outcome(),
            Outcome::step_limit);
  EXPECT_THROW((void)integrate_all(system, states, 0, 1, Rk4{.step = 0}), std::invalid_argument);
  EXPECT_THROW((void)integrate_all(system, states, 0, std::nan(""), Rk4{}), std::invalid_argument);
  EXPECT_EQ(integrate_all(system, states, 1, 1, Rk4{})[2].x, from[2]);
}

}  // namespace
}  // namespace nlmech::ivp::integrate_all_test
