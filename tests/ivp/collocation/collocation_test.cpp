#include "nlmech/ivp/collocation/collocation.hpp"

#include <gtest/gtest.h>

#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::collocation_test {
namespace {

using collocation::NodeFamily;
using oracle::distance;
constexpr double P = oracle::duffing_period;
constexpr double eps = 2.220446049250313e-16;

template <class Method>
double error_at_five(const Method& method) {
  const System system(problems::TextProblem("duffing"));
  const auto s = integrate(system, {1, 0}, 0, 5, method);
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  return distance(s.x, oracle::duffing(5));
}

// 32 steps over t = 5 with 7 nodes: the recorded errors are 1.1e-9 and 3.3e-15.
TEST(PolynomialCollocation, RadauBeatsLobattoWithTheSameUnknowns) {
  const double lobatto = error_at_five(PolynomialCollocation{.step = 5.0 / 32, .nodes = 7});
  const double radau = error_at_five(
      PolynomialCollocation{.step = 5.0 / 32, .nodes = 7, .points = NodeFamily::left_end_and_radau});
  EXPECT_NEAR(lobatto, 1.1e-9, 0.1e-9);
  EXPECT_LT(radau, 60 * eps);  // rounding errors of 32 steps
}

// The solution is t^6 - t^5 + constant.
TEST(PolynomialCollocation, ExactForPolynomialsOfItsDegree) {
  const auto s = integrate(testing::typed("x' = 6 t^5 - 5 t^4"), State{1}, 0, 2,
                           PolynomialCollocation{.step = 2, .nodes = 7});
  EXPECT_NEAR(s.x[0], 64 - 32 + 1, 33 * 50 * eps);  // t^6 - t^5 + 1; the norm of the matrix is about 50
}

TEST(PolynomialCollocation, DenseOutputMeetsTheNodesAndStaysClose) {
  const System system(problems::TextProblem("duffing"));
  double at_nodes = 0, between = 0;
  (void)integrate(
      system, {1, 0}, 0, P, PolynomialCollocation{.step = P / 2, .nodes = 30}, [&](const Step& step) {
        State x(2);
        for (std::size_t k = 0; k < step.times.size(); ++k) {
          step.dense.at(step.times[k], x);
          at_nodes = std::max(at_nodes, distance(x, State(step.states.col(static_cast<Eigen::Index>(k)))));
        }
        for (double part = 0; part <= 1; part += 0.01) {
          const double t = step.t0 + part * (step.t1 - step.t0);
          step.dense.at(t, x);
          between = std::max(between, distance(x, oracle::duffing(t)));
        }
        return true;
      });
  EXPECT_LT(at_nodes,
            1e-13);  // rounding of the node times: speed 1.2 times an ulp, times the Lebesgue constant
  EXPECT_LT(between, 1e-12);  // order 30 at half a period: truncation 1e-14, rounding above it
}

TEST(RbfCollocation, TendsToThePolynomialLimit) {
  const double limit = error_at_five(PolynomialCollocation{.step = 0.5, .nodes = 5});
  const double near = error_at_five(RbfCollocation{.step = 0.5, .nodes = 5, .shape = 0.2});
  EXPECT_NEAR(near / limit, 1, 0.03);  // relative deviation of the order (c h)^2 = 0.01
}

TEST(RbfCollocation, DefaultShapeIsTheDissertationsRule) {
  const System system(problems::TextProblem("duffing"));
  const auto rule = integrate(system, {1, 0}, 0, P, RbfCollocation{.step = P / 2, .nodes = 15});
  const auto given =
      integrate(system, {1, 0}, 0, P, RbfCollocation{.step = P / 2, .nodes = 15, .shape = 14 / (2 * P)});
  EXPECT_LE(distance(rule.x, given.x), 1e-10);  // one ulp of c times the condition number, 3e11
}

TEST(RbfCollocation, AShortenedStepKeepsTheRelativeShape) {
  const System system(problems::TextProblem("duffing"));
  const auto rest =
      integrate(system, {1, 0}, 0, 1.105 * P, RbfCollocation{.step = P / 10, .nodes = 7, .shape = 0.77});
  ASSERT_TRUE(rest.status.ok()) << rest.status.text();
  EXPECT_LT(distance(rest.x, oracle::duffing(1.105 * P)), 1e-5);
}

TEST(Collocation, RefusesBadOptions) {
  const System system(problems::TextProblem("duffing"));
  const auto run = [&](const auto& method) { (void)integrate(system, {1, 0}, 0, 1, method); };
  EXPECT_THROW(run(RbfCollocation{.nodes = 1}), std::invalid_argument);
  EXPECT_THROW(run(RbfCollocation{.nodes = 201}), std::invalid_argument);
  EXPECT_THROW(run(RbfCollocation{.shape = -1}), std::invalid_argument);
  EXPECT_THROW(run(RbfCollocation{.step = 0}), std::invalid_argument);
  EXPECT_THROW(run(PolynomialCollocation{.nodes = 0}), std::invalid_argument);
  EXPECT_THROW(run(Mcpi{.order = 0}), std::invalid_argument);
  EXPECT_THROW(run(Mcpi{.order = 8, .intervals = 7}), std::invalid_argument);
  EXPECT_THROW(run(Mcpi{.tolerance = 0}), std::invalid_argument);
}

TEST(Mcpi, ConvergesToTheExactMotion) {
  EXPECT_LT(error_at_five(Mcpi{.step = 0.5, .order = 14}), 1e-12);
  EXPECT_LT(error_at_five(Mcpi{.step = 1, .order = 20}), 1e-12);
}

}  // namespace
}  // namespace nlmech::ivp::collocation_test
