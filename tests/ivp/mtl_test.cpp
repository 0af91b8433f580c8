/// Multi-step transversal linearisation: orders, exactness on linear problems, symmetry, statuses.
#include "nlmech/ivp/mtl.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp {
namespace {

using problems::DrivenDuffing;
using problems::LinearOscillator;
using problems::TwoDof;
using testing::eps;

/// State of the linear oscillator by its closed form, underdamped, away from undamped resonance.
State<2> exact(const LinearOscillator& p, const State<2>& x0, double t) {
  using Complex = std::complex<long double>;
  const long double w = p.natural_frequency, zeta = p.damping_ratio, wf = p.frequency;
  const Complex i(0, 1);
  // Steady state: the real part of c exp(i W t).
  const Complex c = static_cast<long double>(p.force) / Complex(w * w - wf * wf, 2 * zeta * w * wf);
  const Complex root(-zeta * w, w * std::sqrt(1 - zeta * zeta));
  const long double x = x0[0] - c.real(), v = x0[1] - (i * wf * c).real();
  // The rest: the real part of d exp(root t).
  const Complex d(x, (root.real() * x - v) / root.imag());
  const Complex free = d * std::exp(root * static_cast<long double>(t));
  const Complex forced = c * std::exp(i * wf * static_cast<long double>(t));
  return {static_cast<double>((free + forced).real()),
          static_cast<double>((root * free + i * wf * forced).real())};
}

Solution<2> run(const DrivenDuffing& p, const State<2>& x0, double t0, double t1, const Mtl& method) {
  return integrate(System(p), x0, t0, t1, method);
}

// ------------------------------------------------------------ linear problems

// "Exact" for every step: what is left are roundings. A block of p steps makes some 10 (1 + w h) eps of its
// own, relative to the scale (1, w) of the state, and undamped they add up over the blocks.
TEST(Mtl, LinearProblemsAreExact) {
  const State<2> x0(1, 0.5);
  for (const double w : {1e-3, 1., 30., 1e3}) {
    for (const double zeta : {0., 0.05, 0.7}) {
      for (const double h : {0.001, 0.1, 1.7}) {
        for (const int p : {1, 2, 3, 5, 8}) {
          const LinearOscillator problem{
              .natural_frequency = w, .damping_ratio = zeta, .force = 2 * w * w, .frequency = 0.3 * w + 0.1};
          const double end = 7 * h * p;
          const auto s = integrate(System(problem), x0, 0, end, Mtl{.step = h, .points = p});
          ASSERT_TRUE(s.status.ok()) << s.status.text();
          const State<2> truth = exact(problem, x0, end);
          const double bound = 7 * p * 20 * eps * (1 + w * h) * (4 + 4 / w);
          EXPECT_NEAR(s.x[0], truth[0], bound) << w << " " << zeta << " " << h << " " << p;
          EXPECT_NEAR(s.x[1], truth[1], bound * (1 + w)) << w << " " << zeta << " " << h << " " << p;
        }
      }
    }
  }
}

// w h up to 1e6 in one block of one step: the argument of the sine is rounded to (w h) eps, and so is all.
TEST(Mtl, LongStepsOfFastOscillatorsAreExactToTheirConditioning) {
  for (const double z : {1e2, 1e4, 1e6}) {
    const LinearOscillator problem{.natural_frequency = 1e4, .force = 1e8, .frequency = 3};
    const double h = z / 1e4;
    const auto s = integrate(System(problem), State<2>(1, 0), 0, 3 * h, Mtl{.step = h, .points = 3});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    const State<2> truth = exact(problem, {1, 0}, 3 * h);
    EXPECT_NEAR(s.x[0], truth[0], 60 * eps * z);
    EXPECT_NEAR(s.x[1], truth[1], 60 * eps * z * 1e4);
  }
}

// At resonance the particular solution grows with time; a formula that divides by w^2 - W^2 has nothing.
TEST(Mtl, ResonanceIsExact) {
  const LinearOscillator problem{.force = 1, .frequency = 1};
  const auto s = integrate(System(problem), State<2>(0, 0), 0, 30, Mtl{.step = 0.5, .points = 3});
  EXPECT_NEAR(s.x[0], 15 * std::sin(30.), 2e3 * eps);
  EXPECT_NEAR(s.x[1], (std::sin(30.) + 30 * std::cos(30.)) / 2, 2e3 * eps);
}

// K = C = 0: a mass under a force alone, whose motion is a polynomial and a cosine.
TEST(Mtl, NoSpringAndNoDamper) {
  const DrivenDuffing problem{.stiffness = 0, .hardening = 0, .force = 1, .frequency = 2};
  for (const double h : {1e-6, 0.1, 10.}) {
    const auto s = run(problem, {1, 0.5}, 0, 6 * h, {.step = h, .points = 3});
    ASSERT_TRUE(s.status.ok());
    EXPECT_NEAR(s.x[0], 1 + 3 * h + (1 - std::cos(12 * h)) / 4, 100 * eps * (1 + h));
    EXPECT_NEAR(s.x[1], 0.5 + std::sin(12 * h) / 2, 100 * eps * (1 + h));
  }
}

RC_GTEST_PROP(Mtl, LinearProblemsAreExactForAnyStep, ()) {
  const auto number = [](int from, int to) { return *rc::gen::inRange(from, to) / 1000.; };
  const LinearOscillator problem{.natural_frequency = number(10, 20000),
                                 .damping_ratio = number(0, 900),
                                 .force = number(-5000, 5000),
                                 .frequency = number(1, 20000) + 0.0003};
  const double h = number(1, 3000);
  const int p = *rc::gen::inRange(1, 9);
  const State<2> x0(number(-2000, 2000), number(-2000, 2000));
  const auto s = integrate(System(problem), x0, 0, 4 * p * h, Mtl{.step = h, .points = p});
  RC_ASSERT(s.status.ok());
  const State<2> truth = exact(problem, x0, 4 * p * h);
  const double w = problem.natural_frequency;
  // The closed form loses digits near resonance and for a slow oscillator: its own amplitudes are the scale.
  const double gap = std::abs(w * w - problem.frequency * problem.frequency) +
                     2 * problem.damping_ratio * w * problem.frequency;
  const double scale = 4 + 4 / w + 10 * std::abs(problem.force) / gap * (1 + problem.frequency / w);
  const double bound = 400 * eps * (1 + (w + problem.frequency) * h * p) * scale;
  RC_ASSERT(std::abs(s.x[0] - truth[0]) <= bound);
  RC_ASSERT(std::abs(s.x[1] - truth[1]) <= bound * (1 + w + problem.frequency));
}

// ------------------------------------------------------------ orders

double error_of(const DrivenDuffing& problem, const State<2>& truth, double end, const Mtl& method) {
  const auto s = run(problem, {1, 0}, 0, end, method);
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  return oracle::distance(s.x, truth);
}

// x'' + 0.1 x' + x + x^3 = cos t to t = 12: the order from the last of some halvings, all errors above 1e-12.
TEST(Mtl, ObservedOrders) {
  const DrivenDuffing problem{.damping = 0.1};
  const problems::ReferenceTrajectory<long double, DrivenDuffing> reference(problem, {1, 0}, 0, 12);
  ASSERT_TRUE(reference.status().ok());
  const State<2> truth = reference(12).cast<double>();
  for (const MtlLinear linear : {MtlLinear::given, MtlLinear::zero, MtlLinear::jacobian}) {
    for (int p = 1; p <= 6; ++p) {
      const int steps = p < 3 ? 960 : p < 6 ? 480 : 240;
      const double coarse =
          error_of(problem, truth, 12, {.step = 12. / steps, .points = p, .linear = linear});
      const double fine = error_of(problem, truth, 12, {.step = 6. / steps, .points = p, .linear = linear});
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
  const DrivenDuffing problem{.damping = 0.1};
  const problems::ReferenceTrajectory<long double, DrivenDuffing> reference(problem, {1, 0}, 0, 12);
  const State<2> truth = reference(12).cast<double>();
  for (const int p : {1, 3, 4}) {
    const Mtl coarse{.step = 0.01, .points = p, .basis = MtlBasis::interpolet};
    Mtl fine = coarse;
    fine.step = 0.005;
    EXPECT_NEAR(std::log2(error_of(problem, truth, 12, coarse) / error_of(problem, truth, 12, fine)), 2,
                0.02);
  }
}

// With straight lines a step depends on the one before alone, however many are solved at once.
TEST(Mtl, InterpoletsOfThreePointsAreThreeStepsOfOne) {
  const DrivenDuffing problem{.damping = 0.1};
  const auto one = run(problem, {1, 0}, 0, 3, {.step = 0.1, .points = 1, .basis = MtlBasis::interpolet});
  const auto three = run(problem, {1, 0}, 0, 3, {.step = 0.1, .points = 3, .basis = MtlBasis::interpolet});
  EXPECT_NEAR(one.x[0], three.x[0], 100 * eps);
  EXPECT_NEAR(one.x[1], three.x[1], 100 * eps);
}

// First order in form: Lorenz's equations, which name no linear part, are equidistant collocation.
TEST(Mtl, FirstOrderProblems) {
  const problems::Lorenz problem;
  const problems::ReferenceTrajectory<long double, problems::Lorenz> reference(
      problem, problems::Lorenz::initial_state().cast<long double>(), 0, 1);
  const State<3> truth = reference(1).cast<double>();
  const auto error = [&](double h) {
    const auto s = integrate(System(problem), problems::Lorenz::initial_state(), 0, 1, Mtl{.step = h});
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    return oracle::distance(s.x, truth);
  };
  EXPECT_NEAR(std::log2(error(1. / 300) / error(1. / 600)), 4, 0.1);
}

// The linear part and the load are solved exactly, so a weak nonlinearity is all there is of an error: it
// goes with the hardening.
TEST(Mtl, ErrorGoesWithTheNonlinearity) {
  const auto error = [](double hardening) {
    const DrivenDuffing problem{.damping = 0.1, .hardening = hardening};
    const problems::ReferenceTrajectory<long double, DrivenDuffing> reference(problem, {1, 0}, 0, 6);
    return error_of(problem, reference(6).cast<double>(), 6, {.step = 0.2, .points = 3});
  };
  EXPECT_NEAR(error(1e-3) / error(1e-4), 10, 0.2);
}

// ------------------------------------------------------------ more degrees of freedom

// Two masses that move as one, or against each other, are Duffing oscillators with the stiffness 1 or 1 + 2
// s.
TEST(Mtl, TwoDegreesOfFreedom) {
  const TwoDof problem{.damping = 0, .coupling = 0.5, .force = 0};
  for (const int sign : {1, -1}) {
    const problems::Duffing mode{.natural_frequency = sign > 0 ? 1 : std::sqrt(2.), .hardening = 1};
    const State<2> truth = oracle::duffing(5, mode);
    const auto s = integrate(System(problem), State<4>(1, sign, 0, 0), 0, 5, Mtl{.step = 0.01, .points = 5});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    // Order 6, of the size of (w h)^6 = 1e-12 a period, and 100 blocks of roundings.
    EXPECT_NEAR(s.x[0], truth[0], 1e-10);
    EXPECT_NEAR(s.x[2], truth[1], 1e-10);
    EXPECT_NEAR(s.x[1], sign * truth[0], 1e-10);
    EXPECT_NEAR(s.x[3], sign * truth[1], 1e-10);
  }
}

// Compiled for a size that only the running program knows, or with the problem inlined: the same method.
TEST(Mtl, DynamicSizeAndInlinedProblem) {
  const TwoDof problem;
  const State<4> x0 = TwoDof::initial_state();
  const Mtl method{.step = 0.05, .points = 3};
  const auto fixed = integrate(System(problem), x0, 0, 5, method);
  const auto free = integrate(System<Eigen::Dynamic>(problem), State<Eigen::Dynamic>(x0), 0, 5, method);
  const auto inlined = integrate(Direct(problem), x0, 0, 5, method);
  ASSERT_TRUE(fixed.status.ok()) << fixed.status.text();
  EXPECT_NEAR(oracle::distance(fixed.x, State<4>(free.x)), 0, 200 * eps);
  EXPECT_NEAR(oracle::distance(fixed.x, inlined.x), 0, 200 * eps);
}

// ------------------------------------------------------------ what is conserved

// There and back: time-symmetric with a fixed linear part, and not with one taken at the begin of a block.
TEST(Mtl, SymmetricInTime) {
  const DrivenDuffing problem;
  const auto gap = [&](MtlLinear linear, int p) {
    const Mtl method{.step = 0.1, .points = p, .linear = linear};
    const auto there = run(problem, {1, 0}, 0, 6, method);
    const auto back = run(problem, there.x, 6, 0, method);
    EXPECT_TRUE(there.status.ok() && back.status.ok());
    return oracle::distance(back.x, State<2>(1, 0));
  };
  for (int p = 1; p <= 6; ++p) {
    // Roundings of 120 steps, which the motion amplifies some ten times.
    EXPECT_LE(gap(MtlLinear::given, p), 1e4 * eps) << p;
    EXPECT_LE(gap(MtlLinear::zero, p), 1e4 * eps) << p;
  }
  EXPECT_GT(gap(MtlLinear::jacobian, 3), 1e-8);
}

// det - 1 of the derivative of one block of x'' + x + x^3 = 0, h = 0.1, at (1, 0.3), by central differences;
// values of an independent program, two digits.
TEST(Mtl, BlocksAreNotSymplectic) {
  const DrivenDuffing problem{.force = 0};
  const auto determinant = [&](int p) {
    const Mtl method{.step = 0.1, .points = p};
    const double d = 1e-5;
    Eigen::Matrix2d m;
    for (int i = 0; i < 2; ++i) {
      const State<2> change = d * State<2>::Unit(i), x(1, 0.3);
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
  const DrivenDuffing problem{.damping = 0.1};
  const problems::ReferenceTrajectory<long double, DrivenDuffing> reference(problem, {1, 0}, 0, 6);
  double worst = 0, at_points = 0;
  State<2> x;
  const auto observe = [&](const Step<2>& step) {
    EXPECT_EQ(step.times.size(), 4U);
    for (std::size_t i = 0; i < step.times.size(); ++i) {
      step.dense.at(step.times[i], x);
      at_points =
          std::max(at_points, oracle::distance(x, State<2>(step.states.col(static_cast<Eigen::Index>(i)))));
    }
    for (int i = 0; i <= 40; ++i) {
      const double t = step.t0 + (step.t1 - step.t0) * i / 40;
      step.dense.at(t, x);
      worst = std::max(worst, oracle::distance(x, State<2>(reference(t).cast<double>())));
    }
    return true;
  };
  const auto s = integrate(System(problem), State<2>(1, 0), 0, 6, Mtl{.step = 0.05, .points = 4}, observe);
  ASSERT_TRUE(s.status.ok());
  EXPECT_EQ(at_points, 0);
  // The error at the ends, and h^5 for the interpolation within.
  EXPECT_LE(worst, 4 * oracle::distance(s.x, State<2>(reference(6).cast<double>())) + std::pow(0.05, 5));
}

// An oscillation of which the block sees many periods is there between the points.
TEST(Mtl, DenseOutputOfAFastOscillation) {
  const LinearOscillator problem{.natural_frequency = 100};
  double worst = 0;
  State<2> x;
  const auto observe = [&](const Step<2>& step) {
    for (int i = 1; i < 20; ++i) {
      const double t = step.t0 + (step.t1 - step.t0) * i / 20;
      step.dense.at(t, x);
      worst = std::max(worst, std::abs(x[0] - std::cos(100 * t)));
    }
    return true;
  };
  static_cast<void>(integrate(System(problem), State<2>(1, 0), 0, 6, Mtl{.step = 0.5, .points = 3}, observe));
  EXPECT_LE(worst, 20 * 600 * eps);  // 600 rad, each rounded
}

}  // namespace
}  // namespace nlmech::ivp
