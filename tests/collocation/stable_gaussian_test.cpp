/// Well-conditioned Gaussians, and the numbers of wide range that they need.
#include "nlmech/collocation/radial/stable_gaussian.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <optional>

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/radial/radial_basis.hpp"
#include "nlmech/collocation/wide.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/collocation/real.hpp"

namespace nlmech::collocation::stable_gaussian_test {
namespace {

using namespace oracle;

Eigen::VectorXd times_of(NodeFamily family, int n) { return (nodes(family, n).array() + 1) / 2; }

/// Rows of D at the times @p at: rows of Phi' times Phi^-1, by the factors L D L^T of Phi in the given number
/// of digits, rounded to double. Empty if a pivot leaves fewer than 25 digits.
template <unsigned digits>
std::optional<Eigen::MatrixXd> exact_rows(const Eigen::VectorXd& times, double shape,
                                          const std::vector<double>& at) {
  using Real = ExtendedReal<digits>;
  const Eigen::Index n = times.size();
  const Real c = shape;
  Matrix<Real> A(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      A(i, j) = phi(Kernel::gaussian, c, Real(Real(times[i]) - Real(times[j])));
  }
  for (Eigen::Index k = 0; k < n; ++k) {  // column k becomes d_k times column k of L
    if (!(static_cast<double>(Real(-log10(abs(A(k, k))))) < digits - 25.0)) return std::nullopt;
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const Real l = A(i, k) / A(k, k);
      for (Eigen::Index j = k + 1; j <= i; ++j) A(i, j) -= l * A(j, k);
    }
  }
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(at.size()), n);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    Vector<Real> x(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Real distance = Real(at[static_cast<std::size_t>(r)]) - Real(times[k]);
      x[k] = phi_dot(Kernel::gaussian, c, distance);
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      x[k] /= A(k, k);
      for (Eigen::Index i = k + 1; i < n; ++i) x[i] -= A(i, k) * x[k];
    }
    for (Eigen::Index k = n - 1; k >= 0; --k) {
      Real sum = 0;
      for (Eigen::Index i = k + 1; i < n; ++i) sum += A(i, k) * x[i];
      x[k] -= sum / A(k, k);
    }
    for (Eigen::Index k = 0; k < n; ++k) rows(r, k) = static_cast<double>(x[k]);
  }
  return rows;
}

/// With as many digits as needed.
Eigen::MatrixXd exact(const Eigen::VectorXd& times, double shape, const std::vector<double>& at) {
  if (const auto rows = exact_rows<60>(times, shape, at)) return *rows;
  if (const auto rows = exact_rows<150>(times, shape, at)) return *rows;
  if (const auto rows = exact_rows<330>(times, shape, at)) return *rows;
  return exact_rows<700>(times, shape, at).value();
}

/// Widths for which extended precision is fast enough for a unit test.
std::vector<double> affordable(NodeFamily family, int n) {
  if (n <= 7) return {1e-6, 1e-3, 0.1, 1, 3, 6, 10, 20, 40, 100};
  if (n <= 15) return {0.1, 1, 3, 10, 100};
  if (n <= 35) return {1, 6, 30, 100};
  if (n <= 60) return {10, 100};
  return {family == NodeFamily::legendre_gauss_lobatto ? 50. : 20.};
}

/// Rows that represent all: both ends, where D is largest, and one between.
std::vector<Eigen::Index> some_rows(Eigen::Index n) { return {0, n / 3, n - 1}; }

// Error bounds of the header. Reference: Phi' Phi^-1 with as many digits as its pivots need.
TEST(StableGaussian, DifferentiatesAsExtendedPrecisionDoes) {
  for (const NodeFamily family : {NodeFamily::legendre_gauss_lobatto, NodeFamily::left_end_and_radau}) {
    for (const int n : {2, 7, 15, 35, 60, 100}) {
      const Eigen::VectorXd times = times_of(family, n);
      for (const double shape : affordable(family, n)) {
        std::vector<double> at;
        for (const Eigen::Index i : some_rows(n)) at.push_back(times[i]);
        const Eigen::MatrixXd reference = exact(times, shape, at);
        const Eigen::MatrixXd D = StableGaussian(times, shape).differentiation_matrix();
        Eigen::Index r = 0;
        for (const Eigen::Index i : some_rows(n)) {
          const Eigen::RowVectorXd row = reference.row(r++);
          EXPECT_LE((D.row(i) - row).cwiseAbs().maxCoeff(), 1e-12 * D.cwiseAbs().maxCoeff())
              << to_string(family) << ' ' << n << ' ' << shape << ' ' << i;
          for (Eigen::Index j = 0; j < n; ++j) {
            if (i == j || std::abs(row[j]) < 1e-290) continue;  // below, doubles lose digits
            EXPECT_NEAR(D(i, j) / row[j], 1, 2e-11) << n << ' ' << shape << ' ' << i << ' ' << j;
          }
        }
      }
    }
  }
}

