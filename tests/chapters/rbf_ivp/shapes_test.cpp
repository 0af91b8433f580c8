/// The arcs on which shapes are judged.
#include <gtest/gtest.h>

#include "chapters/rbf_ivp/shapes/arcs.hpp"
#include "nlmech/problems/duffing.hpp"

namespace nlmech::chapters::rbf_ivp::shapes_test {
namespace {

// After a period the motion is where it was; after half of one it is mirrored.
TEST(DuffingArc, IsPeriodic) {
  const collocation::Sampled whole = duffing_arc(5, 1, 1.1), half = duffing_arc(5, 0.5, 1.1);
  EXPECT_NEAR(whole.values[4], whole.values[0], 4e-16);  // amplitude 1, rounded twice
  EXPECT_NEAR(whole.slopes[4], whole.slopes[0], 4e-15);  // of size 5
  EXPECT_NEAR(half.values[4], -half.values[0], 4e-16);
  EXPECT_NEAR(half.slopes[4], -half.slopes[0], 4e-15);
}

// The slopes are those of the values: polynomials of degree 59 are good for 7e-15 on one period; the
// rounding of values is magnified by |D|, 2400, times a few. oracle: rbf_ivp_shapes N = 60 polynomials
TEST(DuffingArc, HasTheSlopesOfItsValues) {
  constexpr double truncation = 7.04e-15;
  const collocation::Sampled arc = duffing_arc(60, 1, 1.1);
  EXPECT_LT(collocation::slope_error(arc, 0) / arc.slopes.cwiseAbs().maxCoeff(), truncation + 2e-12);
}

// A step of half a period earlier is the same arc mirrored: the same shape suits it.
TEST(DuffingArc, MirroredAsksForTheSameShape) {
  const double half = problems::Duffing().period(1.0) / 2;
  const auto here = collocation::choose_shape(duffing_arc(9, 0.25, 1.1 + half), 0.5, 10, 12);
  const auto mirrored = collocation::choose_shape(duffing_arc(9, 0.25, 1.1), 0.5, 10, 12);
  EXPECT_NEAR(here.shape / mirrored.shape, 1, 2e-3);  // as far as the refinement goes
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::shapes_test
