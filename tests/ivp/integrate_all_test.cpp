/// Many initial states at once: the bits of integrate(), whatever stands beside, by threads.
#include "nlmech/ivp/ensemble/integrate_all.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/problems/texts.hpp"

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

std::vector<State> starts(std::size_t count, int size) {
  std::vector<State> all(count, State(size));
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < size; ++c)
      all[i][c] = std::sin(1.7 * static_cast<double>(i) + 0.3 * c);  // no two alike
  }
  return all;
}

/// Each state against integrate() alone, for several counts and numbers of threads.
template <class Method>
void expect_same(const System& system, const Method& method, double t0, double t1) {
  for (const std::size_t count : {0U, 1U, 2U, 8U, 29U}) {
    const auto from = starts(count, system.size());
    for (const int threads : {1, 3}) {
      const auto ends = integrate_all(system, std::span<const State>(from), t0, t1, method, threads);
      ASSERT_EQ(ends.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        const auto alone = integrate(system, from[i], t0, t1, method);
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
  expect_same(System(problems::TextProblem("lorenz")), Rk4{.step = 0.01}, 0, 1.237);
  expect_same(System(Pendulum{.jump = 1}), Rk4{.step = 0.03}, 0, 2);
  const Ode45 method{.relative_tolerance = 1e-6, .absolute_tolerance = 1e-6};
  expect_same(System(problems::TextProblem("lorenz")), method, 0.5, 0.1);
  expect_same(System(Pendulum{.jump = 1}), method, 0, 2);
}

// What blows up, or never was a number, ends as it does alone; its neighbours go on.
TEST(IntegrateAll, FailuresAreTheirOwn) {
  const System system(Riccati{});
  std::vector<State> from(9, State(1));
  for (std::size_t i = 0; i < 9; ++i) from[i][0] = 0.1 * static_cast<double>(i);
  from[1][0] = 50;
  from[4][0] = std::numeric_limits<double>::quiet_NaN();
  const Rk4 method{.step = 0.01};
  const auto ends = integrate_all(system, std::span<const State>(from), 0, 1, method);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(ends[i].status.outcome(), i == 1 || i == 4 ? Outcome::non_finite : Outcome::success) << i;
    if (i == 1 || i == 4) continue;
    const double x0 = 0.1 * static_cast<double>(i);
    EXPECT_NEAR(ends[i].x[0], x0 / (1 - x0), 1e-5);  // order 4, 0.01^4 times derivatives near 1/(1 - 0.8)^5
  }
  const auto few = integrate_all(system, std::span<const State>(from), 0, 1, method, 1, {.steps = 5});
  EXPECT_EQ(few[0].status.outcome(), Outcome::step_limit);
}

TEST(IntegrateAll, RefusesWhatOneRefuses) {
  const System system(Riccati{});
  const auto from = starts(3, 1);
  const std::span<const State> states(from);
  EXPECT_THROW((void)integrate_all(system, states, 0, 1, Rk4{.step = 0}), std::invalid_argument);
  EXPECT_THROW((void)integrate_all(system, states, 0, std::nan(""), Rk4{}), std::invalid_argument);
  const auto ends = integrate_all(system, states, 1, 1, Rk4{});
  EXPECT_EQ(ends[2].x, from[2]);
}

}  // namespace
}  // namespace nlmech::ivp::integrate_all_test
