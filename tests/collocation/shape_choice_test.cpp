#include "nlmech/collocation/radial/shape_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/collocation/radial/radial_basis.hpp"
#include "nlmech/collocation/radial/shape.hpp"
#include "tests/collocation/real.hpp"

namespace nlmech::collocation::shape_choice_test {
namespace {

using oracle::eps;
using oracle::lgl_times;
using oracle::Real;
using oracle::refusal;

/// f and f' at LGL nodes of [0, 1].
template <class F, class G>
Sampled sampled(int n, F&& f, G&& slope) {
  Sampled s{lgl_times(n), {}, {}};
  s.values = s.times.unaryExpr(f);
  s.slopes = s.times.unaryExpr(slope);
  return s;
}

// A Gaussian at a node is in the span for its own shape and for no other: the error vanishes there.
TEST(ChooseShape, FindsTheShapeOfAGaussian) {
  const double c = 2.3, centre = lgl_times(7)[2];
  const Sampled s = sampled(
      7, [=](double t) { return std::exp(-std::pow(c * (t - centre), 2)); },
      [=](double t) { return -2 * c * c * (t - centre) * std::exp(-std::pow(c * (t - centre), 2)); });
  const ShapeChoice choice = choose_shape(s, 0.05, 30);
  EXPECT_NEAR(choice.shape, c, 2e-3 * c);   // the refinement ends at 1e-3
  EXPECT_LT(slope_error(s, c), 200 * eps);  // |D| is 30 here
  EXPECT_LE(choice.error, slope_error(s, 0));
}

// Polynomials of degree < n are differentiated exactly at c = 0 alone.
TEST(ChooseShape, PrefersPolynomialsForPolynomials) {
  const Sampled s = sampled(
      6, [](double t) { return 1 + t * t * t; }, [](double t) { return 3 * t * t; });
  const ShapeChoice choice = choose_shape(s, 0.01, 30);
  EXPECT_EQ(choice.shape, 0);
  EXPECT_LT(choice.error, 100 * eps);
}

// Never worse than any of its candidates.
TEST(ChooseShape, IsTheLeastOfItsSamples) {
  const Sampled s = sampled(
      9, [](double t) { return std::sin(5 * t + 1); }, [](double t) { return 5 * std::cos(5 * t + 1); });
  const ShapeChoice choice = choose_shape(s, 0.1, 10, 20);
  EXPECT_DOUBLE_EQ(choice.error, slope_error(s, choice.shape));
  for (int k = 0; k < 20; ++k)
    EXPECT_LE(choice.error, slope_error(s, 0.1 * std::pow(100, k / 19.0)) * (1 + 1e-9)) << k;
  EXPECT_LE(choice.error, slope_error(s, 0));
}

TEST(ChooseShape, RefusesWhatItCannotSearch) {
  Sampled s = sampled(
      5, [](double t) { return t; }, [](double) { return 1.0; });
  EXPECT_EQ(refusal([&] { (void)choose_shape(s, 0, 1); }),
            "choose_shape: the shapes must ascend from above 0, are 0 to 1");
  EXPECT_NE(refusal([&] { (void)choose_shape(s, 2, 1); }), "");
  EXPECT_NE(refusal([&] { (void)choose_shape(s, 2, INFINITY); }), "");
  EXPECT_EQ(refusal([&] { (void)choose_shape(s, 1, 2, 2); }),
            "choose_shape: needs at least 3 samples, is given 2");
  s.slopes[1] = NAN;
  EXPECT_EQ(refusal([&] { (void)slope_error(s, 1); }), "slope_error: a value or a slope is not finite");
  s.slopes.resize(3);
  EXPECT_EQ(refusal([&] { (void)slope_error(s, 1); }), "slope_error: 5 times have 5 values and 3 slopes");
}

// The definition with 50 digits, at conditions that they bear.
TEST(ExactLeaveOneOutCost, IsTheCostWithoutRounding) {
  for (const int n : {3, 7, 15}) {
    for (const double shape : {0.5, 2., 8.}) {
      if (n == 15 && shape < 1) continue;  // condition 1e28
      const RadialBasis<Real> basis(lgl_times(n).cast<Real>(), Kernel::gaussian, Real(shape));
      const Matrix<Real> D = basis.differentiation_matrix(), inverse = basis.inverse();
      Real sum = 0;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) sum += D(j, i) * D(j, i) / (inverse(i, i) * inverse(i, i));
      }
      const double truth = oracle::to_double(sqrt(sum));
      EXPECT_NEAR(exact_leave_one_out_cost(lgl_times(n), shape) / truth, 1, 1e-9) << n << ' ' << shape;
    }
  }
}

// 1/(Phi^-1)_ii falls as c^(2n - 2), and D tends to that of polynomials.
TEST(ExactLeaveOneOutCost, HasNoMinimumAtTheWideEnd) {
  const int n = 7;
  const double a = exact_leave_one_out_cost(lgl_times(n), 0.02),
               b = exact_leave_one_out_cost(lgl_times(n), 0.01);
  EXPECT_NEAR(std::log2(a / b), 2 * n - 2, 1e-3);
  // Rounding makes the cost of Algorithm 1 larger by orders of magnitude there.
  EXPECT_GT(leave_one_out_cost(lgl_times(n), Kernel::gaussian, 0.02), 1e4 * a);
  EXPECT_EQ(exact_leave_one_out_cost(lgl_times(n), 1e-12), 0);
  EXPECT_NE(refusal([] { (void)exact_leave_one_out_cost(lgl_times(3), 0); }), "");
}

}  // namespace
}  // namespace nlmech::collocation::shape_choice_test
