/// Many initial states at once: the bits of integrate(), whatever stands beside, in registers and by threads.
#include "nlmech/ivp/ensemble/integrate_all.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/problems/lorenz.hpp"

namespace nlmech::ivp::integrate_all_test {
namespace {

/// x'' + 0.1 x' + sin(x) = cos(t), with a rate that jumps at t = 1 if it is to.
struct Pendulum {
  static constexpr int dimension = 2;
  double jump = 0;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    using std::cos;
    using std::sin;
    dxdt[0] = x[1];
    dxdt[1] = cos(t) - 0.1 * x[1] - sin(x[0]);
  }
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const {
    if (jump == 0 || !((t0 < jump) != (t1 < jump))) return {};
    return {jump};
  }
};

/// x' = x^2, infinite at 1/x(0).
struct Riccati {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    dxdt[0] = x[0] * x[0];
  }
};

template <class Problem>
std::vector<State<Problem::dimension>> starts(std::size_t count) {
  std::vector<State<Problem::dimension>> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < Problem::dimension; ++c)
      all[i][c] = std::sin(1.7 * static_cast<double>(i) + 0.3 * c);  // no two alike
  }
  return all;
}

/// Each state against integrate() alone, for several counts and numbers of threads.
template <class Problem, class Method>
void expect_same(const Problem& problem, const Method& method, double t0, double t1) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 8U, 29U}) {
    const auto from = starts<Problem>(count);
    for (const int threads : {1, 3}) {
      const auto ends = integrate_all(problem, std::span(from), t0, t1, method, threads);
      ASSERT_EQ(ends.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        const auto alone = integrate(Direct(problem), from[i], t0, t1, method);
        EXPECT_EQ(ends[i].x, alone.x) << i;
        EXPECT_EQ(ends[i].t, alone.t);
        EXPECT_EQ(ends[i].status.outcome(), alone.status.outcome());
        EXPECT_EQ(ends[i].statistics.steps, alone.statistics.steps);
        EXPECT_EQ(ends[i].statistics.rejected, alone.statistics.rejected);
        EXPECT_EQ(ends[i].statistics.right_hand_sides, alone.statistics.right_hand_sides);
        EXPECT_EQ(ends[i].statistics.seconds, 0);
      }
    }
  }
}

TEST(IntegrateAll, HasTheBitsOfOne) {
  expect_same(problems::Lorenz{}, Rk4{.step = 0.01}, 0, 1.237);
  expect_same(problems::Lorenz{}, Rk6{.step = 0.02}, 1, -1);
  expect_same(Pendulum{}, Euler{.step = 0.01}, 0, 2);
  expect_same(Pendulum{}, Rk4{.step = 0.05}, 0.5, 7);
  expect_same(Pendulum{.jump = 1}, Rk4{.step = 0.03}, 0, 2);  // one by one: steps land on the jump
}

// Steps that are chosen, in both directions of time, with trials that are rejected, with a first and a
// largest step of the user's; one by one over a jump.
TEST(IntegrateAll, Ode45HasTheBitsOfOne) {
  for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
    const Ode45 method{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
    expect_same(problems::Lorenz{}, method, 0, 4);
    expect_same(problems::Lorenz{}, method, 0.5, 0.1);
    expect_same(Pendulum{}, method, -3, 20);
    expect_same(Pendulum{.jump = 1}, method, 0, 2);
  }
  expect_same(Pendulum{}, Ode45{.initial_step = 0.01, .largest_step = 0.05}, 0, 3);
  const auto from = starts<problems::Lorenz>(40);
  const Ode45 loose{.relative_tolerance = 1e-4, .absolute_tolerance = 1e-4};
  std::int64_t rejected = 0;
  for (const auto& end : integrate_all(problems::Lorenz{}, std::span(from), 0, 10, loose))
    rejected += end.statistics.rejected;
  EXPECT_GT(rejected, 0);
}

