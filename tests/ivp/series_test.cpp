/// The Taylor series method: fixed and chosen steps, tape and inlined, extremes and refusals.
#include "nlmech/ivp/series.hpp"

#include <gtest/gtest.h>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp {
namespace {

using testing::eps;
using testing::infinity;
using testing::Manufactured;
using testing::nan;

Series with_tolerance(double tolerance, int order = 0) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance, .order = order};
}

template <class Problem>
State<Problem::dimension> reference(const Problem& problem, const State<Problem::dimension>& x0, double t0,
                                    double t1) {
  const problems::ReferenceTrajectory<long double, Problem> path(problem, x0.template cast<long double>(), t0,
                                                                 t1);
  EXPECT_TRUE(path.status().ok()) << path.status().text();
  return path(t1).template cast<double>();
}

// Steps of length h with N terms: error h^N. The errors of the finer run are above 1e-11, rounding below
// 1e-13.
TEST(Series, FixedStepsHaveTheOrderOfTheSeries) {
  const Manufactured problem;
  for (const int order : {2, 3, 4, 5, 6, 8}) {
    const auto error = [&](double steps) {
      return testing::largest_error(problem, Series{.order = order, .step = 2 / steps}, 0, 2, true);
    };
    const double steps = order < 6 ? 32 : 12;
    EXPECT_NEAR(std::log2(error(steps) / error(2 * steps)), order, 0.25) << order;
  }
}

// The norm of the last terms is the tolerance for every step; a step adds less than that, the tolerance times
// the next term's share, and ten units of time of a damped motion sum them.
TEST(Series, MeetsItsTolerance) {
  const Manufactured problem;
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    for (const int order : {0, 12, 30}) {
      const double error = testing::largest_error(problem, with_tolerance(tolerance, order), 0, 10, true);
      EXPECT_LE(error, 20 * tolerance + 40 * eps) << tolerance << ", order " << order;
    }
  }
}

// Both sum the same series in another order.
TEST(Series, InlinedAndTapedAgree) {
  const problems::ThreeMassChain chain;
  const State<6> x0(0.1, -0.2, 0.3, 0, 0.1, 0);
  const auto inlined = integrate(Direct(chain), x0, 0, 30, with_tolerance(1e-13));
  const auto taped = integrate(System(chain), x0, 0, 30, with_tolerance(1e-13));
  const auto dynamic = integrate(System<Eigen::Dynamic>(chain), x0, 0, 30, with_tolerance(1e-13));
  EXPECT_TRUE(inlined.status.ok() && taped.status.ok() && dynamic.status.ok());
  EXPECT_EQ(taped.x, dynamic.x);
  EXPECT_LT((inlined.x - taped.x).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((inlined.x - reference(chain, x0, 0, 30)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(inlined.statistics.steps, taped.statistics.steps);
}

TEST(Series, ComesOutTheSameEveryTime) {
  for (int run = 0; run < 2; ++run) {
    const System system(problems::Lorenz{});
    const auto one = integrate(system, State<3>(0, 1, 0), 0, 20, Series{});
    const auto two = integrate(system, State<3>(0, 1, 0), 0, 20, Series{});
    EXPECT_EQ(one.x, two.x);
  }
}

// mpfr, 70 digits. Errors grow by exp(0.9 20) = 6.6e7: rounding of some hundred steps of size 20 leaves 1e-6
// at worst; 8/3 as a double alone moves the end by 1e-9.
TEST(Series, LorenzToTwenty) {
  const problems::Lorenz lorenz;
  const State<3> truth(-1.356348984580380, -2.387300052277071, 12.38998499408597);
  const auto s = integrate(Direct(lorenz), State<3>(0, 1, 0), 0, 20, with_tolerance(1e-15));
  EXPECT_LT((s.x - truth).cwiseAbs().maxCoeff(), 1e-8);
  const auto taped = integrate(System(lorenz), State<3>(0, 1, 0), 0, 20, with_tolerance(1e-15));
  EXPECT_LT((taped.x - truth).cwiseAbs().maxCoeff(), 1e-8);
}

// The printed settings, T = 0.1 and N = 20, step over the radius of convergence, 0.119 at its least: wrong by
// more than 0.1 after half a unit of time (findings: 0.83), and by more than 1 at the end. Chosen steps are
// not.
TEST(Series, StepsBeyondTheRadiusOfConvergenceShowTheirError) {
  const problems::Lorenz lorenz;
  const State<3> x0(0, 1, 0), truth = reference(lorenz, x0, 0, 0.5);
  const auto printed = integrate(System(lorenz), x0, 0, 0.5, Series{.order = 20, .step = 0.1});
  EXPECT_TRUE(printed.status.ok());
  EXPECT_GT((printed.x - truth).cwiseAbs().maxCoeff(), 0.1);
  const auto chosen = integrate(System(lorenz), x0, 0, 0.5, with_tolerance(1e-9, 20));
  EXPECT_LT((chosen.x - truth).cwiseAbs().maxCoeff(), 1e-7);
  const auto fine = integrate(System(lorenz), x0, 0, 0.5, Series{.order = 20, .step = 0.01});
  EXPECT_LT((fine.x - truth).cwiseAbs().maxCoeff(), 1e-11);
}

// mpfr, 70 digits. T = 0.5 blows up, as the findings say; T = 0.1 is exact to 2e-12 times a few.
TEST(Series, ForcedDuffing) {
  const problems::ForcedDuffing duffing;
  const State<2> x0(3, 4), truth(1.221946638567542, 5.565479787665349);
  const auto wild = integrate(System(duffing), x0, 0, 50, Series{.order = 20, .step = 0.5});
  EXPECT_FALSE(wild.status.ok() && (wild.x - truth).cwiseAbs().maxCoeff() < 1);
  EXPECT_TRUE(wild.x.allFinite());
  const auto tame = integrate(System(duffing), x0, 0, 50, Series{.order = 20, .step = 0.1});
  EXPECT_LT((tame.x - truth).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(tame.statistics.steps, 500);
  EXPECT_EQ(tame.statistics.right_hand_sides, 500 * 20);
  EXPECT_LT((integrate(Direct(duffing), x0, 0, 50, with_tolerance(1e-14)).x - truth).cwiseAbs().maxCoeff(),
            1e-11);
}

// mpfr, 70 digits; printed T = 0.125, N = 50 (through the tape): 7e-11 at twice the time.
TEST(Series, StronglyNonlinearOscillator) {
  const problems::StrongOscillator oscillator;
  const double t0 = problems::StrongOscillator::initial_time;
  const State<2> truth(-0.302938936512582, -0.198146428424553);
  for (const Series& method : {Series{.order = 50, .step = 0.125}, with_tolerance(1e-14)}) {
    const auto s = integrate(Direct(oscillator), State<2>(-0.5, 0), t0, t0 + 375, method);
    EXPECT_TRUE(s.status.ok());
    EXPECT_LT((s.x - truth).cwiseAbs().maxCoeff(), 7e-11);
  }
}

// x' = x^2 has the radius of convergence 1/x.
struct Pole {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T&, const Vector<T, 1>& x, Vector<T, 1>& f) const {
    f[0] = x[0] * x[0];
  }
};

TEST(Series, NoChosenStepIsLongerThanTheRadiusOfConvergence) {
  for (const int order : {2, 8, 20, 40, 100}) {
    const auto look = [&](const Step<1>& step) {
      EXPECT_LT(step.t1 - step.t0, 1 / step.x0[0]) << order;
      return true;
    };
    const auto s = integrate(System(Pole{}), State<1>(1.0), 0, 0.9, with_tolerance(1e-6, order), look);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], 10, 1e-3) << order;
  }
}

TEST(Series, BlowUpEndsInAStatus) {
  for (const int order : {0, 40, 100}) {
    const auto s = integrate(System(problems::BlowUp{}), State<1>(1.0), 0, 1, with_tolerance(1e-9, order));
    EXPECT_FALSE(s.status.ok());
    EXPECT_NE(s.status.sentence().find("series"), std::string::npos);
    EXPECT_TRUE(s.x.allFinite());
    EXPECT_NEAR(s.t, 0.5, 1e-6) << s.status.text();
  }
  EXPECT_FALSE(integrate(System(problems::BlowUp{}), State<1>(1.0), 0, 1, Series{.order = 20, .step = 0.01})
                   .status.ok());
}

// Taylor in quadruple precision: x(200) = 1.718587208019240655 for mu = 100.
TEST(Series, VanDerPol) {
  const auto s =
      integrate(Direct(problems::VanDerPol{.mu = 100}), State<2>(2, 0), 0, 200, with_tolerance(1e-12));
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], 1.718587208019240655, 1e-11);
  const auto stiff =
      integrate(System(problems::VanDerPol{.mu = 1000}), State<2>(2, 0), 0, 20, with_tolerance(1e-9));
  EXPECT_TRUE(stiff.status.ok()) << stiff.status.text();
  EXPECT_GT(stiff.statistics.steps, 1000);  // bound by stability: steps of some 0.005
  EXPECT_NEAR(stiff.x[0], reference(problems::VanDerPol{.mu = 1000}, State<2>(2, 0), 0, 20)[0], 1e-9);
}

