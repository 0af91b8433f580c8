// The inlined Odeint is the same Odeint.
#include "nlmech/peers/ivp/odeint/odeint_direct.hpp"
#include "chapters/plain_equations.hpp"

#include "nlmech/problems/duffing.hpp"
#include "tests/peers_ivp/peers.hpp"

namespace nlmech::peers::odeint_direct_test {
namespace {

using namespace testing;

OdeintDirect inlined(Odeint::Formula formula) {
  OdeintDirect method;
  method.formula = formula;
  return method;
}

TEST(OdeintDirect, TakesTheSameSteps) {
  const chapters::PlainDuffing duffing;
  const ivp::Direct direct(duffing);
  const ivp::System system(duffing);
  for (const auto formula :
       {Odeint::Formula::dopri5, Odeint::Formula::fehlberg78, Odeint::Formula::bulirsch_stoer}) {
    const Odeint method{.formula = formula};
    for (const double end : {20.0, -20.0}) {
      const auto a = ivp::integrate(direct, {1, 0}, 0, end, inlined(formula));
      const auto b = ivp::integrate(system, {1, 0}, 0, end, method);
      ASSERT_TRUE(a.status.ok() && b.status.ok()) << method.name();
      EXPECT_EQ(a.statistics.steps, b.statistics.steps) << method.name();
      EXPECT_EQ(a.statistics.right_hand_sides, b.statistics.right_hand_sides) << method.name();
      // Compiled separately: rounding may differ, a thousandth of the tolerance at most.
      EXPECT_LT((a.x - b.x).lpNorm<Eigen::Infinity>(), 1e-12) << method.name();
    }
  }
}

TEST(OdeintDirect, HasNoRosenbrockMethod) {
  const ivp::Direct direct(chapters::PlainDuffing{});
  EXPECT_THROW((void)ivp::integrate(direct, {1, 0}, 0, 1, inlined(Odeint::Formula::rosenbrock4)),
               std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::peers::odeint_direct_test