// D is an even function of c: its difference from polynomials decreases as (c h)^2. This covers the widths
// for which extended precision is too slow.
TEST(StableGaussian, TendsToPolynomials) {
  for (const NodeFamily family : families) {
    for (const int n : {7, 35, 60, 100}) {
      const Eigen::VectorXd times = times_of(family, n);
      const Eigen::MatrixXd P = polynomial_differentiation_matrix(times);
      const auto difference = [&](double shape) {
        return (StableGaussian(times, shape).differentiation_matrix() - P).norm() / P.norm();
      };
      for (const double shape : {1e-6, 1e-5, 1e-4}) {
        EXPECT_LE(difference(shape), shape * shape + 20 * n * eps) << n << ' ' << shape;
      }
      // The fourth power of 0.01 and the rounding of P, 1e-13 compared with 1e-8, are below a percent.
      EXPECT_NEAR(difference(1e-2) / difference(1e-3), 100, 1) << n;
    }
  }
}

TEST(StableGaussian, IsThePolynomialForShapeZero) {
  const Eigen::VectorXd times = lgl_times(9, 3);
  const StableGaussian flat(times, 0);
  EXPECT_EQ(flat.differentiation_matrix(), polynomial_differentiation_matrix(times));
  EXPECT_EQ(flat.terms(), 9);
  EXPECT_TRUE(flat.last_pivots().empty());
}

// D phi_k = phi'_k for the functions themselves. Rounding: |D||phi|, with the relative errors of D.
TEST(StableGaussian, DifferentiatesItsFunctions) {
  for (const int n : {2, 5, 35, 100}) {
    const Eigen::VectorXd times = lgl_times(n);
    for (const double shape : {0.01, 1., 7., 30., 200.}) {
      const Eigen::MatrixXd D = StableGaussian(times, shape).differentiation_matrix();
      for (const Eigen::Index k : some_rows(n)) {
        Eigen::VectorXd value(n), slope(n);
        for (Eigen::Index j = 0; j < n; ++j) {
          value[j] = phi(Kernel::gaussian, shape, times[j] - times[k]);
          slope[j] = phi_dot(Kernel::gaussian, shape, times[j] - times[k]);
        }
        const double size = (D.cwiseAbs() * value).maxCoeff();
        EXPECT_LE((D * value - slope).cwiseAbs().maxCoeff(), 1e-12 * n * size) << n << ' ' << shape;
      }
    }
  }
}

// 1/(Phi^-1)_ii from the inverse in 50 digits, where these suffice.
TEST(StableGaussian, LastPivots) {
  for (const int n : {2, 7, 15}) {
    for (const double shape : {2., 5., 20.}) {
      const RadialBasis<oracle::Real> exact(lgl_times(n).cast<oracle::Real>(), Kernel::gaussian,
                                            oracle::Real(shape));
      const Matrix<oracle::Real> inverse = exact.inverse();
      const std::vector<Wide> pivots = StableGaussian(lgl_times(n), shape).last_pivots();
      for (Eigen::Index i = 0; i < n; ++i) {
        const double value = pivots[static_cast<std::size_t>(i)].value();
        EXPECT_NEAR(value * oracle::to_double(inverse(i, i)), 1, 1e-10) << n << ' ' << shape << ' ' << i;
      }
    }
  }
}

/// n times with different gaps.
Eigen::VectorXd arbitrary_times() {
  const int n = *rc::gen::inRange(2, 13);
  Eigen::VectorXd times(n);
  double t = *rc::gen::inRange(-50, 50);
  for (double& time : times) {
    time = t;
    t += *rc::gen::inRange(1, 64);  // integers: the affine images below are exact
  }
  return times;
}

// A change of unit and origin of time changes only the unit of D.
RC_GTEST_PROP(StableGaussianProperty, IsInvariantUnderAffineMaps, ()) {
  const Eigen::VectorXd times = arbitrary_times();
  const double length = times[times.size() - 1] - times[0];
  const double shape = std::exp(*rc::gen::inRange(-60, 30) / 10.0) / length;
  const Eigen::MatrixXd D = StableGaussian(times, shape).differentiation_matrix();
  const Eigen::VectorXd moved = 8 * times.array() + 40;
  const Eigen::MatrixXd E = StableGaussian(moved, shape / 8).differentiation_matrix();
  RC_ASSERT((D - 8 * E).cwiseAbs().maxCoeff() <= 1e-12 * D.cwiseAbs().maxCoeff());
}

