/// Williams' equation: the chain of Eq. 2.20, misprints, and limit points.
#include "nlmech/frames/williams.hpp"

#include <gtest/gtest.h>

#include "tests/errata/erratum.hpp"
#include "tests/frames/oracle.hpp"

namespace nlmech::frames::williams_test {
namespace {

using namespace oracle;
using tests::expect_erratum;

/// d_5 by the chain of Eq. 2.20; negative rho is tension.
Real chain(const Real& rho) {
  const Real half_pi = acos(Real(-1)) / 2, x = half_pi * sqrt(abs(rho));
  const Real w = rho > 0 ? Real(x * cos(x) / sin(x)) : Real(x * cosh(x) / sinh(x));
  const Real d1 = (4 * half_pi * half_pi * rho / (4 * (1 - w)) + w) / 2, d2 = d1 - w, d3 = d1 + d2,
             d4 = d3 / 3;
  return 2 * d4 * w;
}

TEST(Williams, TheChainIsTheStabilityFunctions) {
  const Real pi_squared = FourPiSquared<Real>{}.high / 4;
  for (const double rho : {-20., -1., -0.01, 0.01, 0.5, 1., 2., 3.9}) {
    const Real n = -pi_squared * rho;
    // The chain divides by 1 - w, of size rho: two digits.
    EXPECT_LT(abs(Real(stability_functions(n).antisymmetric.value + n - 6 * chain(rho))), Real(1e-45)) << rho;
  }
  // As printed, rho = pi^2 EI/l^2 would be a constant that no structure has.
  const Williams w;
  const Real printed = pi_squared * w.ei / (w.length * w.length);
  EXPECT_NEAR(static_cast<double>(printed), 546.4, 0.05);
  EXPECT_NEAR(static_cast<double>(chain(printed)), -864, 0.5);
  const Real n = -Real(w.compression(0.2)) * w.length * w.length / w.ei;  // Euler's load is at -pi^2
  const Textbook<Real> t = textbook(n);
  expect_erratum("homotopy-2.20", {.printed = static_cast<double>(chain(printed)),
                                   .corrected = static_cast<double>(chain(-n / pi_squared)),
                                   .oracle = static_cast<double>(Real((2 * (t.s + t.sc) + n) / 6)),
                                   .tolerance = eps});
}

TEST(Williams, SubstitutionGivesMinus) {  // 2.21
  const Williams w{.height = 0.44};
  for (const double delta : {0.1, 0.3, 0.6}) {
    const double sine = w.height / w.length, l = w.length, p = w.compression(delta);
    const double n = -p * l * l / w.ei;
    const double d5 = (stability_functions(n).antisymmetric.value + n) / 6;
    const double square = 3 * w.ea * sine / (5 * l * l) * delta * delta;
    const double linear = (6 * w.ei * d5 / (l * l * l) + w.ea * sine * sine / l) * delta;
    EXPECT_NEAR(linear - square, w.load(delta) / 2, 1e-12);
    EXPECT_GT(std::abs(linear + square - w.load(delta) / 2), 3);
    // Eqs 2.17 to 2.19 in 50 digits, d_5 by the chain: W/2 = F + P sin(beta).
    const Real wide = Real(w.ea) / l * (Real(delta) * w.height / l - 3 * Real(delta) * delta / (5 * Real(l)));
    const Real rho = wide * l * l / (w.ei * FourPiSquared<Real>{}.high / 4);
    const auto half =
        static_cast<double>(Real(6 * w.ei * chain(rho) * delta / (Real(l) * l * l) + wide * w.height / l));
    const double beta = std::asin(sine), literal = w.ea * (std::sin(beta * beta) - sine * sine) / l * delta;
    // Terms up to ten times their sum, each rounded a few times.
    const double tolerance = 128 * eps;
    expect_erratum(
        "homotopy-2.21-sign",
        {.printed = linear + square, .corrected = linear - square, .oracle = half, .tolerance = tolerance});
    expect_erratum("homotopy-2.21-square", {.printed = linear + literal - square,
                                            .corrected = linear - square,
                                            .oracle = half,
                                            .tolerance = tolerance});
  }
}

TEST(Williams, StiffnessIsTheSlope) {
  const Williams w{.height = 0.38};
  for (const double delta : {0., 0.05, 0.2, 0.39, 0.8, 1.5, -0.3}) {
    using D = Dual<double, 1>;
    const double slope = w.load(D::variable(delta, 0)).partial[0];
    EXPECT_NEAR(w.stiffness(delta), slope, 1e-12 * (300 + std::abs(slope))) << delta;
  }
}

/// Where the stiffness changes its sign.
double limit_point(const Williams& w, double low, double high) {
  const bool falling = w.stiffness(low) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((w.stiffness(middle) > 0) == falling ? low : high) = middle;
  }
  return low;
}

// 5e-12 is five units of the last digit. oracle: homotopy_williams Williams 0.?? maximum*, Williams 0.??
// minimum*
TEST(Williams, LimitPoints) {
  const auto expect = [](double height, double low, double high, double delta, double load) {
    const Williams w{.height = height};
    const double at = limit_point(w, low, high);
    EXPECT_NEAR(at, delta, 1e-12);
    EXPECT_NEAR(w.load(at), load, 5e-12);
  };
  expect(0.44, 0.1, 0.4, 0.22818821400337, 42.771896097273);
  expect(0.44, 0.4, 0.6, 0.4947308255747, 30.363548710287);
  expect(0.38, 0.1, 0.3, 0.23287115497799, 33.278532607761);
  expect(0.38, 0.3, 0.5, 0.3935882935498, 30.588387926087);
}

// oracle: homotopy_williams Williams 0.32 least slope*, Williams 0.32 load at the least slope
TEST(Williams, TheFirstCaseHasNoLimitPoint) {
  const Williams w;
  double least = HUGE_VAL, at = 0;
  for (double delta = 0; delta < 1; delta += 1e-4) {
    if (w.stiffness(delta) < least) {
      least = w.stiffness(delta);
      at = delta;
    }
  }
  EXPECT_NEAR(least, 12.55869263, 1e-4);  // a grid of 1e-4 about a minimum of curvature 2e3
  EXPECT_NEAR(at, 0.26457338, 1e-4);
  EXPECT_NEAR(w.load(0.26457338), 27.0833960, 1e-6);
}

// oracle: homotopy_williams Williams 0.?? drop under *
TEST(Williams, PublishedLoadsHaveOneEquilibrium) {
  const Williams high{.height = 0.44}, low;
  // Half a unit of the reference's last digit times the stiffness, about 210 lb/in, is 1e-10.
  EXPECT_NEAR(high.load(0.635331561089), 43.79, 2e-10);
  EXPECT_NEAR(high.load(0.636310193301), 44, 2e-10);
  EXPECT_NEAR(low.load(0.266690787315), 27.11, 1e-10);
  EXPECT_LT(high.load(limit_point(high, 0.1, 0.4)), 43.79);  // none before the limit point
}

TEST(Williams, PastThePole) {
  EXPECT_EQ(Williams{}.outcome(0.3), Outcome::success);
  EXPECT_EQ((Williams{.height = 0.44, .ea = 1.885e8}.outcome(0.2)), Outcome::wrong_branch);
  EXPECT_EQ(Williams{}.outcome(std::numeric_limits<double>::quiet_NaN()), Outcome::non_finite);
}

}  // namespace
}  // namespace nlmech::frames::williams_test
