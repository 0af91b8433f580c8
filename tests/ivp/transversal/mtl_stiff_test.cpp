/// Multi-step transversal linearisation on stiff and fast problems: where it is exact, where it is bounded
/// and wrong, and that the error estimate says so.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/reference.hpp"

namespace nlmech::ivp::mtl_stiff_test {
namespace {

using problems::TextProblem;
using testing::eps;

Solution oscillator(double mu, double end, const Mtl& method) {
  return integrate(System(TextProblem("van-der-pol", {{"mu", mu}})), State{2, 0}, 0, end, method);
}

State truth_of(double mu, double end) {
  return testing::reference(TextProblem("van-der-pol", {{"mu", mu}}), {2, 0}, 0, end);
}

// ------------------------------------------------------------ van der Pol

// mu = 10 to t = 40. oracle: transversal_motions van der Pol *
TEST(MtlStiff, VanDerPolMu10) {
  constexpr double x = 1.872808279858089700;
  for (const MtlLinear linear : {MtlLinear::given, MtlLinear::jacobian}) {
    const auto s = oscillator(10, 40, {.step = 0.002, .points = 3, .linear = linear});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], x, 1e-7) << to_string(linear);
  }
}

// mu = 100, slow phase to t = 20. What the equation shows as linear grows like exp(mu t), and its
// interpolated rest must cancel that: with h = 0.05 no start leads Newton's iteration to the solution. With
// the Jacobian as linear part it does, and is accurate.
TEST(MtlStiff, LinearPartMustBeChosen) {
  const State truth = truth_of(100, 20);
  const Mtl given{.step = 0.05, .points = 3};
  const auto failed = oscillator(100, 20, given);
  EXPECT_FALSE(failed.status.ok() && oracle::distance(failed.x, truth) < 1e-3) << failed.status.text();
  Mtl jacobian = given;
  jacobian.linear = MtlLinear::jacobian;
  const auto s = oscillator(100, 20, jacobian);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], truth[0], 1e-6);
}

// mu = 1000 over the leap at t = 807: whatever a run without estimate ends with, one with it does not end on
// a wrong branch and call that a success.
TEST(MtlStiff, WrongBranchIsAStatus) {
  constexpr double x = 1.706167732170465008;  // at t = 2000, of tables/reference/rbf_ivp.csv and, to 13
                                              // digits, of the Bari test set
  for (const double h : {0.5, 0.125, 0.03}) {
    const auto s =
        oscillator(1000, 2000, {.step = h, .linear = MtlLinear::jacobian, .error_tolerance = 1e-3});
    EXPECT_FALSE(s.status.ok() && std::abs(s.x[0] - x) > 0.1) << h << ": x = " << s.x[0];
    EXPECT_TRUE(s.x.allFinite());
    if (!s.status.ok()) {
      EXPECT_NE(s.status.sentence().find("mtl"), std::string::npos);
    }
  }
}

// Equidistant points of high degree and a long step: Newton's iteration ends far away from the solution,
// which stays below 2. Nothing has to be asked for to learn that.
TEST(MtlStiff, AFarRootIsAStatusByDefault) {
  const System system(TextProblem("driven-duffing"));
  const auto blind =
      integrate(system, State{1, 0}, 0, 50, Mtl{.step = 0.4, .points = 8, .error_tolerance = 0});
  ASSERT_TRUE(blind.status.ok()) << blind.status.text();
  EXPECT_GT(std::abs(blind.x[0]), 10);
  const auto s = integrate(system, State{1, 0}, 0, 50, Mtl{.step = 0.4, .points = 8});
  EXPECT_EQ(s.status.outcome(), Outcome::wrong_branch) << s.status.text();
}

TEST(MtlStiff, EstimateNamesTheBlock) {
  const auto s = oscillator(10, 40, {.step = 0.1, .error_tolerance = 1e-4});
  ASSERT_EQ(s.status.outcome(), Outcome::wrong_branch) << s.status.text();
  for (const std::string word : {"mtl", "0.3", "t = ", "smaller step"})
    EXPECT_NE(s.status.sentence().find(word), std::string::npos) << s.status.text();
}

