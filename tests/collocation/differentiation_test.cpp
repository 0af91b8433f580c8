#include "nlmech/collocation/differentiation.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "nlmech/collocation/barycentric.hpp"
#include "tests/collocation/real.hpp"
#include "tests/thrown.hpp"

namespace nlmech::collocation::differentiation_test {
namespace {

using namespace oracle;

constexpr double period = 4.7680220291024608;  // of the free Duffing oscillator of Table 4.1

/// The condition number of Phi in the 2-norm with 50 digits: power iteration for both ends of the spectrum.
double exact_condition(int n, double shape) {
  const RadialBasis<Real> basis(lgl_times(n).cast<Real>(), Kernel::gaussian, Real(shape));
  const auto largest = [n](const Matrix<Real>& M) {
    // All positive for Phi; alternating signs, as of the most oscillating eigenvector, for its inverse.
    Vector<Real> v(n);
    for (int i = 0; i < n; ++i) v[i] = M(0, 1) > 0 || i % 2 == 0 ? 1 : -1;
    Real norm = 0;
    for (int i = 0; i < 40; ++i) {
      v = M * v;
      norm = v.norm();
      v /= norm;
    }
    return norm;
  };
  return oracle::to_double(largest(basis.values()) * largest(basis.inverse()));
}

// Reciprocals: the distance from the nearest singular matrix, relative to the largest eigenvalue. 4e-16 as
// documented: half an eps for the rounded entries of Phi, the rest for the eigenvalues.
TEST(Differentiation, KnowsItsCondition) {
  for (const auto& [n, shape] : {std::pair{2, 1e-6},
                                 {3, 0.01},
                                 {7, 0.21875},
                                 {7, 0.25},
                                 {7, 0.367},
                                 {7, 4.},
                                 {15, 2.38},
                                 {35, 7.8},
                                 {35, 8.5},
                                 {35, 12.},
                                 {35, 40.}}) {
    const double exact = exact_condition(n, shape);
    const double condition = radial_differentiation(lgl_times(n), Kernel::gaussian, shape).condition;
    EXPECT_NEAR(1 / condition, 1 / exact, 4e-16) << n << ' ' << shape << ": " << exact;
  }
}

// Recorded values for the published runs: N = 7 with c = 0.77 on P/10 has 9.5e12, N = 35 with c h = 8.5 has
// 1.3e15, N = 7 with c = 0.35 on 0.625 has 5.5e15. Tolerance: half a unit of the last digit, and the effect
// of rounding on a condition number.
TEST(Differentiation, HasTheConditionsOfThePublishedRuns) {
  struct Published {
    int n;
    double shape, condition, half_digit;
  };
  for (const Published& p :
       {Published{7, 0.77 * period / 10, 9.5e12, 0.05e12}, Published{35, 8.5, 1.3e15, 0.05e15},
        Published{7, 0.35 * 0.625, 5.5e15, 0.05e15}}) {
    const Differentiation d = radial_differentiation(lgl_times(p.n), Kernel::gaussian, p.shape);
    EXPECT_TRUE(d.status.ok()) << d.status.text();
    const double rounding = 4e-16 * p.condition * p.condition;
    EXPECT_NEAR(d.condition, p.condition, p.half_digit + rounding) << p.n << ' ' << p.shape;
  }
}

// Recorded: "|D 1| = 5e-8 (N = 7, 0.367), 6.6e-5 (N = 35, 8.5)". Radial functions do not reproduce constants.
// The second value comes from a matrix with an error of 20 %; tolerance for rounding: 10 %.
TEST(Differentiation, OfAConstantIsNotZero) {
  const auto of_one = [](int n, double shape) {
    const Eigen::MatrixXd D = radial_differentiation(lgl_times(n), Kernel::gaussian, shape).matrix;
    return D.rowwise().sum().cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(of_one(7, 0.367), 5e-8, 0.5e-8);
  EXPECT_NEAR(of_one(35, 8.5), 6.6e-5, 0.66e-5);
}

/// The largest error of D x relative to the largest speed, for the free Duffing oscillator of Table 4.1,
/// x'' + x + x^3 = 0, x(0) = 1, that is x = cn(sqrt(2) t, k = 1/2), on the arc from t0 to t0 + h.
/// @param D for an interval of length 1
double arc_error(const Eigen::MatrixXd& D, double t0, double h) {
  const int n = static_cast<int>(D.rows());
  const Eigen::VectorXd times = lgl_times(n, h);
  Eigen::VectorXd x(n), v(n);
  for (int i = 0; i < n; ++i) {
    double cn = 0, dn = 0;
    const double sn = boost::math::jacobi_elliptic(0.5, std::sqrt(2.) * (t0 + times[i]), &cn, &dn);
    x[i] = cn;
    v[i] = -std::sqrt(2.) * sn * dn;
  }
  return (D * x / h - v).cwiseAbs().maxCoeff() / v.cwiseAbs().maxCoeff();
}

// Recorded: relative error of D x on an arc of length P/10, for N = 7. The start of the arc is not recorded;
// with 0.17 P all six numbers agree, one parameter for six values. Tolerance: half a unit of the last digit,
// and 2 % for the start.
TEST(Differentiation, OfADuffingArcHasTheErrorsFoundBefore) {
  struct Found {
    double shape, error, half_digit;
  };
  for (const Found& f : {Found{0, 1.9e-6, 0.05e-6}, Found{0.367, 9.9e-7, 0.05e-7}, Found{0.7, 9e-5, 0.5e-5},
                         Found{1, 8.7e-4, 0.05e-4}, Found{2, 3.9e-2, 0.05e-2}, Found{8.5, 3.2, 0.05}}) {
    const Eigen::VectorXd times = lgl_times(7);
    const Eigen::MatrixXd D = f.shape > 0 ? radial_differentiation(times, Kernel::gaussian, f.shape).matrix
                                          : polynomial_differentiation_matrix(times);
    EXPECT_NEAR(arc_error(D, 0.17 * period, period / 10), f.error, f.half_digit + 0.02 * f.error) << f.shape;
  }
}

// At N = 35, c h = 6 the inverse has an error of 240 %, the solution 6 digits.
TEST(Differentiation, ByTheInverseLosesAllDigits) {
  const auto error = [](Inversion inversion) {
    return arc_error(radial_differentiation(lgl_times(35), Kernel::gaussian, 6, inversion).matrix, 0, period);
  };
  EXPECT_LT(error(Inversion::solve), 1e-5);
  EXPECT_GT(error(Inversion::inverse), 0.1);
  // For a moderate condition number both agree to condition * eps.
  const Eigen::VectorXd times = lgl_times(7);
  const Differentiation solved = radial_differentiation(times, Kernel::gaussian, 2);
  const Differentiation inverted = radial_differentiation(times, Kernel::gaussian, 2, Inversion::inverse);
  EXPECT_LE((solved.matrix - inverted.matrix).norm(), 8 * eps * solved.condition * solved.matrix.norm());
  EXPECT_GT((solved.matrix - inverted.matrix).norm(), 0);
}

// The eigenvalues of wide functions decrease as (c h)^(2k), times decreasing numbers: below 1e-16 from k = 2
// on for c h = 1e-6, from k = 3 on for 1e-3.
TEST(Differentiation, CountsTheFunctionsThatCanBeToldApart) {
  const auto rank = [](int n, double shape) {
    return radial_differentiation(lgl_times(n), Kernel::gaussian, shape).rank;
  };
  EXPECT_EQ(rank(7, 1e-6), 2);
  EXPECT_EQ(rank(7, 1e-3), 3);
  EXPECT_EQ(rank(7, 0.367), 7);
  EXPECT_EQ(rank(35, 12), 35);
}

TEST(Differentiation, SaysWhatIsWrongAtBothEnds) {
  const Differentiation wide = radial_differentiation(lgl_times(7), Kernel::gaussian, 1e-6);
  EXPECT_EQ(wide.status.outcome(), Outcome::singular_matrix);
  EXPECT_TRUE(tests::holds(wide.status.sentence(),
                           "radial_differentiation: 7 gaussian functions of shape 1e-06 on an interval of "
                           "1 lose their derivatives to rounding: numerically they are 2 functions"));
  EXPECT_TRUE(wide.matrix.allFinite());

  const Differentiation narrow = radial_differentiation(lgl_times(7), Kernel::gaussian, 1e6);
  EXPECT_EQ(narrow.status.text(),
            "outside_validity: radial_differentiation: 7 gaussian functions of shape 1e+06 on an interval of "
            "1 do not "
            "overlap: slopes are wrong by 100 %; choose a smaller shape");
  EXPECT_EQ(narrow.matrix, Eigen::MatrixXd::Zero(7, 7));

  // All functions equal 1: the second pivot is zero.
  const Differentiation flat = radial_differentiation(lgl_times(7), Kernel::gaussian, 1e-9);
  EXPECT_EQ(flat.status.outcome(), Outcome::singular_matrix);
  EXPECT_EQ(flat.matrix.size(), 0);
  EXPECT_EQ(flat.rank, 1);

  const Differentiation huge = radial_differentiation(lgl_times(7), Kernel::multiquadric, 1e200);
  EXPECT_EQ(huge.status.outcome(), Outcome::non_finite);
  EXPECT_EQ(huge.matrix.size(), 0);
}

// Only the explicit inverse loses its digits: the message does not advise narrower functions.
TEST(Differentiation, TellsRoundingFromNarrowness) {
  const Differentiation d = radial_differentiation(lgl_times(35), Kernel::gaussian, 4, Inversion::inverse);
  EXPECT_GT(d.slope_error, 0.5);
  EXPECT_EQ(d.status.outcome(), Outcome::singular_matrix);
}

/// The largest error of D for exp(t/h), relative to the largest derivative.
double error_for_exponential(const Eigen::MatrixXd& D, const Eigen::VectorXd& times) {
  const Eigen::VectorXd x = times.array().exp();
  return (D * x - x).cwiseAbs().maxCoeff() / x.maxCoeff();
}

// Never NaN; after a success the matrix is usable, a failure has a message that names the shape.
void expect_sense(int n, Kernel kernel, double shape) {
  const Eigen::VectorXd times = lgl_times(n);
  const Differentiation d = radial_differentiation(times, kernel, shape);
  const std::string place =
      std::to_string(n) + " " + std::string(to_string(kernel)) + " " + std::to_string(shape);
  EXPECT_TRUE(d.matrix.allFinite()) << place;
  EXPECT_GE(d.condition, 1) << place;
  EXPECT_GE(d.rank, 1) << place;
  if (d.status.ok()) {
    ASSERT_EQ(d.matrix.rows(), n) << place;
    // The exponential is a line of slope 1 and a curved remainder of the same size: errors of 0.5 to 1.5.
    EXPECT_LT(error_for_exponential(d.matrix, times), 1) << place;
  } else {
    EXPECT_TRUE(tests::holds(d.status.sentence(), "shape")) << place;
  }
}

TEST(Differentiation, MakesSenseForEveryShape) {
  for (const Kernel kernel : kernels) {
    for (const int n : {2, 3, 7, 35}) {
      for (int i = -12; i <= 12; ++i) expect_sense(n, kernel, std::pow(10, i / 2.));
    }
    for (const double shape : {1e-6, 50., 1e6}) expect_sense(200, kernel, shape);
  }
}

// The result does not depend on the unit and the origin of time.
TEST(Differentiation, DependsOnShapeTimesLengthAlone) {
  const Differentiation one = radial_differentiation(lgl_times(7), Kernel::inverse_quadratic, 2);
  const Differentiation scaled =
      radial_differentiation(lgl_times(7, 0x1p-20), Kernel::inverse_quadratic, 0x1p21);
  EXPECT_EQ(one.matrix * 0x1p20, scaled.matrix);
  EXPECT_EQ(one.condition, scaled.condition);
  const Eigen::VectorXd later = lgl_times(7).array() + 1000;
  const Differentiation shifted = radial_differentiation(later, Kernel::inverse_quadratic, 2);
  // Rounding of the nodes: 1000 eps/2.
  EXPECT_LE((one.matrix - shifted.matrix).norm(), 1000 * eps * one.condition * one.matrix.norm());
  EXPECT_NEAR(one.slope_error, shifted.slope_error, 1e-6);
}

}  // namespace
}  // namespace nlmech::collocation::differentiation_test
