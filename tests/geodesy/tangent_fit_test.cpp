#include "nlmech/geodesy/tangent_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "nlmech/geodesy/kernels/arctangent.hpp"
#include "tests/geodesy/exact_reverse.hpp"

namespace nlmech::geodesy::tangent_fit_test {
namespace {

using reference::Real;

Real value(const TangentFit& fit, const Real& q, const Real& m) {
  Real sum = 0;
  for (std::size_t i = TangentFit::q_terms; i-- > 0;) {
    Real row = 0;
    for (std::size_t j = TangentFit::m_terms; j-- > 0;) row = row * m + fit.coefficient[i][j];
    sum = sum * q + row;
  }
  return sum;
}

/// Error of the fitted angle against the exact reverse transformation of the same point, in 50 digits.
double error_at(const TangentFit& fit, const Ellipsoid& e, double q, double m) {
  const double R = e.a() / q;
  const Cartesian p{R * std::sqrt(1 - m), 0, R * std::sqrt(m)};
  const Real x = p.x, z = p.z, distance2 = x * x + z * z, s_c = x * z / distance2;
  const Real fitted = s_c * value(fit, e.a() / sqrt(distance2), z * z / distance2) * e.a() / sqrt(distance2);
  return abs(atan(fitted) - (reference::reverse(p, e).latitude - atan2(z, x))).convert_to<double>();
}

// The error measured in double by the construction equals the error in 50 digits, over the whole range.
TEST(TangentFit, KnowsItsError) {
  for (double inverse : {298.257223563, 286., 169.8, 15.4, 8., -298., -15., -7.}) {
    const Ellipsoid e(6378137, 1 / inverse);
    const TangentFit fit = fit_tangent(e);
    double greatest = 0;
    for (int i = 1; i <= 60; ++i) {
      for (int j = 0; j <= 60; ++j)
        greatest = std::max(greatest, error_at(fit, e, fit.q_max * i / 60.0001, j / 60.));
    }
    EXPECT_LE(greatest, 1.1 * fit.error + 2e-18) << inverse;
    EXPECT_GE(greatest, 0.9 * fit.error - 2e-18) << inverse;
  }
}

TEST(TangentFit, IsExactToRoundingForTheEarth) {
  EXPECT_LT(fit_tangent(Ellipsoid::wgs84()).error, 4e-17);
  EXPECT_LT(fit_tangent(Ellipsoid(6378249.145, 1 / 293.465)).error,
            5e-17);  // Clarke 1880, the flattest in use
}

// First and second order of the perturbation series in e^2 for T/(s c q): 1 + E (q - 2 q m + m/2), times E.
TEST(TangentFit, BeginsLikeTheSeries) {
  const double E = 1e-8;
  for (double q : {0., 0.3, 1.}) {
    for (double m : {0., 0.4, 1.}) {
      EXPECT_NEAR(exact_tangent(E, q, m) / E, 1 + E * (q - 2 * q * m + m / 2), 1e-15);
    }
  }
}

TEST(TangentFit, IsTheSameEveryTime) {
  EXPECT_EQ(fit_tangent(Ellipsoid::wgs84()).coefficient, fit_tangent(Ellipsoid::wgs84()).coefficient);
}

TEST(TangentFit, RefusesGreatFlattening) {
  EXPECT_THROW((void)fit_tangent(Ellipsoid(1, 0.26)), std::invalid_argument);
  EXPECT_THROW((void)fit_tangent(Ellipsoid(1, -0.26)), std::invalid_argument);
}

TEST(Arctangent, PolynomialHasItsStatedError) {
  Real greatest = 0;
  const Real end = tan(boost::math::constants::pi<Real>() / 8);
  for (int k = 1; k <= 20000; ++k) {
    const Real t = end * k / 20000, w = t * t;
    Real tail = 0;
    for (int j = 9; j >= 0; --j) tail = tail * w + kernels::arctangent_coefficients[j];
    greatest = std::max<Real>(greatest, abs(t + t * w * tail - atan(t)));
  }
  EXPECT_LT(greatest.convert_to<double>(), 8.7e-18);
}

}  // namespace
}  // namespace nlmech::geodesy::tangent_fit_test
