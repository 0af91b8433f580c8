// Counters mean the same for every peer: evaluations that the equations themselves have counted.
#include <memory>

#include "nlmech/peers/ivp/equations.hpp"
#include "tests/peers_ivp/peers.hpp"

namespace nlmech::peers::statistics_test {
namespace {

using namespace testing;
class EveryPeerCounts : public EveryPeer {};
INSTANTIATE_TEST_SUITE_P(Peers, EveryPeerCounts, ::testing::ValuesIn(all_peer_names()), test_name);

// x'' = -x - x'/10 + cos t, written for double alone.
struct Counting {
  static constexpr int dimension = 2;
  struct Counts {
    std::int64_t right_hand_sides = 0, jacobians = 0;
  };
  std::shared_ptr<Counts> counts = std::make_shared<Counts>();
  void operator()(double t, const Vector<double, 2>& x, Vector<double, 2>& dxdt) const {
    ++counts->right_hand_sides;
    dxdt = {x[1], -x[0] - 0.1 * x[1] + std::cos(t)};
  }
  void jacobian(double /*t*/, const Vector<double, 2>& /*x*/, Matrix<double, 2>& j) const {
    ++counts->jacobians;
    j << 0, 1, -1, -0.1;
  }
};

TEST_P(EveryPeerCounts, WhatTheEquationsCount) {
  const Counting problem;
  const auto solution = run(ivp::System(problem), {1, 0}, 0, 5, 1e-7);
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  const Statistics& s = solution.statistics;
  EXPECT_EQ(s.right_hand_sides, problem.counts->right_hand_sides);
  EXPECT_EQ(s.jacobians, problem.counts->jacobians);
  EXPECT_EQ(s.jacobians > 0, peer_info(GetParam()).family == ivp::Family::implicit);
  EXPECT_GT(s.steps, 2);
  EXPECT_GE(s.right_hand_sides, s.steps);
  EXPECT_GT(s.seconds, 0);
  const bool counts_newton = GetParam() == "cvode-bdf" || GetParam() == "arkode-dirk";
  EXPECT_EQ(s.newton_iterations > 0, counts_newton);
  EXPECT_EQ(s.factorisations > 0, counts_newton || GetParam() == "odeint-rosenbrock4");
}

// x_1' = x_2 exp(-t), x_2' = sin(3 t) - x_1^2.
struct Forced {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    using std::exp;
    using std::sin;
    dxdt[0] = x[1] * exp(-t);
    dxdt[1] = sin(3 * t) - x[0] * x[0];
  }
};

TEST(TimeDerivative, IsExactByDualNumbers) {
  const ivp::System system(Forced{});
  const ivp::System dynamic{Forced{}};
  const ivp::State x{0.3, -1.7};
  for (const double t : {-2.0, 0.0, 0.4, 5.0}) {
    ivp::State dfdt(2);
    ASSERT_TRUE(system.time_derivative(t, x, dfdt));
    EXPECT_NEAR(dfdt[0], 1.7 * std::exp(-t), 8 * eps * 1.7 * std::exp(-t));
    EXPECT_NEAR(dfdt[1], 3 * std::cos(3 * t), 8 * eps * 3 * (1 + 3 * std::abs(t)));
    ivp::State same(2);
    ASSERT_TRUE(dynamic.time_derivative(t, x, same));
    EXPECT_EQ(same, dfdt);
  }
}

TEST(TimeDerivative, IsADifferenceForProblemsInDouble) {
  const ivp::System system(Counting{});
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
  // At the ends of a segment it stays inside: one-sided, h/2 max |d2f/dt2|.
  equations.enter(1, 2);
  for (const double t : {1.0, 2.0}) {
    equations.time_derivative(t, x.data(), dfdt.data());
    EXPECT_NEAR(dfdt[1], -std::sin(t), 7e-6);
  }
}

}  // namespace
}  // namespace nlmech::peers::statistics_test
