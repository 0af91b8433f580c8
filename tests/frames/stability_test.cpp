/// The stability functions against the textbook's in 50 digits.
#include "nlmech/frames/stability_functions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/frames/oracle.hpp"

namespace nlmech::frames::stability_test {
namespace {

using namespace oracle;

void expect_close(const StabilityFunction<double>& mine, const StabilityFunction<Real>& truth, double n) {
  const double size = std::max(1., std::abs(static_cast<double>(truth.value)));
  EXPECT_LE(std::abs(static_cast<double>(Real(mine.value - truth.value))) / (size * eps), 16) << n;
  EXPECT_LE(error(mine.slope, truth.slope), 16) << n;
  EXPECT_LE(error(mine.curvature, truth.curvature), 128) << n;
}

// Bounds as the header promises them. g_s crosses 0 at n = -pi^2 and g_a at -4 pi^2: values below 1 are as
// good as 1.
TEST(StabilityFunctions, KeepTheirDigits) {
  for (const double n :
       {-39.4, -35., -30., -20., -9.9,   -9.8, -6.,    -4.0001, -4., -3.9999, -1.,   -1e-2, -1e-4,
        1e-4,  1e-3, 0.1,  1.,   3.9999, 4.,   4.0001, 10.,     39., 200.,    2000., 2e4,   1e6}) {
    const auto mine = stability_functions(n);
    const auto truth = exact(Real(n));
    expect_close(mine.symmetric, truth.symmetric, n);
    expect_close(mine.antisymmetric, truth.antisymmetric, n);
  }
}

TEST(StabilityFunctions, AtNothingTheyAreTheBeams) {
  const auto g = stability_functions(0.0);
  EXPECT_EQ(g.antisymmetric.value, 12);  // 6 EI/l at either end
  EXPECT_EQ(g.symmetric.value, 4);       // 2 EI/l
  EXPECT_NEAR(g.antisymmetric.slope, 1. / 5, eps);
  EXPECT_NEAR(g.symmetric.slope, 1. / 3, eps);
  EXPECT_NEAR(g.antisymmetric.curvature, -1. / 350, eps);  // G = 3 + y/5 - y^2/175
  EXPECT_NEAR(g.symmetric.curvature, -1. / 90, eps);       // c = 1 + y/3 - y^2/45
}

// From the series to the closed forms at |n| = 4, for g_a at 16: neighbours differ by no more than both are
// wrong.
TEST(StabilityFunctions, AreContinuousAtTheSeams) {
  for (const double seam : {-16., -4., 4., 16.}) {
    const auto in = stability_functions(std::nextafter(seam, 0.)), out = stability_functions(seam);
    for (const auto part :
         {&StabilityFunctions<double>::antisymmetric, &StabilityFunctions<double>::symmetric}) {
      EXPECT_NEAR((in.*part).value / (out.*part).value, 1, 32 * eps);
      EXPECT_NEAR((in.*part).slope / (out.*part).slope, 1, 32 * eps);
      EXPECT_NEAR((in.*part).curvature / (out.*part).curvature, 1, 256 * eps);
    }
  }
}

TEST(StabilityFunctions, InFiftyDigits) {
  for (const double n : {-30., -4.5, -3.5, -1., 0.5, 3.9, 5., 100.}) {
    const auto mine = stability_functions(Real(n)), truth = exact(Real(n));
    for (const auto part : {&StabilityFunctions<Real>::antisymmetric, &StabilityFunctions<Real>::symmetric}) {
      // The oracle cancels like n^-3 in the second derivative.
      EXPECT_LT(abs(Real((mine.*part).value / (truth.*part).value - 1)), Real(1e-45)) << n;
      EXPECT_LT(abs(Real((mine.*part).slope / (truth.*part).slope - 1)), Real(1e-43)) << n;
      EXPECT_LT(abs(Real((mine.*part).curvature / (truth.*part).curvature - 1)), Real(1e-41)) << n;
    }
  }
}

// Next to Euler's load of clamped ends, in the distance from it.
TEST(StabilityFunctions, AboveThePole) {
  const Real pole = FourPiSquared<Real>{}.high;
  for (const double p : {1e-100, 1e-16, 1e-10, 1e-3, 1., 20., 35.}) {
    const auto mine = stability_functions_above_pole(p);
    StabilityFunctions<Real> truth = stability_functions_above_pole(Real(p));
    if (p >= 1e-3)
      truth = exact(Real(Real(p) - pole));  // nearer, 50 digits of the textbook's form are too few
    for (const auto& [a, b] : {std::pair{mine.symmetric.value, truth.symmetric.value},
                               {mine.symmetric.slope, truth.symmetric.slope},
                               {mine.symmetric.curvature, truth.symmetric.curvature},
                               {mine.antisymmetric.slope, truth.antisymmetric.slope},
                               {mine.antisymmetric.value, truth.antisymmetric.value},
                               {mine.antisymmetric.curvature, truth.antisymmetric.curvature}}) {
      EXPECT_LE(error(a, b) * eps, 1e-13) << p;
    }
    // The leading term, -8 pole/p.
    if (p < 1e-9) {
      EXPECT_NEAR(mine.symmetric.value * p / (-8 * static_cast<double>(pole)), 1, 1e-9);
    }
  }
}

// n = -4 pi^2 rounded is not the pole: the function knows the remainder.
TEST(StabilityFunctions, NeighboursOfThePoleAreTheirOwn) {
  const double pole = -FourPiSquared<double>{}.high;
  for (const double n : {pole, std::nextafter(pole, 0.), std::nextafter(pole, -100.)})
    EXPECT_LE(error(stability_functions(n).symmetric.value, stability_functions(Real(n)).symmetric.value),
              64);
}

TEST(StabilityFunctions, PoleOfTheAntisymmetricOne) {
  const double x = std::sqrt(-antisymmetric_pole / 4);
  EXPECT_NEAR(std::tan(x) / x, 1, 64 * eps);  // d tan x/dx = 1 + x^2 = 21
  EXPECT_GT(std::abs(stability_functions(antisymmetric_pole).antisymmetric.value), 1e12);
  EXPECT_LT(stability_functions(antisymmetric_pole + 1e-6).antisymmetric.value, -1e6);
  EXPECT_GT(stability_functions(antisymmetric_pole - 1e-6).antisymmetric.value, 1e6);
}

TEST(StabilityFunctions, LargeTension) {
  const auto g = stability_functions(1e300);  // sinh of half its root would overflow
  EXPECT_NEAR(g.symmetric.value / 2e150, 1, 4 * eps);
  EXPECT_NEAR(g.symmetric.slope / 1e-150, 1, 4 * eps);
  EXPECT_NEAR(g.antisymmetric.value / 2e150, 1, 4 * eps);
}

}  // namespace
}  // namespace nlmech::frames::stability_test
