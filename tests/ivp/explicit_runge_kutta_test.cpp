#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"

#include <gtest/gtest.h>

#include "chapters/plain_equations.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::explicit_runge_kutta_test {
namespace {

using oracle::distance;

template <class Method>
double error_at_five(double step) {
  const System system(problems::TextProblem("duffing"));
  const auto s = integrate(system, {1, 0}, 0, 5, Method{.step = step});
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_EQ(s.t, 5);
  return distance(s.x, oracle::duffing(5));
}

// Halving a step divides the error by 2^p; a tenth of an order is left for the next term of the expansion.
template <class Method>
void expect_order(double order, double step) {
  EXPECT_NEAR(std::log2(error_at_five<Method>(step) / error_at_five<Method>(step / 2)), order, 0.1);
}

TEST(ExplicitRungeKutta, ObservedOrders) {
  expect_order<Euler>(1, 1e-4);
  expect_order<Rk4>(4, 0.01);
  expect_order<Rk6>(6, 0.05);
}

// Row conditions: sum over a stage's coefficients is its abscissa; the weights sum to one.
template <class Method>
void expect_consistent() {
  const auto& table = Method::tableau;
  double weights = 0;
  for (std::size_t i = 0; i < table.stages; ++i) {
    double row = 0;
    for (const double a : table.a[i]) row += a;
    EXPECT_NEAR(row, table.c[i], 4e-16) << Method::name << ", stage " << i + 1;
    weights += table.b[i];
  }
  EXPECT_NEAR(weights, 1, 4e-16) << Method::name;
}

TEST(ExplicitRungeKutta, TableausAreConsistent) {
  expect_consistent<Euler>();
  expect_consistent<Rk4>();
  expect_consistent<Rk6>();
}

TEST(ExplicitRungeKutta, DenseOutputIsAsAccurateAsTheMethod) {
  const System system(problems::TextProblem("duffing"));
  double worst = 0;
  const auto s = integrate(system, {1, 0}, 0, 5, Rk6{.step = 0.05}, [&](const Step& step) {
    for (const double part : {0.0, 0.3, 0.7, 1.0}) {
      State x(2);
      const double t = step.t0 + part * (step.t1 - step.t0);
      step.dense.at(t, x);
      worst = std::max(worst, distance(x, oracle::duffing(t)));
    }
    return true;
  });
  ASSERT_TRUE(s.status.ok());
  // Not worse than twice the largest error at step ends, which the order makes about 1e-8 here.
  EXPECT_LT(worst, 2 * std::max(error_at_five<Rk6>(0.05), 1e-9) + 1e-8);
}

TEST(ExplicitRungeKutta, InlinedAndErasedAgreeToTheBit) {
  const chapters::PlainDuffing problem;
  const auto erased = integrate(System(problem), {1, 0}, 0, 20, Rk4{.step = 0.01});
  const auto inlined = integrate(Direct(problem), {1, 0}, 0, 20, Rk4{.step = 0.01});
  // The same operations; contraction to fused multiply-adds is off on the portable baseline.
  EXPECT_EQ(erased.x, inlined.x);
  EXPECT_EQ(erased.statistics.right_hand_sides, 4 * 2000);
}

TEST(ExplicitRungeKutta, BackwardsReturnsToTheStart) {
  const System system(problems::TextProblem("duffing"));
  const auto there = integrate(system, {1, 0}, 0, 7.3, Rk6{.step = 0.01});
  const auto back = integrate(system, there.x, 7.3, 0, Rk6{.step = 0.01});
  ASSERT_TRUE(back.status.ok());
  EXPECT_EQ(back.t, 0);
  // Twice the error of 730 steps of order 6: 2e-13 each way in the test above's terms.
  EXPECT_LT(distance(back.x, State{1, 0}), 1e-12);
}

}  // namespace
}  // namespace nlmech::ivp::explicit_runge_kutta_test
