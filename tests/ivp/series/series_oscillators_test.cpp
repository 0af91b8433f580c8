/// The Taylor series method on oscillators that are strongly nonlinear or stiff, against computations in more
/// digits.
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp::series_oscillators_test {
namespace {

using testing::reference;
using testing::with_tolerance;

// mpfr, 70 digits; printed T = 0.125, N = 50 (through the tape): 7e-11 at twice the time.
TEST(SeriesOnProblems, StronglyNonlinearOscillator) {
  const problems::TextProblem oscillator("oscillator");
  const double t0 = oscillator.initial_time;
  const State truth{-0.302938936512582, -0.198146428424553};
  for (const Series& method : {Series{.order = 50, .step = 0.125}, with_tolerance(1e-14)}) {
    const auto s = integrate(System(oscillator), State{-0.5, 0}, t0, t0 + 375, method);
    EXPECT_TRUE(s.status.ok());
    EXPECT_LT((s.x - truth).cwiseAbs().maxCoeff(), 7e-11);
  }
}

// Taylor in quadruple precision: x(200) = 1.718587208019240655 for mu = 100.
TEST(SeriesOnProblems, VanDerPol) {
  const auto s = integrate(System(problems::TextProblem("van-der-pol", {{"mu", 100}})), State{2, 0}, 0, 200,
                           with_tolerance(1e-12));
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], 1.718587208019240655, 1e-11);
  const auto stiff = integrate(System(problems::TextProblem("van-der-pol", {{"mu", 1000}})), State{2, 0}, 0,
                               20, with_tolerance(1e-9));
  EXPECT_TRUE(stiff.status.ok()) << stiff.status.text();
  EXPECT_GT(stiff.statistics.steps, 1000);  // bound by stability: steps of some 0.005
  EXPECT_NEAR(stiff.x[0],
              reference(problems::TextProblem("van-der-pol", {{"mu", 1000}}), State{2, 0}, 0, 20)[0], 1e-9);
}

}  // namespace
}  // namespace nlmech::ivp::series_oscillators_test
