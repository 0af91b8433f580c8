/// The Taylor series method where a series has an end, a gap or coefficients out of range.
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp::series_extremes_test {
namespace {

using testing::with_tolerance;

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
    const auto look = [&](const Step& step) {
      EXPECT_LT(step.t1 - step.t0, 1 / step.x0[0]) << order;
      return true;
    };
    const auto s = integrate(System(Pole{}), State{1.0}, 0, 0.9, with_tolerance(1e-6, order), look);
    EXPECT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], 10, 1e-3) << order;
  }
}

TEST(Series, FixedStepsEndAtABlowUp) {
  EXPECT_FALSE(
      integrate(System(problems::TextProblem("blow-up")), State{1.0}, 0, 1, Series{.order = 20, .step = 0.01})
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
  const auto s = integrate(System(Gap{}), State{0.0}, 0, 2, with_tolerance(1e-9, 10));
  EXPECT_TRUE(s.status.ok());
  EXPECT_GT(s.statistics.rejected, 0);
  EXPECT_NEAR(s.x[0] / (std::pow(2, 21) / 21), 1, 1e-8);
  EXPECT_EQ(integrate(System(Gap{}), State{0.0}, 0, 2, with_tolerance(1e-9, 23)).statistics.steps, 1);
}

// Coefficient 40 of cos(1e9 t) is 1e360/40!: it is kept in units of the step.
TEST(Series, CoefficientsBeyondTheRangeOfDouble) {
  const testing::Oscillator fast{.frequency = 1e9};
  for (const int order : {20, 40, 100}) {
    const auto s = integrate(System(fast), State{1, 0}, 0, 1e-8, with_tolerance(1e-12, order));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_NEAR(s.x[0], std::cos(10), 1e-10) << order;
  }
}

}  // namespace
}  // namespace nlmech::ivp::series_extremes_test
