/// Radial functions: the kernels, their matrices, and bases on the unit interval.
#include "nlmech/collocation/radial/radial_basis.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "nlmech/collocation/basis.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/radial/kernels.hpp"
#include "tests/collocation/real.hpp"
#include "tests/thrown.hpp"

namespace nlmech::collocation::radial_basis_test {
namespace {

using namespace oracle;

struct Setting {
  int n;
  double shape;
};
const std::vector<Setting> settings = {{2, 1e-6}, {2, 1},  {3, 0.01}, {7, 0.5}, {7, 1},
                                       {7, 4},    {15, 4}, {35, 12},  {35, 40}};

/// The residual of D Phi = Phi' in 50 digits verifies the D of 50 digits independently of its algorithm.
TEST(RadialBasis, DifferentiatesItsFunctions) {
  for (const Kernel kernel : kernels) {
    const RadialBasis<Real> basis(lgl_times(7).cast<Real>(), kernel, Real(1));
    const Matrix<Real> D = basis.differentiation_matrix();
    for (int j = 0; j < 7; ++j) {
      for (int k = 0; k < 7; ++k) {
        Real sum = 0;
        for (int i = 0; i < 7; ++i)
          sum += D(j, i) * phi(kernel, Real(1), Real(basis.times()[i] - basis.times()[k]));
        const Real exact = phi_dot(kernel, Real(1), Real(basis.times()[j] - basis.times()[k]));
        // Condition below 1e8, 50 digits.
        EXPECT_LE(to_double(abs(sum - exact)), 1e-40) << to_string(kernel);
      }
    }
  }
}

// A relative error of a few condition * eps: 4, because the entries of Phi and Phi' have a few rounding
// errors each.
TEST(RadialBasis, LosesDigitsInProportionToTheCondition) {
  for (const Kernel kernel : kernels) {
    for (const auto& [n, shape] : settings) {
      const Eigen::VectorXd times = lgl_times(n);
      const Differentiation computed = radial_differentiation(times, kernel, shape);
      const Matrix<Real> exact =
          RadialBasis<Real>(times.cast<Real>(), kernel, Real(shape)).differentiation_matrix();
      const double error = to_double((computed.matrix.cast<Real>() - exact).cwiseAbs().maxCoeff());
      EXPECT_LE(error, 4 * eps * computed.condition * to_double(exact.cwiseAbs().maxCoeff()))
          << to_string(kernel) << ' ' << n << ' ' << shape;
    }
  }
}

TEST(RadialBasis, RowInterpolates) {
  for (const Kernel kernel : kernels) {
    for (const auto& [n, shape] : settings) {
      const Eigen::VectorXd times = lgl_times(n);
      const RadialBasis<double> basis(times, kernel, shape);
      const RadialBasis<Real> exact_basis(times.cast<Real>(), kernel, Real(shape));
      const double bound = 4 * eps * radial_differentiation(times, kernel, shape).condition;
      RowVector<double> row(n);
      RowVector<Real> exact;
      const double* const storage = row.data();
      for (const double t : {0., 0.123, 0.5, 0.99, 1.}) {
        basis.row(t, row);
        exact_basis.row(Real(t), exact);
        const double size = to_double(exact.cwiseAbs().maxCoeff());
        EXPECT_LE(to_double((row.cast<Real>() - exact).cwiseAbs().maxCoeff()), bound * size)
            << to_string(kernel) << ' ' << n << ' ' << shape << ' ' << t;
      }
      EXPECT_EQ(row.data(), storage);
    }
  }
}

// By definition r Phi = phi(t): at a node r is a row of the unit matrix, and r gives the values of the
// functions.
TEST(RadialBasis, RowMeetsTheFunctionsBetweenTheNodes) {
  const Vector<Real> times = lgl_times(7).cast<Real>();
  for (const Kernel kernel : kernels) {
    const RadialBasis<Real> basis(times, kernel, Real(2));
    RowVector<Real> row;
    basis.row(times[3], row);
    for (int k = 0; k < 7; ++k) EXPECT_LE(to_double(abs(row[k] - (k == 3 ? 1 : 0))), 1e-40);
    const Real t = Real(37) / 100;
    basis.row(t, row);
    for (int k = 0; k < 7; ++k) {
      Real sum = 0;
      for (int i = 0; i < 7; ++i) sum += row[i] * phi(kernel, Real(2), Real(times[i] - times[k]));
      EXPECT_LE(to_double(abs(sum - phi(kernel, Real(2), Real(t - times[k])))), 1e-40) << to_string(kernel);
    }
  }
}

TEST(RadialBasis, IsSymmetric) {
  const RadialBasis<double> basis(lgl_times(7), Kernel::inverse_multiquadric, 1.7);
  EXPECT_EQ(basis.values(), basis.values().transpose());
  EXPECT_EQ(basis.derivatives(), -basis.derivatives().transpose());
  EXPECT_LE((basis.values() * basis.inverse() - Eigen::MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(),
            1e6 * eps * 10);  // condition 1e4 to 1e5
}

TEST(RadialBasis, SaysThatItHasNoInverse) {
  const RadialBasis<double> flat(lgl_times(7), Kernel::gaussian, 1e-9);
  EXPECT_EQ(flat.status().outcome(), Outcome::singular_matrix);
  EXPECT_TRUE(tests::holds(flat.status().sentence(), "larger shape"));
  RowVector<double> row;
  EXPECT_THROW(flat.row(0.5, row), std::logic_error);
  EXPECT_THROW((void)flat.differentiation_matrix(), std::logic_error);
  EXPECT_THROW((void)flat.inverse(), std::logic_error);
  const RadialBasis<double> huge(lgl_times(7), Kernel::multiquadric, 1e200);
  EXPECT_EQ(huge.status().outcome(), Outcome::non_finite);
  EXPECT_THROW(huge.row(0.5, row), std::logic_error);
}

TEST(RadialBasis, RefusesWhatIsNoBasis) {
  const auto message = [](double shape) {
    return refusal([=] { (void)RadialBasis<double>(lgl_times(7), Kernel::gaussian, shape); });
  };
  EXPECT_EQ(message(0), "RadialBasis: the shape must be positive and finite, is 0");
  EXPECT_EQ(message(-2.5), "RadialBasis: the shape must be positive and finite, is -2.5");
  EXPECT_NE(message(std::nan("")), "");
  EXPECT_NE(message(INFINITY), "");
  EXPECT_NE(refusal([] { (void)RadialBasis<double>(Eigen::Vector2d(1, 0), Kernel::gaussian, 1.); }), "");
  EXPECT_NE(refusal([] { (void)radial_differentiation(Eigen::VectorXd::Zero(1), Kernel::gaussian, 1.); }),
            "");
  RowVector<double> row;
  const RadialBasis<double> basis(lgl_times(3), Kernel::gaussian, 1.);
  EXPECT_EQ(refusal([&] { basis.row(std::nan(""), row); }),
            "RadialBasis::row: the time must be finite, is nan");
}

/// Eq. 4.8.
Real eq_4_8(Kernel kernel, const Real& c, const Real& r) {
  const Real q = 1 + c * r * c * r;
  switch (kernel) {
    case Kernel::gaussian: return exp(1 - q);
    case Kernel::inverse_quadratic: return 1 / q;
    case Kernel::multiquadric: return sqrt(q);
    default: return sqrt(1 / q);
  }
}

// c from 1e-3 to 1e3, |c r| up to 10: the Gaussian is then far from underflow.
RC_GTEST_PROP(Kernels, AreThoseOfEq48, ()) {
  const double c = std::pow(10, *rc::gen::inRange(-3000, 3001) / 1000.);
  const double r = *rc::gen::inRange(-10000, 10001) / 1000. / c, u2 = (c * r) * (c * r);
  for (const Kernel kernel : kernels) {
    const Real exact = eq_4_8(kernel, Real(c), Real(r));
    // The documented units in the last place; the square of c r has a rounding error of its own in the
    // exponent.
    const double growth = kernel == Kernel::gaussian ? 1 + u2 : 1;
    RC_ASSERT(abs(Real(phi(kernel, c, r)) - exact) <= 4 * eps * growth * abs(exact));

    // Central difference: an error of h^2 phi'''/6, some 1e-30 in units of c.
    const Real h = Real(1e-15) / Real(c);
    const Real slope = (eq_4_8(kernel, Real(c), r + h) - eq_4_8(kernel, Real(c), r - h)) / (2 * h);
    RC_ASSERT(abs(Real(phi_dot(kernel, c, r)) - slope) <= 8 * eps * growth * abs(slope) + Real(1e-28) * c);
  }
}

TEST(Kernels, AreEvenAndTheirDerivativesOdd) {
  for (const Kernel kernel : kernels) {
    EXPECT_EQ(phi(kernel, 3., 0.), 1);
    EXPECT_EQ(phi_dot(kernel, 3., 0.), 0);
    EXPECT_EQ(phi(kernel, 3., -0.7), phi(kernel, 3., 0.7));
    EXPECT_EQ(phi_dot(kernel, 3., -0.7), -phi_dot(kernel, 3., 0.7));
  }
}

TEST(Kernels, StayFiniteFarOut) {
  for (const Kernel kernel : kernels) {
    for (const double c : {1e-150, 1e-6, 1., 1e6, 1e150}) {
      EXPECT_TRUE(std::isfinite(phi(kernel, c, 1.))) << to_string(kernel) << ' ' << c;
      EXPECT_TRUE(std::isfinite(phi_dot(kernel, c, 1.))) << to_string(kernel) << ' ' << c;
    }
  }
}

TEST(Kernels, HaveNames) {
  EXPECT_EQ(to_string(Kernel::inverse_multiquadric), "inverse-multiquadric");
  const auto unknown = static_cast<Kernel>(9);
  EXPECT_NE(refusal([=] { (void)to_string(unknown); }), "");
  EXPECT_NE(refusal([=] { (void)phi(unknown, 1., 1.); }), "");
  EXPECT_NE(refusal([=] { (void)phi_dot(unknown, 1., 1.); }), "");
}

TEST(Basis, StandsOnTheUnitInterval) {
  for (const auto family : {NodeFamily::legendre_gauss_lobatto, NodeFamily::left_end_and_radau}) {
    const Basis basis = Basis::polynomial(family, 9);
    EXPECT_EQ(basis.nodes()[0], 0);
    EXPECT_EQ(basis.nodes()[8], 1);
    EXPECT_EQ(basis.condition(), 1);
    EXPECT_TRUE(basis.status().ok());
  }
}

// t^8 at nine nodes: derivative and values in between are accurate to rounding, times the norm of D (at most
// 100).
TEST(Basis, PolynomialsAreExactUpToTheirDegree) {
  const Basis basis = Basis::polynomial(NodeFamily::left_end_and_radau, 9);
  const Eigen::VectorXd x = basis.nodes().array().pow(8), slope = 8 * basis.nodes().array().pow(7);
  EXPECT_LE((basis.derivative() * x - slope).cwiseAbs().maxCoeff(), 100 * eps);
  for (const double tau : {0.0, 0.123, 0.5, 0.999, 1.0})
    EXPECT_NEAR(basis.row(tau).dot(x), std::pow(tau, 8), 10 * eps) << tau;
}

// A sum of the functions is in their span: exp(-(c t)^2) about the first node.
TEST(Basis, RadialFunctionsAreExactOnTheirSpan) {
  constexpr double c = 2.5;
  const Basis basis = Basis::radial(NodeFamily::legendre_gauss_lobatto, 7, Kernel::gaussian, c);
  const auto bell = [](double t) { return std::exp(-c * c * t * t); };
  const Eigen::VectorXd x = basis.nodes().unaryExpr(bell);
  const double error = basis.condition() * eps;  // of coefficients of order one
  EXPECT_LT(basis.condition(), 1e7);
  for (const double tau : {0.1, 0.77}) EXPECT_NEAR(basis.row(tau).dot(x), bell(tau), error);
  for (Eigen::Index k = 0; k < 7; ++k) {
    const double t = basis.nodes()[k];
    EXPECT_NEAR(basis.derivative().row(k).dot(x), -2 * c * c * t * bell(t), 100 * error);  // norm of D
  }
}

TEST(Basis, ReportsAShapeThatIsOfNoUse) {
  const Basis wide = Basis::radial(NodeFamily::legendre_gauss_lobatto, 35, Kernel::gaussian, 1e-6);
  EXPECT_FALSE(wide.status().ok());
  const Basis narrow = Basis::radial(NodeFamily::legendre_gauss_lobatto, 35, Kernel::gaussian, 1e6);
  EXPECT_FALSE(narrow.status().ok());
  EXPECT_THROW((void)narrow.row(0.5), std::logic_error);
}

TEST(Basis, RefusesCountsAndShapes) {
  EXPECT_THROW((void)Basis::polynomial(NodeFamily::legendre_gauss_lobatto, 1), std::invalid_argument);
  EXPECT_THROW((void)Basis::polynomial(NodeFamily::legendre_gauss_lobatto, 201), std::invalid_argument);
  EXPECT_THROW((void)Basis::radial(NodeFamily::legendre_gauss_lobatto, 7, Kernel::gaussian, 0),
               std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::collocation::radial_basis_test
