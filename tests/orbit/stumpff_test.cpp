/// Stumpff's functions against their closed forms in 50 digits.
#include "nlmech/orbit/stumpff.hpp"

#include <gtest/gtest.h>

#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::stumpff_test {
namespace {

using namespace oracle;

/// Closed forms; 50 digits leave 20 after the worst cancellation here, |psi| = 1e-10 in c_3.
Stumpff<Real> exact(double psi) {
  if (psi == 0) return {1, 1, Real(1) / 2, Real(1) / 6};
  const Real p = psi, x = sqrt(abs(p));
  const Real c = psi > 0 ? cos(x) : cosh(x), s = psi > 0 ? sin(x) : sinh(x);
  return {c, s / x, (1 - c) / p, (1 - s / x) / p};
}

double error(double mine, const Real& truth, double scale) {
  return std::abs(static_cast<double>(Real(mine - truth))) / (scale * eps);
}

RC_GTEST_PROP(Stumpff, HasNoCancellation, ()) {
  const double size = std::pow(10, *between(-10, 0.994));  // to pi^2
  const double psi = *rc::gen::element(-1.0, 1.0) * size;
  const Stumpff<double> c = stumpff(psi);
  const Stumpff<Real> e = exact(psi);
  RC_ASSERT(error(c.c2, e.c2, static_cast<double>(e.c2)) <= 8);
  RC_ASSERT(error(c.c3, e.c3, static_cast<double>(e.c3)) <= 8);
  // c_0 and c_1 have zeros: absolute errors there.
  RC_ASSERT(error(c.c0, e.c0, std::max(1.0, static_cast<double>(e.c0))) <= 8);
  RC_ASSERT(error(c.c1, e.c1, std::max(1.0, static_cast<double>(e.c1))) <= 8);
}

// Large arguments: the hyperbolic functions' own condition is sqrt(-psi) eps.
RC_GTEST_PROP(Stumpff, LargeArguments, ()) {
  const double psi = *between(-4e5, 200);
  const Stumpff<double> c = stumpff(psi);
  const Stumpff<Real> e = exact(psi);
  const double room = 8 + std::sqrt(std::abs(psi));
  RC_ASSERT(error(c.c3, e.c3, static_cast<double>(e.c3)) <= room);
  RC_ASSERT(error(c.c2, e.c2, std::max(1 / std::abs(psi), static_cast<double>(e.c2))) <= room);
}

TEST(Stumpff, AtNothingAndAtTheSeams) {
  EXPECT_EQ(stumpff(0.0).c0, 1);
  EXPECT_EQ(stumpff(0.0).c2, 0.5);
  for (const double seam : {-4., 4.}) {
    const double below = std::nextafter(seam, -10), above = std::nextafter(seam, 10);
    EXPECT_NEAR(stumpff(below).c3 / stumpff(above).c3, 1, 16 * eps);
    EXPECT_NEAR(stumpff(below).c2 / stumpff(above).c2, 1, 16 * eps);
  }
  EXPECT_EQ(stumpff(-1e9).c2, HUGE_VAL);
}

// The series for 50 digits reaches them up to its seam.
TEST(Stumpff, ExtendedPrecision) {
  for (const double psi : {-4., -1., 3., 4.}) {
    const Stumpff<Real> mine = stumpff(Real(psi)), e = exact(psi);
    EXPECT_LT(abs(Real(mine.c3 / e.c3 - 1)), Real(1e-47));
    EXPECT_LT(abs(Real(mine.c2 / e.c2 - 1)), Real(1e-47));
  }
}

}  // namespace
}  // namespace nlmech::orbit::stumpff_test
