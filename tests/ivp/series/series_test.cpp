/// The Taylor series method: fixed and chosen steps.
#include "nlmech/ivp/series/series.hpp"

#include <gtest/gtest.h>

#include "tests/ivp/methods.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp::series_test {
namespace {

using testing::eps;
using testing::Manufactured;
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

}  // namespace
}  // namespace nlmech::ivp::series_test