// On a smooth problem the estimate is an upper bound of what a block adds, and of the order h^(p + 2).
TEST(MtlStiff, EstimateBoundsTheErrorOfABlock) {
  const TextProblem problem("driven-duffing", {{"damping", 0.1}});
  const problems::ReferenceTrajectory<long double, TextProblem> reference(problem, {1, 0}, 0, 2);
  for (const int p : {1, 2, 3, 4}) {
    for (const double h : {0.1, 0.05}) {
      Mtl method{.step = h, .points = p};
      const State truth = reference(p * h).cast<double>();
      const auto end = integrate(System(problem), State{1, 0}, 0, p * h, method);
      const double error = oracle::distance(end.x, truth);
      // With the error itself as what is allowed, the estimate must object; a thousand times more must do.
      method.error_tolerance = error / 4;
      EXPECT_EQ(integrate(System(problem), State{1, 0}, 0, p * h, method).status.outcome(),
                Outcome::wrong_branch)
          << p << " " << h;
      method.error_tolerance = 20 * std::pow(h, p + 2);
      EXPECT_TRUE(integrate(System(problem), State{1, 0}, 0, p * h, method).status.ok()) << p << " " << h;
    }
  }
}

// ------------------------------------------------------------ fast Duffing

/// x'' + 1e6 x + m x^3 = cos t.
TextProblem fast(double m) { return TextProblem("driven-duffing", {{"stiffness", 1e6}, {"hardening", m}}); }

// On its slow manifold, x = 1e-6 at rest: linear to 18 digits, forced by a harmonic, and so exact for every
// step.
TEST(MtlStiff, SmoothStartIsExactForEveryStep) {
  for (const double m : {1., 1e3}) {
    const State truth = testing::reference(fast(m), {1e-6, 0}, 0, 1);
    for (const double h : {0.059, 0.1, 1. / 3}) {
      const auto s = integrate(System(fast(m)), State{1e-6, 0}, 0, 1, Mtl{.step = h});
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      // A block makes w h eps of a rounding in its response, and there are at most six.
      EXPECT_NEAR(s.x[0] / truth[0], 1, 6e3 * h * eps + 20 * eps) << h;
    }
  }
}

// From x = 1 the frequency depends on the amplitude by 3 m/(8 w): an angle of 3.75e-4 at t = 1. With w h
// above 3 the cubic force is sampled below its frequency and the error is of that size; with w h = 0.5 it is
// small.
TEST(MtlStiff, OscillatoryStartAliases) {
  const double truth = testing::reference(fast(1), {1, 0}, 0, 1)[0];
  const auto error = [&](double h) {
    const auto s = integrate(System(fast(1)), State{1, 0}, 0, 1, Mtl{.step = h});
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    return std::abs(s.x[0] - truth);
  };
  EXPECT_GT(error(0.0101), 1e-5);
  EXPECT_LT(error(0.0101), 2e-3);
  EXPECT_LT(error(0.0005), 1e-6);
}

// w h from 0.1 to 1e6: finite, and no larger than the energy allows (|x| <= 1 and what the force adds).
TEST(MtlStiff, BoundedForEveryStep) {
  for (const double z : {0.1, 3., 100., 1e4, 1e6}) {
    const double h = z / 1e3;
    const auto s = integrate(System(fast(1)), State{1, 0}, 0, 12 * h, Mtl{.step = h});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_LE(std::abs(s.x[0]), 1.01) << z;
  }
}

// ------------------------------------------------------------ energy

// x'' + x + x^3 = 0, h = 0.1, to t = 600: the largest error of the energy at ends of blocks is
// recorded, and it is there in the first tenth as in the last: no drift.
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

}  // namespace
}  // namespace nlmech::ivp::mtl_stiff_test
