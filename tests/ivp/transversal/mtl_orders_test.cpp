/// Multi-step transversal linearisation: the orders of its bases, and the dependence of its error on the
/// nonlinearity.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/reference.hpp"

namespace nlmech::ivp::mtl_orders_test {
namespace {

using problems::TextProblem;
using testing::eps;

double error_of(const TextProblem& problem, const State& exact, double end, const Mtl& method) {
  const auto s = integrate(System(problem), State{1, 0}, 0, end, method);
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  return oracle::distance(s.x, exact);
}

// x'' + 0.1 x' + x + x^3 = cos t to t = 12: the observed order is that of the last of some halvings with
// errors above 1e-12.
TEST(Mtl, ObservedOrders) {
  const TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const State exact = testing::reference(problem, {1, 0}, 0, 12);
  for (const MtlLinear linear : {MtlLinear::given, MtlLinear::zero, MtlLinear::jacobian}) {
    for (int p = 1; p <= 6; ++p) {
      const int steps = p < 3 ? 960 : p < 6 ? 480 : 240;
      const double coarse =
          error_of(problem, exact, 12, {.step = 12. / steps, .points = p, .linear = linear});
      const double fine = error_of(problem, exact, 12, {.step = 6. / steps, .points = p, .linear = linear});
      EXPECT_NEAR(std::log2(coarse / fine), mtl_order(MtlBasis::lagrange, p), 0.12)
          << p << " " << to_string(linear) << " " << coarse << " " << fine;
    }
  }
  EXPECT_EQ(mtl_order(MtlBasis::lagrange, 1), 2);
  EXPECT_EQ(mtl_order(MtlBasis::lagrange, 2), 4);
  EXPECT_EQ(mtl_order(MtlBasis::lagrange, 3), 4);
  EXPECT_EQ(mtl_order(MtlBasis::lagrange, 4), 6);
  EXPECT_EQ(mtl_order(MtlBasis::lagrange, 5), 6);
}

TEST(Mtl, InterpoletsAreOfSecondOrder) {
  const TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const State exact = testing::reference(problem, {1, 0}, 0, 12);
  for (const int p : {1, 3, 4}) {
    const Mtl coarse{.step = 0.01, .points = p, .basis = MtlBasis::interpolet};
    Mtl fine = coarse;
    fine.step = 0.005;
    EXPECT_NEAR(std::log2(error_of(problem, exact, 12, coarse) / error_of(problem, exact, 12, fine)), 2,
                0.02);
  }
}

// The sum of functions with a Gaussian factor is one to O((h/sigma)^4) for p = 3: fourth order for a sigma
// fixed in time, none for a sigma of three steps.
TEST(Mtl, OrderOfDistributedApproximatingFunctionals) {
  const TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const State exact = testing::reference(problem, {1, 0}, 0, 12);
  const auto error = [&](double h, double width) {
    return error_of(problem, exact, 12, {.step = h, .basis = MtlBasis::daf, .width = width});
  };
  EXPECT_NEAR(std::log2(error(0.025, 1 / 0.025) / error(0.0125, 1 / 0.0125)), mtl_order(MtlBasis::daf, 3),
              0.12);
  EXPECT_NEAR(std::log2(error(0.025, 3) / error(0.0125, 3)), 0, 0.12);
  EXPECT_THROW(check_options(Mtl{.width = 1.9}), std::invalid_argument);
  EXPECT_THROW(check_options(Mtl{.width = NAN}), std::invalid_argument);
}

// With linear interpolation a step depends only on the step before, however many steps are solved together.
TEST(Mtl, InterpoletsOfThreePointsAreThreeStepsOfOne) {
  const TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const auto one = integrate(System(problem), State{1, 0}, 0, 3,
                             Mtl{.step = 0.1, .points = 1, .basis = MtlBasis::interpolet});
  const auto three = integrate(System(problem), State{1, 0}, 0, 3,
                               Mtl{.step = 0.1, .points = 3, .basis = MtlBasis::interpolet});
  EXPECT_NEAR(one.x[0], three.x[0], 100 * eps);
  EXPECT_NEAR(one.x[1], three.x[1], 100 * eps);
}

// Equations in first-order form.
TEST(Mtl, FirstOrderProblems) {
  const problems::TextProblem problem("lorenz");
  const State exact = testing::reference(problem, problems::TextProblem("lorenz").initial_state(), 0, 1);
  const auto error = [&](double h) {
    const auto s =
        integrate(System(problem), problems::TextProblem("lorenz").initial_state(), 0, 1, Mtl{.step = h});
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    return oracle::distance(s.x, exact);
  };
  EXPECT_NEAR(std::log2(error(1. / 300) / error(1. / 600)), 4, 0.1);
}

// The linear part and the load are solved exactly, so the error is proportional to the hardening.
TEST(Mtl, ErrorGoesWithTheNonlinearity) {
  const auto error = [](double hardening) {
    const TextProblem problem("driven-duffing", {{"damping", 0.1}, {"hardening", hardening}});
    return error_of(problem, testing::reference(problem, {1, 0}, 0, 6), 6, {.step = 0.2, .points = 3});
  };
  EXPECT_NEAR(error(1e-3) / error(1e-4), 10, 0.2);
}

}  // namespace
}  // namespace nlmech::ivp::mtl_orders_test
