/// Residuals of a step for the two oscillators, the paper's equations (6) and (7): corrected, as printed, and
/// with one misprint at a time, against the operators with accelerations and jerks from dual numbers.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "tests/chapters/hermitian/oscillators.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::laier_test::errata_residual_test {
namespace {

using tests::expect_erratum;

double cube(double x) { return x * x * x; }

End any_end() {
  const auto number = [] { return *rc::gen::inRange(-200, 200) / 100.0; };
  return {number(), number(), number(), number()};
}

/// Which misprints of (6) are kept.
struct Printed6 {
  bool c = false;       ///< the damping C* for the operator's C
  bool square = false;  ///< C^2 + K for C^2 - K
  bool place = false;   ///< y_i for y_{i+1} in the last term of v1
  bool one = false;     ///< C_1, the operator's, for the damping
  bool load = false;    ///< the rate of the load for the load
};

double equation_6(const HermitianOperator& o, const DuffingEquation& p, const End& a, const End& b, double h,
                  const Printed6& printed = {}) {
  const double h2 = h * h, h3 = h2 * h, C = printed.one ? o.C : p.C;
  const double square = printed.square ? C * C + p.K : C * C - p.K;
  const double late = printed.place ? a.y : b.y, f0 = printed.load ? a.df : a.f,
               f1 = printed.load ? b.df : b.f;
  return a.y * (o.A - o.E * h2 * p.K + o.G * C * p.K * h3) +
         b.y * (o.B - o.F * p.K * h2 + o.H * C * p.K * h3) +
         a.v * ((printed.c ? p.C : o.C) * h - o.E * C * h2 + o.G * square * h3 -
                3 * o.G * p.mu * h3 * a.y * a.y) +
         b.v * (o.D * h - o.F * C * h2 + o.H * square * h3 - 3 * o.H * p.mu * h3 * late * late) +
         cube(a.y) * (-o.E * p.mu * h2 + o.G * C * p.mu * h3) +
         cube(b.y) * (-o.F * p.mu * h2 + o.H * C * p.mu * h3) + f0 * (o.E * h2 - o.G * C * h3) +
         f1 * (o.F * h2 - o.H * C * h3) + a.df * o.G * h3 + b.df * o.H * h3;
}

RC_GTEST_PROP(Errata, Equation6CorrectedIsTheOperator, ()) {
  const DuffingEquation p;
  const End a = any_end(), b = any_end();
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    for (const HermitianOperator& o : {pair.first, pair.second, both})
      RC_ASSERT(std::abs(equation_6(o, p, a, b, step) - residual(o, p, a, b, step)) <= rounding);
  }
}

TEST(Errata, Equation6OneMisprintAtATime) {
  const std::pair<const char*, Printed6> misprints[] = {{"c", {.c = true}},
                                                        {"square", {.square = true}},
                                                        {"place", {.place = true}},
                                                        {"one", {.one = true}},
                                                        {"load", {.load = true}}};
  const DuffingEquation p;
  const double exact = residual(both, p, start, end, step), corrected = equation_6(both, p, start, end, step);
  for (const auto& [name, printed] : misprints) {
    expect_erratum(std::string("hermitian-6-") + name,
                   {.printed = equation_6(both, p, start, end, step, printed),
                    .corrected = corrected,
                    .oracle = exact,
                    .tolerance = rounding,
                    .scale = 1});
  }
  // Nor is it correct with all of them together.
  EXPECT_GT(std::abs(equation_6(both, p, start, end, step, {true, true, true, true, true}) - exact), 0.1);
}

/// Which misprints of (7) are kept; q = 1 - y_i^2, Q = 1 - y_{i+1}^2, d for delta.
struct Printed7 {
  bool exchange = false;   ///< G and H exchanged
  bool duffing = false;    ///< G C K h^3 y_i of (6), C being the damping
  bool position = false;   ///< the signs of the terms with q y_i and Q y_{i+1}; the second without K
  bool rate = false;       ///< without C h and D h
  bool stiffness = false;  ///< without -K h^3 at the velocities
  bool delta = false;      ///< d q^2 for d^2 q^2 at v_i, q for Q at v_{i+1}
  bool load = false;       ///< the rate of the load for the load; signs; the first q without d
  bool load_rate = false;  ///< the signs of the rates of the load
};

