/// Multi-step transversal linearisation: several degrees of freedom, symmetry, dense output, error estimate.
/// Stiff and fast problems: the scene extremes of the chapter transversal.
#include "nlmech/ivp/transversal/mtl.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::mtl_test {
namespace {

using problems::TextProblem;
using testing::eps;
using testing::refusal;

// ------------------------------------------------------------ more degrees of freedom

// Two masses with equal or opposite motion are Duffing oscillators with the stiffness 1 or 1 + 2 s.
TEST(Mtl, TwoDegreesOfFreedom) {
  const TextProblem problem("two-dof", {{"damping", 0}, {"coupling", 0.5}, {"force", 0}});
  for (const int sign : {1, -1}) {
    const problems::Duffing mode{.natural_frequency = sign > 0 ? 1 : std::sqrt(2.), .hardening = 1};
    const State exact = oracle::duffing(5, mode);
    const auto s =
        integrate(System(problem), State{1, 1. * sign, 0, 0}, 0, 5, Mtl{.step = 0.01, .points = 5});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    // Order 6: errors of about (w h)^6 = 1e-12 a period, and rounding errors of 100 blocks.
    EXPECT_NEAR(s.x[0], exact[0], 1e-10);
    EXPECT_NEAR(s.x[2], exact[1], 1e-10);
    EXPECT_NEAR(s.x[1], sign * exact[0], 1e-10);
    EXPECT_NEAR(s.x[3], sign * exact[1], 1e-10);
  }
}

// ------------------------------------------------------------ conserved quantities

// Forwards and backwards: the method is time-symmetric with a fixed linear part, and not with one taken at
// the start of a block.
TEST(Mtl, SymmetricInTime) {
  const TextProblem problem("driven-duffing");
  const auto gap = [&](MtlLinear linear, int p) {
    const Mtl method{.step = 0.1, .points = p, .linear = linear};
    const auto there = integrate(System(problem), State{1, 0}, 0, 6, method);
    const auto back = integrate(System(problem), there.x, 6, 0, method);
    EXPECT_TRUE(there.status.ok() && back.status.ok());
    return oracle::distance(back.x, State{1, 0});
  };
  for (int p = 1; p <= 6; ++p) {
    // Rounding errors of 120 steps, which the motion amplifies some ten times.
    EXPECT_LE(gap(MtlLinear::given, p), 1e4 * eps) << p;
    EXPECT_LE(gap(MtlLinear::zero, p), 1e4 * eps) << p;
  }
  EXPECT_GT(gap(MtlLinear::jacobian, 3), 1e-8);
}

// x'' + x + x^3 = 0, h = 0.1, to t = 600: the largest energy error at ends of blocks is recorded. It is equal
// in the first tenth and the last: no drift.
TEST(MtlEnergy, IsBounded) {
  const problems::Duffing problem;
  const double known[] = {1.4e-3, 3.8e-5, 4.4e-5, 4.8e-6, 2.3e-6};
  for (int p = 1; p <= 5; ++p) {
    const State x0{1, 0};
    const double energy = problem.energy(x0);
    double early = 0, late = 0;
    const auto observe = [&](const Step& s) {
      const double error = std::abs(problem.energy(s.x1) / energy - 1);
      if (s.t1 <= 60) early = std::max(early, error);
      if (s.t1 > 540) late = std::max(late, error);
      return true;
    };
    const auto end = integrate(System(problem.text()), x0, 0, 600, Mtl{.step = 0.1, .points = p}, observe);
    ASSERT_TRUE(end.status.ok());
    EXPECT_NEAR(late / early, 1, 0.1) << p;
    EXPECT_NEAR(std::max(early, late) / known[p - 1], 1, 0.04) << p;
  }
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
      m.col(i) = (integrate(System(problem), x + change, 0, 0.1 * p, method).x -
                  integrate(System(problem), x - change, 0, 0.1 * p, method).x) /
                 (2 * d);
    }
    return m.determinant() - 1;
  };
  EXPECT_NEAR(determinant(1), -2.0e-4, 0.05e-4);
  EXPECT_NEAR(determinant(2), -2.5e-6, 0.05e-6);
  EXPECT_NEAR(determinant(3), -1.3e-6, 0.05e-6);
}

