// A method that is nothing but a tableau: what EmbeddedPair makes of it.
#include "nlmech/ivp/runge_kutta/embedded_runge_kutta.hpp"

#include <gtest/gtest.h>

#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::embedded_runge_kutta_test {
namespace {

using namespace testing;

// Orders 3 and 2, with f at the end of a step as the first stage of the next (P. Bogacki, L. F. Shampine, A
// 3(2) pair of Runge-Kutta formulas, Appl. Math. Lett. 2 (1989) 321-325).
struct BogackiShampine {
  static constexpr std::string_view name = "bogacki-shampine";
  struct Pair : EmbeddedPair<Pair> {
    static constexpr int order = 3;
    static constexpr std::array<double, 4> c = {0, 1. / 2, 3. / 4, 1};
    static constexpr std::array<std::array<double, 3>, 4> a = {
        {{}, {1. / 2}, {0, 3. / 4}, {2. / 9, 1. / 3, 4. / 9}}};
    static constexpr std::array<double, 4> error_weights = {-5. / 72, 1. / 12, 1. / 9, -1. / 8};
  };
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-6, initial_step = 0, largest_step = 0;
};

// Kutta's formula of order 3 with the midpoint rule: f at the end of a step is evaluated for accepted steps.
struct KuttaMidpoint {
  static constexpr std::string_view name = "kutta-midpoint";
  struct Pair : EmbeddedPair<Pair> {
    static constexpr int order = 3;
    static constexpr std::array<double, 4> c = {0, 1. / 2, 1, 1};
    static constexpr std::array<std::array<double, 3>, 4> a = {
        {{}, {1. / 2}, {-1, 2}, {1. / 6, 2. / 3, 1. / 6}}};
    static constexpr std::array<double, 3> error_weights = {1. / 6, -1. / 3, 1. / 6};
  };
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-6, initial_step = 0, largest_step = 0;
};

// One step of length h, and many: errors of order 4 at its end and inside, 3 for all of them.
template <class Method>
void expect_order_three() {
  const Manufactured problem;
  const auto local = [&](double h) { return largest_error(problem, with_step(Method{}, h), 0, h, true); };
  EXPECT_NEAR(std::log2(local(0.1) / local(0.05)), 4, 0.3) << Method::name;
  const auto global = [&](double h) { return largest_error(problem, with_step(Method{}, h), 0, 2); };
  EXPECT_NEAR(std::log2(global(0.04) / global(0.02)), 3, 0.1) << Method::name;
}
TEST(EmbeddedRungeKutta, ATableauHasItsOrder) {
  expect_order_three<BogackiShampine>();
  expect_order_three<KuttaMidpoint>();
}

// From (1, 0) to t = 10: each step adds an error below the tolerance, which a rotation does not amplify.
template <class Method>
void expect_controlled() {
  double error_before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const Method method{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
    const auto s = integrate(System(Oscillator{}), State{1, 0}, 0, 10, method);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    const double error = std::max(std::abs(s.x[0] - std::cos(10)), std::abs(s.x[1] + std::sin(10)));
    EXPECT_LT(error, static_cast<double>(s.statistics.steps) * tolerance) << Method::name;
    EXPECT_LT(error, error_before / 10) << Method::name;
    error_before = error;
  }
}
TEST(EmbeddedRungeKutta, ATableauMeetsItsTolerance) {
  expect_controlled<BogackiShampine>();
  expect_controlled<KuttaMidpoint>();
}

TEST(EmbeddedRungeKutta, ATableauCountsItsWork) {
  const Statistics same =
      integrate(System(Manufactured{}), State{1, 0}, 0, 20, BogackiShampine{.initial_step = 1}).statistics;
  EXPECT_GT(same.rejected, 0);
  EXPECT_EQ(same.right_hand_sides, 1 + 3 * (same.steps + same.rejected));
  const Statistics another =
      integrate(System(Manufactured{}), State{1, 0}, 0, 20, KuttaMidpoint{.initial_step = 1}).statistics;
  EXPECT_GT(another.rejected, 0);
  EXPECT_EQ(another.right_hand_sides, 1 + another.steps + 2 * (another.steps + another.rejected));
}

}  // namespace
}  // namespace nlmech::ivp::embedded_runge_kutta_test