/// @param y the coefficients A, B, E, F at y_i and y_{i+1}: those of @p o
double equation_7(HermitianOperator o, const VanDerPolEquation& p, const End& a, const End& b, double h,
                  const Printed7& printed, const HermitianOperator& y) {
  const double h2 = h * h, h3 = h2 * h, q = 1 - a.y * a.y, Q = 1 - b.y * b.y, d = p.d, K = p.K;
  const double left = printed.duffing ? o.G * DuffingEquation{}.C * K * h3 * a.y : 0;
  if (printed.exchange) std::swap(o.G, o.H);
  const double positions = a.y * (y.A - y.E * K * h2) + b.y * (y.B - y.F * K * h2) +
                           (printed.position ? o.G * d * K * q * a.y - o.H * d * Q * b.y
                                             : -o.G * d * K * q * a.y - o.H * d * K * Q * b.y) *
                               h3;
  const double stiffness = printed.stiffness ? 0 : K;
  const double rates = (printed.rate ? 0 : h * (o.C * a.v + o.D * b.v)) +
                       h2 * d * (o.E * q * a.v + o.F * Q * b.v) +
                       h3 * o.G * ((printed.delta ? d : d * d) * q * q - stiffness) * a.v +
                       h3 * o.H * (d * d * (printed.delta ? q * q : Q * Q) - stiffness) * b.v -
                       2 * d * h3 * (o.G * a.y * a.v * a.v + o.H * b.y * b.v * b.v);
  const double load = printed.load
                          ? a.df * (o.E * h2 - o.G * q * h3) + b.df * (o.F * h2 - o.H * d * Q * h3)
                          : a.f * (o.E * h2 + o.G * d * q * h3) + b.f * (o.F * h2 + o.H * d * Q * h3);
  return left + positions + rates + load + (printed.load_rate ? -h3 : h3) * (o.G * a.df + o.H * b.df);
}

double equation_7(const HermitianOperator& o, const VanDerPolEquation& p, const End& a, const End& b,
                  double h, const Printed7& printed = {}) {
  return equation_7(o, p, a, b, h, printed, o);
}

RC_GTEST_PROP(Errata, Equation7CorrectedIsTheOperator, ()) {
  const VanDerPolEquation p;
  const End a = any_end(), b = any_end();
  for (const ivp::HermitianPair& pair : ivp::hermitian_table) {
    for (const HermitianOperator& o : {pair.first, pair.second, both})
      RC_ASSERT(std::abs(equation_7(o, p, a, b, step) - residual(o, p, a, b, step)) <= rounding);
  }
}

TEST(Errata, Equation7OneMisprintAtATime) {
  const std::pair<const char*, Printed7> misprints[] = {
      {"exchange", {.exchange = true}},   {"duffing", {.duffing = true}},    {"position", {.position = true}},
      {"rate", {.rate = true}},           {"delta", {.delta = true}},        {"load", {.load = true}},
      {"stiffness", {.stiffness = true}}, {"load-rate", {.load_rate = true}}};
  const VanDerPolEquation p;
  const double exact = residual(both, p, start, end, step), corrected = equation_7(both, p, start, end, step);
  for (const auto& [name, printed] : misprints) {
    expect_erratum(std::string("hermitian-7-") + name,
                   {.printed = equation_7(both, p, start, end, step, printed),
                    .corrected = corrected,
                    .oracle = exact,
                    .tolerance = rounding,
                    .scale = 1});
  }
  // The second (7) has the position coefficients of the first operator.
  for (const ivp::HermitianPair& pair : {ivp::laier, ivp::argyris}) {
    const HermitianOperator& o = pair.second;
    expect_erratum("hermitian-7-one", {.printed = equation_7(o, p, start, end, step, {}, pair.first),
                                       .corrected = equation_7(o, p, start, end, step),
                                       .oracle = residual(o, p, start, end, step),
                                       .tolerance = rounding,
                                       .scale = 1});
  }
  // Nor are all misprints of the first (7) together correct, with or without the term of (6) and the
  // exchange.
  for (const bool of_6 : {false, true}) {
    for (const bool exchange : {false, true}) {
      const Printed7 all = {exchange, of_6, true, true, true, true, true, true};
      EXPECT_GT(std::abs(equation_7(both, p, start, end, step, all) - exact), 0.1);
    }
  }
}

}  // namespace
}  // namespace nlmech::laier_test::errata_residual_test