// ------------------------------------------------------------ dense output

// Dense output equals the states at the points; within a block and at its inner points it has order p + 1.
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
  // The error at the ends, and h^5 for the interpolation within a block.
  EXPECT_LE(worst, 4 * oracle::distance(s.x, State(reference(6).cast<double>())) + std::pow(0.05, 5));
}

// ------------------------------------------------------------ stiff problems, and the error estimate

TEST(MtlStiff, EstimateNamesTheSteps) {
  const auto s = integrate(System(TextProblem("van-der-pol", {{"mu", 10}})), State{2, 0}, 0, 40,
                           Mtl{.step = 0.1, .error_tolerance = 1e-4});
  ASSERT_EQ(s.status.outcome(), Outcome::wrong_branch) << s.status.text();
  for (const std::string word : {"mtl", "3 steps of 0.1", "t = ", "smaller step"})
    EXPECT_NE(s.status.sentence().find(word), std::string::npos) << s.status.text();
}

// On a smooth problem the estimate is an upper bound of the local error of a block, with order h^(p + 2).
TEST(MtlStiff, EstimateBoundsTheErrorOfABlock) {
  const TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const problems::ReferenceTrajectory<long double, TextProblem> reference(problem, {1, 0}, 0, 2);
  for (const int p : {1, 2, 3, 4}) {
    for (const double h : {0.1, 0.05}) {
      Mtl method{.step = h, .points = p};
      const State exact = reference(p * h).cast<double>();
      const auto end = integrate(System(problem), State{1, 0}, 0, p * h, method);
      const double error = oracle::distance(end.x, exact);
      // A quarter of the error as tolerance is rejected; 20 h^(p + 2) is accepted.
      method.error_tolerance = error / 4;
      EXPECT_EQ(integrate(System(problem), State{1, 0}, 0, p * h, method).status.outcome(),
                Outcome::wrong_branch)
          << p << " " << h;
      method.error_tolerance = 20 * std::pow(h, p + 2);
      EXPECT_TRUE(integrate(System(problem), State{1, 0}, 0, p * h, method).status.ok()) << p << " " << h;
    }
  }
}

// w h from 0.1 to 1e6: finite, and no larger than the energy allows (|x| <= 1 and what the force adds).
TEST(MtlStiff, BoundedForEveryStep) {
  const System system(TextProblem("driven-duffing", {{"stiffness", 1e6}, {"hardening", 1}}));
  for (const double z : {0.1, 3., 100., 1e4, 1e6}) {
    const double h = z / 1e3;
    const auto s = integrate(system, State{1, 0}, 0, 12 * h, Mtl{.step = h});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_LE(std::abs(s.x[0]), 1.01) << z;
  }
}

TEST(Mtl, OverflowOfTheLinearPartIsSaid) {
  const auto s = integrate(testing::typed("x'' = 1000 x'"), State{1, 0}, 0, 1,
                           Mtl{.step = 1, .points = 1});  // exp(1000)
  EXPECT_EQ(s.status.outcome(), Outcome::non_finite);
  EXPECT_NE(s.status.sentence().find("linear part"), std::string::npos) << s.status.text();
}

TEST(Mtl, OptionsOutOfRangeAreNamed) {
  EXPECT_NE(refusal(Mtl{.step = 0}).find("step must be positive"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.points = 0}).find("points must be between 1 and 8, not 0"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.points = 9}).find("not 9"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.error_tolerance = -1}).find("-1"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.error_tolerance = testing::infinity}).find("inf"), std::string::npos);
}

}  // namespace
}  // namespace nlmech::ivp::mtl_test
