/// Worked example of the API reference: what a computation of this library returns.
#include <gtest/gtest.h>

// [example]
#include <cmath>
#include <limits>
#include <string>

#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

// A result with its status and cost, as all computations return it.
struct Root {
  double value = 1;
  nlmech::Status status;
  nlmech::Statistics statistics;
};

// The square root of a, by Heron's rule.
Root square_root(double a, int most) {
  Root root;
  while (std::abs(root.value * root.value - a) > 4 * std::numeric_limits<double>::epsilon() * a) {
    if (root.statistics.steps == most) {
      const std::string sentence = "square_root: no end after " + std::to_string(most) + " steps; allow more";
      root.status = nlmech::Status::failure(nlmech::Outcome::step_limit, sentence);
      break;
    }
    root.value = (root.value + a / root.value) / 2;
    ++root.statistics.steps;
  }
  return root;
}
// [example]

namespace {

TEST(Example, Support) {
  const Root good = square_root(2, 20);
  EXPECT_TRUE(good.status.ok()) << good.status.text();
  EXPECT_NEAR(good.value, std::sqrt(2.0), 4 * std::numeric_limits<double>::epsilon());
  const Root bad = square_root(2, 3);
  EXPECT_EQ(bad.status.text(), "step_limit: square_root: no end after 3 steps; allow more");
  EXPECT_EQ(bad.statistics.steps, 3);
}

}  // namespace
