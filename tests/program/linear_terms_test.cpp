/// Linear terms and harmonic loads of typed equations, against what one reads in them.
#include "nlmech/program/linear_terms.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/problem.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::program::linear_terms_test {
namespace {

using nlmech::tests::between;
using nlmech::tests::epsilon;

ivp::System system_of(const std::string& text, const Settings& settings = {}) {
  return ivp::System(Problem(Equations({"test", text}, settings)));
}

LinearTerms terms_of(const std::string& text) { return system_of(text).linear_terms(); }

double value(const std::vector<Harmonic>& load, int component, double t) {
  double sum = 0;
  for (const Harmonic& h : load) {
    if (h.component == component)
      sum += h.cosine * std::cos(h.frequency * t) + h.sine * std::sin(h.frequency * t);
  }
  return sum;
}

TEST(LinearTerms, AreMultipliedOut) {
  const LinearTerms found =
      terms_of("x'' + 0.5 x' + 4 x + 3 x^3 = (1 - x^2) (2 y + 7); y'' = x - (y - 1)/8 + sin(y)");
  Eigen::Matrix4d a;  // x, y, x', y'
  a << 0, 0, 1, 0, 0, 0, 0, 1, -4, 2, -0.5, 0, 1, -0.125, 0, 0;
  EXPECT_EQ(found.a, a);
  ASSERT_EQ(found.load.size(), 2U);
  EXPECT_EQ(found.load[0].component, 2);
  EXPECT_EQ(found.load[0].frequency, 0);
  EXPECT_EQ(found.load[0].cosine, 7);
  EXPECT_EQ(found.load[1].component, 3);
  EXPECT_EQ(found.load[1].cosine, 0.125);
}

// Sines of numbers are the library's on one side and the compiler's on the other.
TEST(LinearTerms, HarmonicsHaveFrequenciesAndPhases) {
  const LinearTerms found =
      terms_of("x' = 2 cos(3 t + 0.25) - sin(5 t)/4 + cos(1) + t sin(t) + cos(t^2) + x cos(t) - x/(x^2 + 1)");
  EXPECT_EQ(found.a.norm(), 0);
  ASSERT_EQ(found.load.size(), 3U);
  EXPECT_DOUBLE_EQ(found.load[0].cosine, std::cos(1.0));
  EXPECT_EQ(found.load[1].frequency, 3);
  EXPECT_DOUBLE_EQ(found.load[1].cosine, 2 * std::cos(0.25));
  EXPECT_DOUBLE_EQ(found.load[1].sine, -2 * std::sin(0.25));
  EXPECT_EQ(found.load[2].frequency, 5);
  EXPECT_EQ(found.load[2].cosine, 0);
  EXPECT_EQ(found.load[2].sine, -0.25);
}

// A term whose factor overflows stays among those that are not solved exactly.
TEST(LinearTerms, AreFinite) {
  const LinearTerms found = terms_of("x' = 1e200 (1e200 (x + 1)) + y; y' = 0");
  EXPECT_EQ(found.a, (Eigen::Matrix2d() << 0, 1, 0, 0).finished());
  EXPECT_TRUE(found.load.empty());
}

// A polynomial in the state whose only terms of the time alone are harmonics: its linear terms are the
// Jacobian at the origin, its load is the right-hand side there.
RC_GTEST_PROP(LinearTerms, AreTheDerivativeOfAPolynomialAtTheOrigin, ()) {
  const Settings set = {{"a", *between(-2, 2)},
                        {"b", *between(-2, 2)},
                        {"w", *between(0, 3)},
                        {"p", *between(-3, 3)},
                        {"f", *between(-2, 2)}};
  const ivp::System system = system_of(
      "x'' = a (1 - x^2) x' + b (x + 2 (y - x)/3) - x^3 + f sin(w t + p) + (2 + y) (3 - x'); "
      "y' = y (x - b) + (1 + y^2) (1 - (cos(p - w t) - a)/3) + t x",
      set);
  const LinearTerms found = system.linear_terms();
  ivp::Jacobian jacobian;
  ivp::State slopes;
  system.jacobian(0, ivp::State::Zero(3), jacobian);
  const double t = *between(0, 5);
  system.rhs(t, ivp::State::Zero(3), slopes);
  // Of y: (1 + y^2) has no linear term, and cos times y^2 is no load.
  RC_ASSERT((found.a - jacobian).cwiseAbs().maxCoeff() <= 64 * epsilon);
  // Arguments up to 20 radians.
  for (int i = 0; i < 3; ++i) RC_ASSERT(std::abs(value(found.load, i, t) - slopes[i]) <= 256 * epsilon);
}

// A part that stands in many places is looked at once: 2^60 paths lead to x here.
TEST(LinearTerms, OfSharedPartsTakeNoTime) {
  std::string text = "x' = a60; a0 = x";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    text += "; a" + std::to_string(i) + " = (" + before + " + sin(" + before + ") + " + before + ")/2";
  }
  EXPECT_EQ(system_of(text).linear_terms().a(0, 0), 1);
}

// Announced, in the direction of travel; what depends on the state is still a switch.
TEST(KnownTimes, AreAnnounced) {
  using Times = std::vector<double>;
  const ivp::System ramp = system_of("x' = max(0, t - 1) - 2 max(t - 2, 0) + sign(3 - t) + abs(t)");
  EXPECT_EQ(ramp.switches(), 0);
  EXPECT_EQ(ramp.discontinuities(-1, 5), (Times{0, 1, 2, 3}));
  EXPECT_EQ(ramp.discontinuities(2.5, -1), (Times{2, 1, 0}));
  ivp::State f;
  ramp.rhs(3, {0}, f);
  EXPECT_EQ(f[0], 2 - 2 - 1 + 3) << "the limit from the right";
  const ivp::System both = system_of("x'' = -sign(x') + max(0, t - 1)");
  EXPECT_EQ(both.switches(), 1);
  EXPECT_EQ(both.discontinuities(0, 5), (Times{1}));
  const ivp::System mode = both.in_mode({1});
  mode.rhs(3, {0, 1}, f);
  EXPECT_EQ(f, (ivp::State{1, 1}));
  EXPECT_EQ(mode.discontinuities(0, 5), (Times{1}));
  EXPECT_EQ(system_of("x' = max(x, t)").switches(), 1);
}

}  // namespace
}  // namespace nlmech::program::linear_terms_test
