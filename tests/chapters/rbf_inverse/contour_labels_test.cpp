/// Positions of the labels of contour lines.
#include "chapters/rbf_inverse/lambert/contour_labels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace nlmech::contour_labels_test {

using chapters::rbf_inverse::contour_labels;
using chapters::rbf_inverse::ContourLabel;
using chapters::rbf_inverse::GridValues;

/// x^2 + y^2 on [-2, 2] x [-2, 2]; none where x > 1.5.
GridValues bowl() {
  GridValues grid;
  for (int i = 0; i <= 80; ++i) {
    grid.x.push_back(-2 + i / 20.);
    grid.y.push_back(-2 + i / 20.);
  }
  for (const double x : grid.x) {
    for (const double y : grid.y)
      grid.values.push_back(x > 1.5 ? std::numeric_limits<double>::quiet_NaN() : x * x + y * y);
  }
  return grid;
}

TEST(ContourLabels, StandOnTheirLineAndOnNothingElse) {
  constexpr double character = 0.02, height = 0.04;
  const std::vector<ContourLabel> labels = contour_labels(bowl(), {0.25, 1, 2.25}, character, height);
  ASSERT_EQ(labels.size(), 3);
  for (const ContourLabel& label : labels) {
    // Linear between points 0.05 apart: within 0.05^2 / 4 of a parabola.
    EXPECT_NEAR(label.x * label.x + label.y * label.y, label.level, 0.05 * 0.05 / 4 + 1e-12);
    EXPECT_LT(label.x, 1.5 - 2 * character) << "half a label of 1.5 characters at least from the edge";
    EXPECT_LT(std::abs(label.y), 2 - 2 * height);
  }
}

TEST(ContourLabels, LeaveOutWhatHasNoRoom) {
  // Circles of radius 1 and 1.02 are a tenth of a label apart; the circle of 0.5 is isolated.
  const std::vector<ContourLabel> labels = contour_labels(bowl(), {0.25, 1, 1.04}, 0.05, 0.1);
  ASSERT_EQ(labels.size(), 1);
  EXPECT_EQ(labels[0].level, 0.25);
}

TEST(ContourLabels, ThereAreNoneOfLevelsOutside) {
  EXPECT_TRUE(contour_labels(bowl(), {-1, 9}, 0.02, 0.04).empty());
}

}  // namespace nlmech::contour_labels_test
