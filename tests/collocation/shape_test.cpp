/// Choice of a shape parameter: leave-one-out cost, rule of thumb, and the smallest error of a known slope.

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/collocation/radial/radial_basis.hpp"
#include "nlmech/collocation/radial/shape_choice.hpp"
#include "tests/collocation/real.hpp"

namespace nlmech::collocation::shape_test {
namespace {

using namespace oracle;

// Eqs 4.18 and 4.20 by their definition: omit node i, interpolate at the others, evaluate at node i.
double cost_by_leaving_out(const Eigen::VectorXd& times, Kernel kernel, double shape) {
  const RadialBasis<double> all(times, kernel, shape);
  const Eigen::MatrixXd data = all.derivatives().transpose();
  const Eigen::Index n = times.size();
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::VectorXd others(n - 1);
    Eigen::MatrixXd values(n - 1, n);
    others << times.head(i), times.tail(n - 1 - i);
    values << data.topRows(i), data.bottomRows(n - 1 - i);
    RowVector<double> row;
    RadialBasis<double>(others, kernel, shape).row(times[i], row);
    sum += (data.row(i) - row * values).squaredNorm();
  }
  return std::sqrt(sum);
}

TEST(LeaveOneOutCost, IsTheErrorAtTheNodesLeftOut) {
  for (const Kernel kernel : {Kernel::gaussian, Kernel::inverse_quadratic, Kernel::multiquadric}) {
    for (const double shape : {3., 10.}) {
      const double exact = cost_by_leaving_out(lgl_times(7), kernel, shape);
      // Condition numbers are below 1e4 here; the cost is of the size of the data.
      EXPECT_NEAR(leave_one_out_cost(lgl_times(7), kernel, shape) / exact, 1, 1e4 * 10 * eps)
          << to_string(kernel) << ' ' << shape;
    }
  }
}

// Recorded: 1e-17 for n = 7 and c h = 80, where D is 0 and the error is 100 %.
TEST(LeaveOneOutCost, IsDegenerateForNarrowFunctions) {
  const double cost = leave_one_out_cost(lgl_times(7), Kernel::gaussian, 80);
  EXPECT_GT(cost, 0.5e-17);
  EXPECT_LT(cost, 5e-17);
  EXPECT_EQ(leave_one_out_cost(lgl_times(7), Kernel::gaussian, 1e6), 0);
}

TEST(LeaveOneOutCost, IsNeverNaN) {
  for (const int n : {2, 3, 7, 35}) {
    for (int exponent = -9; exponent <= 6; ++exponent) {
      const double cost = leave_one_out_cost(lgl_times(n), Kernel::gaussian, std::pow(10, exponent));
      EXPECT_GE(cost, 0) << n << ' ' << exponent;
    }
  }
  // All functions equal 1: there is no inverse.
  EXPECT_EQ(leave_one_out_cost(lgl_times(7), Kernel::gaussian, 1e-9), INFINITY);
}

// Tables 4.1 and 4.2: N = 35 on one period, c h = 8.5.
TEST(RuleOfThumb, IsThatOfTheDissertation) {
  EXPECT_DOUBLE_EQ(rule_of_thumb_shape(35, 4.7680220291) * 4.7680220291, 8.5);
  EXPECT_NE(refusal([] { (void)rule_of_thumb_shape(1, 1); }), "");
  EXPECT_NE(refusal([] { (void)rule_of_thumb_shape(7, 0); }), "");
  EXPECT_EQ(refusal([] { (void)rule_of_thumb_shape(7, -0.5); }),
            "rule_of_thumb_shape: needs at least 2 nodes and a positive, finite interval; has 7 nodes and an "
            "interval of -0.5");
}

TEST(LeaveOneOutCost, RefusesWhatIsNoBasis) {
  EXPECT_NE(refusal([] { (void)leave_one_out_cost(Eigen::VectorXd::Zero(1), Kernel::gaussian, 1); }), "");
  EXPECT_NE(refusal([] { (void)leave_one_out_cost(lgl_times(7), Kernel::gaussian, -1); }), "");
}

/// f and f' at LGL nodes of [0, 1].
template <class F, class G>
Sampled sampled(int n, F&& f, G&& slope) {
  Sampled s{lgl_times(n), {}, {}};
  s.values = s.times.unaryExpr(f);
  s.slopes = s.times.unaryExpr(slope);
  return s;
}

// A Gaussian at a node is in the span only for its own shape: the error is zero there.
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

// Polynomials of degree < n are differentiated exactly for c = 0 only.
TEST(ChooseShape, PrefersPolynomialsForPolynomials) {
  const Sampled s = sampled(
      6, [](double t) { return 1 + t * t * t; }, [](double t) { return 3 * t * t; });
  const ShapeChoice choice = choose_shape(s, 0.01, 30);
  EXPECT_EQ(choice.shape, 0);
  EXPECT_LT(choice.error, 100 * eps);
}

// Not worse than any of its candidates.
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

// The definition in 50 digits, for condition numbers that they allow.
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
      const double reference = oracle::to_double(sqrt(sum));
      EXPECT_NEAR(exact_leave_one_out_cost(lgl_times(n), shape) / reference, 1, 1e-9) << n << ' ' << shape;
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
}  // namespace nlmech::collocation::shape_test