// From t = 0 the series of x' = t^20 to order 10 is zero: the slope at the end gives it away.
struct Gap {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>&, Vector<T, 1>& f) const {
    using std::pow;
    f[0] = pow(t, 20);
  }
};

TEST(Series, DoesNotTakeAGapForAPolynomial) {
  const auto s = integrate(System(Gap{}), State<1>(0.0), 0, 2, with_tolerance(1e-9, 10));
  EXPECT_TRUE(s.status.ok());
  EXPECT_GT(s.statistics.rejected, 0);
  EXPECT_NEAR(s.x[0] / (std::pow(2, 21) / 21), 1, 1e-8);
  EXPECT_EQ(integrate(System(Gap{}), State<1>(0.0), 0, 2, with_tolerance(1e-9, 23)).statistics.steps, 1);
}

// Coefficient 40 of cos(1e9 t) is 1e360/40!: it is kept in units of the step.
TEST(Series, CoefficientsBeyondTheRangeOfDouble) {
  const testing::Oscillator fast{.frequency = 1e9};
  for (const int order : {20, 40, 100}) {
    const auto s = integrate(System(fast), State<2>(1, 0), 0, 1e-8, with_tolerance(1e-12, order));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], std::cos(10), 1e-10) << order;
  }
}

TEST(Series, CloseEncounterOfFourBodies) {
  const problems::FourBodies bodies;
  const auto x0 = problems::FourBodies::initial_state();
  const auto s = integrate(System(bodies), x0, 0, 3000, with_tolerance(1e-14));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  // Errors of 1e-16 grow to 1e-12 by t = 3000; those of a hundred steps to some 1e-10.
  EXPECT_NEAR(s.x[9], -0.2510470313435667, 1e-9);
  EXPECT_NEAR(s.x[10], 3.071464269641001, 1e-9);
  EXPECT_NEAR(s.x[0], 1.882222659858648, 1e-9);
  const auto inner = integrate(Direct(bodies), x0, 0, 3000, with_tolerance(1e-14));
  EXPECT_EQ(inner.x, s.x);  // twenty-four components are left to the tape
}

}  // namespace
}  // namespace nlmech::ivp