// The compiled system too, which knows no other numbers than doubles.
TEST(IntegrateAll, SystemsByThreads) {
  const System<3> system{problems::Lorenz{}};
  const auto from = starts<problems::Lorenz>(11);
  const auto ends = integrate_all(system, std::span<const State<3>>(from), 0, 1, Rk4{.step = 0.01}, 2);
  for (std::size_t i = 0; i < from.size(); ++i)
    EXPECT_EQ(ends[i].x, integrate(system, from[i], 0, 1, Rk4{.step = 0.01}).x);
}

// What blows up, or never was a number, ends as it does alone; its neighbours in the register go on.
TEST(IntegrateAll, FailuresAreTheirOwn) {
  std::vector<State<1>> from(9);
  for (std::size_t i = 0; i < 9; ++i) from[i][0] = 0.1 * static_cast<double>(i);
  from[1][0] = 50;
  from[4][0] = std::numeric_limits<double>::quiet_NaN();
  const Rk4 method{.step = 0.01};
  const auto ends = integrate_all(Riccati{}, std::span<const State<1>>(from), 0, 1, method);
  for (std::size_t i = 0; i < 9; ++i) {
    const auto alone = integrate(Direct(Riccati{}), from[i], 0, 1, method);
    EXPECT_EQ(ends[i].status.outcome(), alone.status.outcome()) << i;
    EXPECT_EQ(ends[i].status.outcome(), i == 1 || i == 4 ? Outcome::non_finite : Outcome::success) << i;
    EXPECT_EQ(ends[i].t, alone.t);
    if (i == 1 || i == 4) continue;
    EXPECT_EQ(ends[i].x, alone.x);
    const double x0 = 0.1 * static_cast<double>(i);
    EXPECT_NEAR(ends[i].x[0], x0 / (1 - x0), 1e-5);  // order 4, 0.01^4 times derivatives near 1/(1 - 0.8)^5
  }
  const auto few = integrate_all(Riccati{}, std::span<const State<1>>(from), 0, 1, method, 1, {.steps = 5});
  EXPECT_EQ(few[0].status.outcome(), Outcome::step_limit);
}

TEST(IntegrateAll, FailuresOfOde45AreTheirOwn) {
  std::vector<State<1>> from(9);
  for (std::size_t i = 0; i < 9; ++i) from[i][0] = 0.1 * static_cast<double>(i);
  from[1][0] = 50;
  from[4][0] = std::numeric_limits<double>::quiet_NaN();
  for (const std::int64_t steps : {std::int64_t{1'000'000}, std::int64_t{12}}) {
    const auto ends =
        integrate_all(Riccati{}, std::span<const State<1>>(from), 0, 1, Ode45{}, 2, {.steps = steps});
    for (std::size_t i = 0; i < 9; ++i) {
      const auto alone = integrate(Direct(Riccati{}), from[i], 0, 1, Ode45{}, {}, {.steps = steps});
      EXPECT_EQ(ends[i].status.text(), alone.status.text()) << i;
      EXPECT_EQ(ends[i].t, alone.t);
      if (i == 4) continue;
      EXPECT_EQ(ends[i].x, alone.x);
    }
    EXPECT_EQ(ends[1].status.ok(), false);
    EXPECT_EQ(ends[8].status.ok(), steps > 12);
  }
}

TEST(IntegrateAll, RefusesWhatOneRefuses) {
  const auto from = starts<Riccati>(3);
  EXPECT_THROW((void)integrate_all(Riccati{}, std::span(from), 0, 1, Rk4{.step = 0}), std::invalid_argument);
  EXPECT_THROW((void)integrate_all(Riccati{}, std::span(from), 0, std::nan(""), Rk4{}),
               std::invalid_argument);
  const auto ends = integrate_all(Riccati{}, std::span(from), 1, 1, Rk4{});
  EXPECT_EQ(ends[2].x, from[2]);
}

}  // namespace
}  // namespace nlmech::ivp::integrate_all_test
