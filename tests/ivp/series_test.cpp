/// The Taylor series method: fixed and chosen steps, tape and inlined, extremes and refusals.
#include "nlmech/ivp/series.hpp"

#include <gtest/gtest.h>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp {
namespace {

using testing::eps;
using testing::Manufactured;
using testing::reference;
using testing::with_tolerance;

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

}  // namespace
}  // namespace nlmech::ivp
