/// Misprints and statements of section 3.1 beyond those in tests/spacecraft: printed and corrected form
/// against an independent oracle.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "nlmech/spacecraft/control/margins.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::chapters::gss_control::errata_test {
namespace {

using spacecraft::Complex;

/// exp(A) by Taylor's series: entries of A are at most of order ten here.
Eigen::Matrix<double, 6, 6> exponential(const Eigen::Matrix<double, 6, 6>& a) {
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Identity(), term = sum;
  for (int k = 1; k < 80; ++k) {
    term = term * a / k;
    sum += term;
  }
  return sum;
}

/// The matrix of (3.25) at a beta; row 5 as printed repeats z_5 instead of giving z_6.
Eigen::Matrix<double, 6, 6> state_matrix(double beta, bool printed) {
  Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 4; ++i) a(i, i + 1) = 1;
  a(4, printed ? 4 : 5) = 1;
  a(5, 2) = -beta;
  return a;
}

// (3.25), row 5: z_5' = z_6. The corrected matrix gives f = (cos + cosh)/2 as the factor of z_5(0) in z_5
// (3.28); the printed one a plain exponential.
TEST(Errata, RowFiveOfTheStateMatrix) {
  const double beta = 0.5, x = 1.5;
  // f = cos(b x) cosh(b x) with b = beta^(1/4)/sqrt 2 for beta > 0 (3.30).
  const double b = std::pow(beta, 0.25) / std::sqrt(2.0), f = std::cos(b * x) * std::cosh(b * x);
  // Some hundred rounding errors of numbers of order one.
  tests::expect_erratum("gss_control-3.25-row-5",
                        {.printed = exponential(state_matrix(beta, true) * x)(4, 4),
                         .corrected = exponential(state_matrix(beta, false) * x)(4, 4),
                         .oracle = f,
                         .tolerance = 2e-14});
}

// Figure 3.8 is captioned "theta at x = 4 ft": theta/u does not depend on the position x.
TEST(Errata, HubAngleHasNoPlace) {
  const spacecraft::Plant plant(craft(true));
  for (const double omega : {0.3, 7.0, 80.0})
    EXPECT_EQ(plant.at_frequency(omega, 2).theta, plant.at_frequency(omega, 4).theta);
}

/// Number of closed-loop poles of a discrete model in the right half plane: in the equation of the hub the
/// appendages have the factor kappa/2, M x'' + C x' + K x = 0.
int unstable_poles(const spacecraft::DiscreteModel& model, const spacecraft::Gains& g) {
  const Eigen::Index n = model.size() + 1;
  const double half = 1 + g.k2 / 2;
  Eigen::MatrixXd mass = half * model.full_mass(), stiffness = half * model.full_stiffness();
  mass(0, 0) += (1 - half) * model.hub_inertia;
  stiffness(0, 0) += g.k1;
  const Eigen::MatrixXd inverse = mass.inverse();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -inverse * stiffness;
  a.block(n, n, n, 1) = -g.k3 * inverse.col(0);
  const auto poles = Eigen::EigenSolver<Eigen::MatrixXd>(a, false).eigenvalues();
  return static_cast<int>((poles.real().array() > 0).count());
}

// "Potential system instability" of unit gains: the first poles are all stable, and the gains may be
// increased without bound; only a delay makes them unstable.
TEST(Claims, UnitGainsAreStableAndFragile) {
  const spacecraft::ClosedLoop loop(craft(true), unit_gains);
  const auto poles = loop.poles(40);
  ASSERT_TRUE(poles.status.ok());
  const auto unstable =
      std::count_if(poles.s.begin(), poles.s.end(), [](Complex s) { return s.real() >= 0; });
  EXPECT_EQ(unstable, 0);
  EXPECT_EQ(unstable_poles(spacecraft::finite_elements(craft(true), 6), unit_gains), 0);
  EXPECT_TRUE(std::isinf(margins(loop, 9).gain_margin));
  EXPECT_GT(delayed_poles(loop, 1e-5, 9).unstable, 0);
}

}  // namespace
}  // namespace nlmech::chapters::gss_control::errata_test
