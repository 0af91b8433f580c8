// Hermitian operators: Laier's Table 1, corrected and as printed, and the amplification matrix of a linear
// oscillator.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "nlmech/ivp/hermitian/hermitian_operators.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::ivp::hermitian_operators_test {
namespace {

using tests::expect_erratum;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Positions, velocities and accelerations at both ends of a step.
struct Ends {
  double q0, q1, v0, v1, a0, a1;
};

/// The motion t^2 from 1 to 1 + h.
Ends parabola(double h) { return {1, (1 + h) * (1 + h), 2, 2 * (1 + h), 2, 2}; }

/// The end position that an operator without jerks gives. The jerk of a parabola is 0 in any case.
double position_at_end(const HermitianOperator& op, const Ends& m, double h) {
  return -(op.A * m.q0 + h * (op.C * m.v0 + op.D * m.v1) + h * h * (op.E * m.a0 + op.F * m.a1)) / op.B;
}

/// The end velocity. @param rate the factor of C and D: h
double velocity_at_end(const HermitianOperator& op, const Ends& m, double h, double rate) {
  return -(op.A * m.q0 + op.B * m.q1 + rate * op.C * m.v0 + h * h * (op.E * m.a0 + op.F * m.a1)) /
         (rate * op.D);
}

// Laier and Argyris are exact for q of degree 4, respectively 5 in the first operator, and for v of degree 4;
// the others for degree 2.
TEST(HermitianOperators, AreOfTheStatedOrder) {
  for (const HermitianPair& pair : hermitian_table) {
    const bool high = pair.name == "laier" || pair.name == "argyris";
    EXPECT_EQ(order_of(solved_for_end(pair)), high ? 4 : 2) << pair.name;
  }
  EXPECT_NEAR(residual_on_power(argyris.first, 5), 0, 4 * eps);
  EXPECT_NE(residual_on_power(argyris.first, 6), 0);
  EXPECT_EQ(residual_on_power(laier.first, 4), 0);
  EXPECT_EQ(residual_on_power(laier.first, 5), -12 + 6 * 5 - 20);  // B + 5 D + 20 F
}

// Solved for the end state, the corrected rows of Newmark, Hoff and Bazzi give the same eight coefficients.
TEST(HermitianOperators, NewmarkHoffAndBazziAreOne) {
  const HermitianStep n = solved_for_end(newmark_pair);
  for (const HermitianPair& pair : {hoff, bazzi}) {
    const HermitianStep s = solved_for_end(pair);
    EXPECT_EQ(s.qa0, n.qa0);
    EXPECT_EQ(s.qa1, n.qa1);
    EXPECT_EQ(s.qj0, n.qj0);
    EXPECT_EQ(s.qj1, n.qj1);
    EXPECT_EQ(s.va0, n.va0);
    EXPECT_EQ(s.va1, n.va1);
    EXPECT_EQ(s.vj0, n.vj0);
    EXPECT_EQ(s.vj1, n.vj1);
  }
  EXPECT_EQ(n.qa0, 0.25);
  EXPECT_EQ(n.qa1, 0.25);
  EXPECT_EQ(n.va0, 0.5);
  EXPECT_EQ(n.va1, 0.5);
}

// The rows as printed: Newmark's second operator has the residual -2 h y' for uniform motion (its A1 and B1
// have the wrong sign), Hoff's first one -h^2 y'' (its F has the wrong sign); those of Laier, Bazzi and
// Argyris have none.
TEST(HermitianOperators, PrintedRowsOfNewmarkAndHoffAreInconsistent) {
  const HermitianOperator newmark = {1, -1, -1, 0, -1. / 4, -1. / 4, 0, 0};
  EXPECT_EQ(residual_on_power(newmark, 1), -2);
  EXPECT_EQ(residual_on_power(newmark_pair.second, 1), 0);
  const HermitianOperator hoff_first = {0, 0, 1, -1, 1. / 2, -1. / 2, 0, 0};
  EXPECT_EQ(residual_on_power(hoff_first, 2), -2);  // y'' = 2
  EXPECT_EQ(residual_on_power(hoff.first, 2), 0);
  // From 1, uniform motion reaches 2 after a step of 1, and t^2 reaches the velocity 4.
  const Ends uniform = {1, 2, 1, 1, 0, 0};
  expect_erratum("hermitian-table-1-newmark", {.printed = position_at_end(newmark, uniform, 1),
                                               .corrected = position_at_end(newmark_pair.second, uniform, 1),
                                               .oracle = 2,
                                               .tolerance = 4 * eps});
  expect_erratum("hermitian-table-1-hoff", {.printed = velocity_at_end(hoff_first, parabola(1), 1, 1),
                                            .corrected = velocity_at_end(hoff.first, parabola(1), 1, 1),
                                            .oracle = 4,
                                            .tolerance = 4 * eps});
  const auto refusal = [](const HermitianPair& pair) -> std::string {
    try {
      static_cast<void>(solved_for_end(pair));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refusal({"printed", newmark_pair.first, newmark}).find("uniform motion"), std::string::npos);
  EXPECT_EQ(refusal(hoff), "accepted");
  EXPECT_NE(refusal({"twice", laier.first, laier.first}).find("do not determine"), std::string::npos);
}

// Equation (1) as printed, with its mixed signs: only Hoff's first row is consistent with it.
TEST(HermitianOperators, SignsOfEquationOneAsPrinted) {
  const auto literal = [](const HermitianOperator& p) {
    return HermitianOperator{p.A, -p.B, p.C, p.D, p.E, -p.F, p.G, -p.H};
  };
  const auto degree = [](const HermitianOperator& op) {
    int k = -1;
    while (k < 8 && std::abs(residual_on_power(op, k + 1)) < 1e-12) ++k;
    return k;
  };
  // The rows as printed.
  EXPECT_LT(degree(literal(laier.first)), 0);
  EXPECT_LT(degree(literal(argyris.first)), 0);
  EXPECT_LT(degree(literal(bazzi.first)), 0);
  EXPECT_EQ(degree(literal(HermitianOperator{0, 0, 1, -1, 1. / 2, -1. / 2, 0, 0})), 3);
  // With all signs positive, as in Eq. (6).
  EXPECT_EQ(degree(laier.first), 4);
  EXPECT_EQ(degree(argyris.first), 5);
  EXPECT_EQ(degree(bazzi.first), 2);
  for (const HermitianOperator& op : {laier.first, argyris.first, bazzi.first}) {
    expect_erratum("hermitian-1-signs", {.printed = position_at_end(literal(op), parabola(1), 1),
                                         .corrected = position_at_end(op, parabola(1), 1),
                                         .oracle = 4,
                                         .tolerance = 4 * eps});
  }
}

// Equation (1), second line: without the factor h at C1 and D1 the end velocity depends on the unit of time.
TEST(HermitianOperators, RatesOfTheSecondLineNeedTheStep) {
  for (const double h : {0.1, 100.}) {
    for (const HermitianOperator& op : {laier.second, argyris.second}) {
      expect_erratum("hermitian-1-step", {.printed = velocity_at_end(op, parabola(h), h, 1),
                                          .corrected = velocity_at_end(op, parabola(h), h, h),
                                          .oracle = 2 * (1 + h),
                                          .tolerance = 4 * eps});
    }
  }
}

TEST(HermitianOperators, AreFoundByName) {
  for (const HermitianPair& pair : hermitian_table)
    EXPECT_EQ(hermitian_pair(pair.name).first.A, pair.first.A);
  try {
    static_cast<void>(hermitian_pair("newmarc"));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("'newmarc'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("laier, newmark, hoff, bazzi, argyris"), std::string::npos);
  }
}

// The closed forms, derived by computer algebra. Tolerance: rounding errors of the quotient, relative to its
// terms.
TEST(Amplification, IsTheRationalFunction) {
  for (double z = 0.01; z < 1e4; z *= 1.03) {
    const double z2 = z * z, z4 = z2 * z2;
    const auto l = amplification(solved_for_end(laier), z);
    EXPECT_NEAR(l.half_trace, (z4 - 60 * z2 + 144) / (z4 + 12 * z2 + 144), 8 * eps) << z;
    const auto a = amplification(solved_for_end(argyris), z);
    EXPECT_NEAR(a.half_trace, (3 * z4 - 104 * z2 + 240) / (z4 + 16 * z2 + 240), 32 * eps) << z;
    const auto n = amplification(solved_for_end(newmark_pair), z);
    EXPECT_NEAR(n.half_trace, (4 - z2) / (4 + z2), 8 * eps) << z;
    EXPECT_NEAR(l.spectral_radius, 1, 4e-16) << z;
    EXPECT_NEAR(n.spectral_radius, 1, 4e-16) << z;
  }
}

// Rounding of the coefficients 21/60, 9/60, ... shifts the limits by some eps.
TEST(Amplification, ArgyrisIsUnstableInAWindowAndBeyond) {
  const auto radius = [](double z2) {
    return amplification(solved_for_end(argyris), std::sqrt(z2)).spectral_radius;
  };
  constexpr double d = 1e-9;
  EXPECT_NEAR(radius(10 - d), 1, 8 * eps);
  EXPECT_GT(radius(10 + d), 1 + 1e-6);
  EXPECT_GT(radius(12 - d), 1 + 1e-6);
  EXPECT_NEAR(radius(12 + d), 1, 8 * eps);
  EXPECT_NEAR(radius(60 - d), 1, 8 * eps);
  EXPECT_GT(radius(60 + d), 1 + 1e-6);
  EXPECT_NEAR(radius(3.3 * 3.3), 1.13, 0.005);  // the maximum of the window
  EXPECT_NEAR(radius(1e16), 3 + std::sqrt(8), 1e-12);
  // It is unstable also with a tenth of the critical damping.
  EXPECT_GT(amplification(solved_for_end(argyris), 7.9, 0.1).spectral_radius, 1);
  EXPECT_LT(amplification(solved_for_end(argyris), 7.0, 0.1).spectral_radius, 1);
}

// theta = z - z^5/720, z - z^5/1440, z - z^3/12; the next terms are of relative size z^2.
TEST(Amplification, PhasesAreOfTheStatedOrder) {
  const double z = 0.05;
  const auto loss = [z](const HermitianPair& pair) {
    return z - amplification(solved_for_end(pair), z).phase;
  };
  EXPECT_NEAR(loss(laier) * 720 / std::pow(z, 5), 1, 0.01);
  EXPECT_NEAR(loss(argyris) * 1440 / std::pow(z, 5), 1, 0.01);
  EXPECT_NEAR(loss(newmark_pair) * 12 / std::pow(z, 3), 1, 0.01);
}

// With damping Laier's step is the Pade approximation (2, 2) of the exponential: eigenvalues P(l)/P(-l) with
// P(l) = 1 + l/2 + l^2/12 and l = -xi z +- i z sqrt(1 - xi^2). Their product is real.
RC_GTEST_PROP(Amplification, LaierIsThePadeApproximation, ()) {
  const double z = std::exp(*rc::gen::inRange(-400, 400) / 100.0), xi = *rc::gen::inRange(0, 99) / 100.0;
  const double re = -xi * z, im = z * std::sqrt(1 - xi * xi);
  const auto square = [im](double real) {  // |P|^2
    const double a = 1 + real / 2 + (real * real - im * im) / 12, b = im / 2 + real * im / 6;
    return a * a + b * b;
  };
  const auto a = amplification(solved_for_end(laier), z, xi);
  RC_ASSERT(std::abs(a.determinant - square(re) / square(-re)) <= 64 * eps);
  RC_ASSERT(a.spectral_radius <= 1 + 4 * eps);
}

TEST(Amplification, RefusesWhatCannotBeMeant) {
  const HermitianStep step = solved_for_end(laier);
  EXPECT_THROW(static_cast<void>(amplification(step, -1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(amplification(step, std::nan(""))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(amplification(step, 1, 1)), std::invalid_argument);
  EXPECT_EQ(amplification(step, 0).spectral_radius, 1);
}

}  // namespace
}  // namespace nlmech::ivp::hermitian_operators_test
