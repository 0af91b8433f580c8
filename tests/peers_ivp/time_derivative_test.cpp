// The derivative with respect to time, for implicit formulas of peers.
#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/peers/ivp/peer_stepper.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/support/doubles.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::peers::time_derivative_test {
namespace {

// x'' = -x - x'/10 + cos t, written for double alone.
struct Driven {
  static constexpr int dimension = 2;
  void operator()(double t, const Vector<double, 2>& x, Vector<double, 2>& dxdt) const {
    dxdt = {x[1], -x[0] - 0.1 * x[1] + std::cos(t)};
  }
  void jacobian(double /*t*/, const Vector<double, 2>& /*x*/, Matrix<double, 2>& j) const {
    j << 0, 1, -1, -0.1;
  }
};

TEST(TimeDerivative, IsExactByDualNumbers) {
  const ivp::System system = ivp::testing::typed("x' = y exp(-t); y' = sin(3 t) - x^2");
  const ivp::State x{0.3, -1.7};
  for (const double t : {-2.0, 0.0, 0.4, 5.0}) {
    ivp::State dfdt(2);
    ASSERT_TRUE(system.time_derivative(t, x, dfdt));
    EXPECT_NEAR(dfdt[0], 1.7 * std::exp(-t), 8 * eps * 1.7 * std::exp(-t));
    EXPECT_NEAR(dfdt[1], 3 * std::cos(3 * t), 8 * eps * 3 * (1 + 3 * std::abs(t)));
  }
}

TEST(TimeDerivative, IsADifferenceForProblemsInDouble) {
  const ivp::System system(Driven{});
  ivp::State untouched{7, 7};
  EXPECT_FALSE(system.time_derivative(0, {1, 2}, untouched));
  EXPECT_EQ(untouched, (ivp::State{7, 7}));

  EquationsOf<ivp::System> equations(system);
  const ivp::State x{1, 2};
  ivp::State dfdt(2);
  for (const double t : {-2.0, 0.0, 0.4, 50.0}) {
    equations.time_derivative(t, x.data(), dfdt.data());
    EXPECT_EQ(dfdt[0], 0);
    // h^2/6 for h = 6e-6 max(1, |t|), and 2 eps |f|/h for its rounding.
    EXPECT_NEAR(dfdt[1], -std::sin(t), t == 50 ? 2e-8 : 3e-10);
  }
  // At the ends of a segment the difference stays inside: one-sided, h/2 max |d2f/dt2|.
  equations.enter(1, 2);
  for (const double t : {1.0, 2.0}) {
    equations.time_derivative(t, x.data(), dfdt.data());
    EXPECT_NEAR(dfdt[1], -std::sin(t), 7e-6);
  }
}

}  // namespace
}  // namespace nlmech::peers::time_derivative_test
