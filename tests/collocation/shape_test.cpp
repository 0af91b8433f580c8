#include "nlmech/collocation/radial/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/collocation/radial/radial_basis.hpp"
#include "tests/collocation/real.hpp"

namespace nlmech::collocation::shape_test {
namespace {

using oracle::eps;
using oracle::lgl_times;
using oracle::refusal;

// What Eqs 4.18 and 4.20 abbreviate, done at length: leave node i out, interpolate the others, look at node
// i.
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
      // Conditions are below 1e4 here; the cost is of the size of the data.
      EXPECT_NEAR(leave_one_out_cost(lgl_times(7), kernel, shape) / exact, 1, 1e4 * 10 * eps)
          << to_string(kernel) << ' ' << shape;
    }
  }
}

// Findings of a study before this code: 1e-17 for n = 7 and c h = 80, where D is 0 and the error is 100 %.
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
  // All functions are 1: no inverse.
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

}  // namespace
}  // namespace nlmech::collocation::shape_test