RC_GTEST_PROP(StableGaussianProperty, ChangesItsSignUnderReflection, ()) {
  const Eigen::VectorXd times = arbitrary_times();
  const double length = times[times.size() - 1] - times[0];
  const double shape = std::exp(*rc::gen::inRange(-60, 30) / 10.0) / length;
  const Eigen::MatrixXd D = StableGaussian(times, shape).differentiation_matrix();
  const Eigen::MatrixXd E = StableGaussian(-times.reverse(), shape).differentiation_matrix();
  RC_ASSERT((D + E.reverse()).cwiseAbs().maxCoeff() <= 1e-12 * D.cwiseAbs().maxCoeff());
}

// The reference does not depend on the family of nodes: arbitrary nodes.
RC_GTEST_PROP(StableGaussianProperty, HoldsForAnyNodes, ()) {
  const Eigen::VectorXd times = arbitrary_times();
  const double length = times[times.size() - 1] - times[0];
  const double shape = std::exp(*rc::gen::inRange(-40, 40) / 10.0) / length;
  const StableGaussian basis(times, shape);
  const Eigen::MatrixXd reference = exact(times, shape, {times[0], times[times.size() - 1]});
  const Eigen::MatrixXd& D = basis.differentiation_matrix();
  const double size = D.cwiseAbs().maxCoeff();
  RC_ASSERT((D.row(0) - reference.row(0)).cwiseAbs().maxCoeff() <= 1e-12 * size);
  RC_ASSERT((D.bottomRows(1) - reference.row(1)).cwiseAbs().maxCoeff() <= 1e-12 * size);
}

TEST(StableGaussian, RefusesWhatIsNoBasis) {
  const auto message = [](double shape) {
    return refusal([=] { (void)StableGaussian(lgl_times(7, 2), shape); });
  };
  EXPECT_EQ(message(-2.5),
            "StableGaussian: the shape times the interval must be between 0 and 200, is -2.5 * 2");
  EXPECT_NE(message(101), "");
  EXPECT_NE(message(std::nan("")), "");
  EXPECT_NE(message(INFINITY), "");
  EXPECT_EQ(message(100), "");
  EXPECT_NE(refusal([] { (void)StableGaussian(Eigen::Vector2d(1, 0), 1.); }), "");
  EXPECT_NE(refusal([] { (void)StableGaussian(Eigen::VectorXd::Zero(1), 1.); }), "");
}

double positive() {
  return std::ldexp(1 + *rc::gen::inRange(0, 1 << 30) * 0x1p-30, *rc::gen::inRange(-300, 300));
}

// Within the range of double the operations are equal to those of double.
RC_GTEST_PROP(Wide, RoundsAsDoublesDo, ()) {
  const double a = positive(), b = positive();
  RC_ASSERT((Wide(a) + b).value() == a + b);
  RC_ASSERT((Wide(a) * b).value() == a * b);
  RC_ASSERT((Wide(a) / b).value() == a / b);
}

TEST(Wide, LeavesTheRangeOfDoublesAndReturns) {
  Wide power = 1.0;
  for (int k = 0; k < 1000; ++k) power = power * 3.0;
  EXPECT_NEAR(power.log10(), 1000 * std::log10(3.0), 1e-10);
  EXPECT_TRUE(std::isinf((power * power).value()));
  EXPECT_EQ((Wide(1.0) / (power * power)).value(), 0);
  for (int k = 0; k < 1000; ++k) power = power / 3.0;
  EXPECT_NEAR(power.value(), 1, 2000 * eps);  // an ulp an operation
}

TEST(Wide, Zero) {
  const Wide zero, one = 1.0;
  EXPECT_EQ(zero.value(), 0);
  EXPECT_EQ((zero + zero).value(), 0);
  EXPECT_EQ((zero + one).value(), 1);
  EXPECT_EQ((one + zero).value(), 1);
  EXPECT_EQ((zero * one + Wide::exp(-1e6) * 0.0).value(), 0);
  EXPECT_TRUE(std::isinf(zero.log10()));
}

TEST(Wide, Exponential) {
  for (const double x : {-48e3, -700.5, -1.0, 0.0, 0.25, 3e4}) {
    const Wide found = Wide::exp(x) * Wide::exp(-x / 2) * Wide::exp(-x / 2);
    EXPECT_NEAR(found.value(), 1, 8 * eps) << x;  // a few roundings each
    EXPECT_NEAR(Wide::exp(x).log10(), x * 0.43429448190325182765, 1e-10) << x;
  }
  EXPECT_NEAR(Wide::exp(2.5).value() / to_double(exp(Real(2.5))), 1, 4 * eps);
}

}  // namespace
}  // namespace nlmech::collocation::stable_gaussian_test
