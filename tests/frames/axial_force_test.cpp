/// The axial force of a deformed member: roots, branches, poles.
#include "nlmech/frames/axial_force.hpp"

#include <gtest/gtest.h>

#include "tests/frames/oracle.hpp"

namespace nlmech::frames::axial_force_test {
namespace {

using namespace oracle;

/// b(n) with the textbook's functions in 50 digits.
Real balance(const AxialBalance<double>& b, const Real& n) {
  const auto g = exact(n);
  return b.strain + b.antisymmetric * g.antisymmetric.slope + b.symmetric * g.symmetric.slope -
         b.softness * n;
}

// The root's own condition: an error of eps in each datum moves n by its term over |db/dn|.
RC_GTEST_PROP(AxialForce, BalancesTheStretch, ()) {
  const double a = *between(-0.7, 0.7), s = *between(-0.7, 0.7);
  const AxialBalance<double> b{*between(-0.1, 0.1), a * a / 2, s * s / 2, std::pow(10, *between(-8, -1))};
  const auto force = axial_force(b);
  RC_ASSERT(force.outcome == Outcome::success);
  RC_PRE(std::abs(force.n) > 1e-4 && s != 0);
  const auto g = exact(Real(force.n));
  const double size = std::abs(b.strain) +
                      static_cast<double>(Real(b.antisymmetric * abs(g.antisymmetric.slope) +
                                               b.symmetric * abs(g.symmetric.slope))) +
                      std::abs(b.softness * force.n);
  // n itself, rounded, leaves eps |n db/dn|.
  const double rounding = std::abs(force.n * b.slope(force.g));
  RC_ASSERT(std::abs(static_cast<double>(balance(b, force.n))) <= 64 * eps * (size + rounding));
  RC_ASSERT(force.evaluations <= 40);
}

TEST(AxialForce, OfNothingIsNothing) { EXPECT_EQ(axial_force(AxialBalance<double>{0, 0, 0, 1e-4}).n, 0); }

TEST(AxialForce, OfAStraightMemberIsHookes) {
  EXPECT_NEAR(axial_force(AxialBalance<double>{1e-3, 0, 0, 1e-5}).n, 100, 1e-12);
  EXPECT_NEAR(axial_force(AxialBalance<double>{-1e-4, 0, 0, 1e-5}).n, -10, 1e-13);
}

// Symmetric rotations of any size keep the force above the pole, and the moment EI g_s theta_s/l keeps its
// digits: for small theta_s it is what the shortening demands, 8 pole^2/p^2 theta_s^2/2 = rest.
TEST(AxialForce, KeepsItsDistanceFromThePole) {
  const double pole = FourPiSquared<double>{}.high;
  for (const double theta : {1e-1, 1e-5, 1e-10, 1e-50}) {
    const AxialBalance<double> b{-0.02, 0, theta * theta / 2, 1e-5};
    const auto force = axial_force(b);
    EXPECT_EQ(force.outcome, Outcome::success);
    EXPECT_GE(force.n, -pole);
    const auto wide = axial_force(AxialBalance<Real>{b.strain, Real(0), b.symmetric, Real(b.softness)});
    EXPECT_LE(error(force.g.symmetric.value * theta, Real(wide.g.symmetric.value * theta)), 1000) << theta;
    if (theta <= 1e-10) {
      const double rest = 0.02 - pole * 1e-5;
      EXPECT_NEAR(std::abs(force.g.symmetric.value) * theta / std::sqrt(16 * pole * rest), 1, 1e-7) << theta;
    }
  }
}

// Without symmetric rotation the member goes on past its clamped buckling load, and says so. Truth: b at that
// root is 0 in 50 digits, and at -4 pi^2, where a solver that stops there would stay, it is not.
TEST(AxialForce, ThePastOfTheClampedBucklingLoadIsAnotherBranch) {
  const AxialBalance<double> b{-0.02, 0.1 * 0.1 / 2, 0, 1e-5};
  const auto force = axial_force(b);
  EXPECT_EQ(force.outcome, Outcome::wrong_branch);
  EXPECT_LT(force.n, -39.5);
  EXPECT_GT(force.n, antisymmetric_pole);
  const auto at = [&](const Real& n) {
    return static_cast<double>(
        Real(b.strain + b.antisymmetric * exact(n).antisymmetric.slope - b.softness * n));
  };
  // 64 eps of the largest term, 0.02.
  EXPECT_LE(std::abs(at(Real(force.n))), 64 * eps * 0.02);
  EXPECT_LT(at(Real(-39.5)), -0.01);
  // A symmetric rotation, however small, brings it back.
  EXPECT_EQ(axial_force(AxialBalance<double>{-0.02, 0.005, 1e-40, 1e-5}).outcome, Outcome::success);
  for (const double tiny : {1e-189, 1e-191, 1e-300, 5e-324}) {
    const auto next = axial_force(AxialBalance<double>{-0.02, 0.005, tiny, 1e-5});
    EXPECT_TRUE(std::isfinite(next.n) && std::isfinite(next.g.symmetric.curvature)) << tiny;
  }
  // A straight strut has only its shortening.
  const auto strut = axial_force(AxialBalance<double>{-0.02, 0, 0, 1e-5});
  EXPECT_EQ(strut.outcome, Outcome::wrong_branch);
  EXPECT_NEAR(strut.n, -2000, 1e-11);
}

TEST(AxialForce, AtThePoleAndWithoutNumbers) {
  const double pole = FourPiSquared<double>{}.high;
  EXPECT_EQ(axial_force(AxialBalance<double>{-pole / 1024, 0, 0, 1. / 1024}).outcome, Outcome::at_pole);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(axial_force(AxialBalance<double>{nan, 0, 0, 1e-5}).outcome, Outcome::non_finite);
  EXPECT_EQ(axial_force(AxialBalance<double>{HUGE_VAL, 0, 0, 1e-5}).outcome, Outcome::non_finite);
}

}  // namespace
}  // namespace nlmech::frames::axial_force_test
