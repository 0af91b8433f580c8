#include "nlmech/collocation/radial/radial_basis.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "nlmech/collocation/differentiation.hpp"
#include "tests/collocation/real.hpp"

namespace nlmech::collocation::radial_basis_test {
namespace {

using oracle::eps;
using oracle::kernels;
using oracle::lgl_times;
using oracle::Real;
using oracle::refusal;
using oracle::to_double;

struct Setting {
  int n;
  double shape;
};
const std::vector<Setting> settings = {{2, 1e-6}, {2, 1},  {3, 0.01}, {7, 0.5}, {7, 1},
                                       {7, 4},    {15, 4}, {35, 12},  {35, 40}};

/// The residual of D Phi = Phi' in 50 digits shows that the D of 50 digits is one, whatever its algorithm.
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

// A relative error of a few condition * eps: 4, as the entries of Phi and Phi' have a few roundings each.
TEST(RadialBasis, LosesDigitsInProportionToTheCondition) {
  for (const Kernel kernel : kernels) {
    for (const auto& [n, shape] : settings) {
      const Eigen::VectorXd times = lgl_times(n);
      const Differentiation ours = radial_differentiation(times, kernel, shape);
      const Matrix<Real> exact =
          RadialBasis<Real>(times.cast<Real>(), kernel, Real(shape)).differentiation_matrix();
      const double error = to_double((ours.matrix.cast<Real>() - exact).cwiseAbs().maxCoeff());
      EXPECT_LE(error, 4 * eps * ours.condition * to_double(exact.cwiseAbs().maxCoeff()))
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

// By definition r Phi = phi(t): at a node a row of the unit matrix, and for the functions themselves their
// values.
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
  EXPECT_NE(flat.status().sentence().find("larger shape"), std::string::npos);
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

}  // namespace
}  // namespace nlmech::collocation::radial_basis_test
