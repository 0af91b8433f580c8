/// Multi-step transversal linearisation: several degrees of freedom, symmetry, dense output.
#include "nlmech/ivp/transversal/mtl.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/transversal/mtl_run.hpp"

namespace nlmech::ivp::mtl_test {
namespace {

using problems::TextProblem;
using testing::eps;
using testing::run;

// ------------------------------------------------------------ more degrees of freedom

// Two masses that move as one, or against each other, are Duffing oscillators with the stiffness 1 or 1 + 2
// s.
TEST(Mtl, TwoDegreesOfFreedom) {
  const TextProblem problem("two-dof", {{"damping", 0}, {"coupling", 0.5}, {"force", 0}});
  for (const int sign : {1, -1}) {
    const problems::Duffing mode{.natural_frequency = sign > 0 ? 1 : std::sqrt(2.), .hardening = 1};
    const State truth = oracle::duffing(5, mode);
    const auto s =
        integrate(System(problem), State{1, 1. * sign, 0, 0}, 0, 5, Mtl{.step = 0.01, .points = 5});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    // Order 6, of the size of (w h)^6 = 1e-12 a period, and 100 blocks of roundings.
    EXPECT_NEAR(s.x[0], truth[0], 1e-10);
    EXPECT_NEAR(s.x[2], truth[1], 1e-10);
    EXPECT_NEAR(s.x[1], sign * truth[0], 1e-10);
    EXPECT_NEAR(s.x[3], sign * truth[1], 1e-10);
  }
}

// ------------------------------------------------------------ what is conserved

// There and back: time-symmetric with a fixed linear part, and not with one taken at the begin of a block.
TEST(Mtl, SymmetricInTime) {
  const TextProblem problem("driven-duffing");
  const auto gap = [&](MtlLinear linear, int p) {
    const Mtl method{.step = 0.1, .points = p, .linear = linear};
    const auto there = run(problem, {1, 0}, 0, 6, method);
    const auto back = run(problem, there.x, 6, 0, method);
    EXPECT_TRUE(there.status.ok() && back.status.ok());
    return oracle::distance(back.x, State{1, 0});
  };
  for (int p = 1; p <= 6; ++p) {
    // Roundings of 120 steps, which the motion amplifies some ten times.
    EXPECT_LE(gap(MtlLinear::given, p), 1e4 * eps) << p;
    EXPECT_LE(gap(MtlLinear::zero, p), 1e4 * eps) << p;
  }
  EXPECT_GT(gap(MtlLinear::jacobian, 3), 1e-8);
}

// det - 1 of the derivative of one block of x'' + x + x^3 = 0, h = 0.1, at (1, 0.3), by central differences.
// oracle: transversal_motions MTL *
TEST(Mtl, BlocksAreNotSymplectic) {
  const TextProblem problem("driven-duffing", {{"force", 0}});
  const auto determinant = [&](int p) {
    const Mtl method{.step = 0.1, .points = p};
    const double d = 1e-5;
    Eigen::Matrix2d m;
    for (int i = 0; i < 2; ++i) {
      const State change = d * State::Unit(2, i), x{1, 0.3};
      m.col(i) =
          (run(problem, x + change, 0, 0.1 * p, method).x - run(problem, x - change, 0, 0.1 * p, method).x) /
          (2 * d);
    }
    return m.determinant() - 1;
  };
  EXPECT_NEAR(determinant(1), -2.0e-4, 0.05e-4);
  EXPECT_NEAR(determinant(2), -2.5e-6, 0.05e-6);
  EXPECT_NEAR(determinant(3), -1.3e-6, 0.05e-6);
}

// ------------------------------------------------------------ dense output

// It meets the states at the points. Within a block, and at its inner points, it is of the order p + 1.
TEST(Mtl, DenseOutputIsTheLinearisedSolution) {
  const TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const problems::ReferenceTrajectory<long double, TextProblem> reference(problem, {1, 0}, 0, 6);
  double worst = 0, at_points = 0;
  State x(2);
  const auto observe = [&](const Step& step) {
    EXPECT_EQ(step.times.size(), 4U);
    for (std::size_t i = 0; i < step.times.size(); ++i) {
      step.dense.at(step.times[i], x);
      at_points =
          std::max(at_points, oracle::distance(x, State(step.states.col(static_cast<Eigen::Index>(i)))));
    }
    for (int i = 0; i <= 40; ++i) {
      const double t = step.t0 + (step.t1 - step.t0) * i / 40;
      step.dense.at(t, x);
      worst = std::max(worst, oracle::distance(x, State(reference(t).cast<double>())));
    }
    return true;
  };
  const auto s = integrate(System(problem), State{1, 0}, 0, 6, Mtl{.step = 0.05, .points = 4}, observe);
  ASSERT_TRUE(s.status.ok());
  EXPECT_EQ(at_points, 0);
  // The error at the ends, and h^5 for the interpolation within.
  EXPECT_LE(worst, 4 * oracle::distance(s.x, State(reference(6).cast<double>())) + std::pow(0.05, 5));
}

}  // namespace
}  // namespace nlmech::ivp::mtl_test
