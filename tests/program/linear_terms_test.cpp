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

double value(const std::vector<Harmonic>& load, int component, double t) {
  double sum = 0;
  for (const Harmonic& h : load) {
    if (h.component == component)
      sum += h.cosine * std::cos(h.frequency * t) + h.sine * std::sin(h.frequency * t);
  }
  return sum;
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
  ivp::Jacobian linear, jacobian;
  ivp::State slopes;
  RC_ASSERT(system.linear_part(linear));
  system.jacobian(0, ivp::State::Zero(3), jacobian);
  const double t = *between(0, 5);
  system.rhs(t, ivp::State::Zero(3), slopes);
  // Of y: (1 + y^2) has no linear term, and cos times y^2 is no load.
  RC_ASSERT((linear - jacobian).cwiseAbs().maxCoeff() <= 64 * epsilon);
  // Arguments up to 20 radians.
  for (int i = 0; i < 3; ++i) RC_ASSERT(std::abs(value(system.load(), i, t) - slopes[i]) <= 256 * epsilon);
}

// A part that stands in many places is looked at once: 2^60 paths lead to x here.
TEST(LinearTerms, OfSharedPartsTakeNoTime) {
  std::string text = "x' = a60; a0 = x";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    text += "; a" + std::to_string(i) + " = (" + before + " + sin(" + before + ") + " + before + ")/2";
  }
  ivp::Jacobian linear;
  ASSERT_TRUE(system_of(text).linear_part(linear));
  EXPECT_EQ(linear(0, 0), 1);
}

TEST(LinearTerms, AreOnlyThoseThatStandThere) {
  ivp::Jacobian linear;
  ASSERT_TRUE(system_of("x'' = -x/(x^2 + 1) + cos(t^2) + cos(x) + t x'").linear_part(linear));
  ivp::Jacobian expected = ivp::Jacobian::Zero(2, 2);
  expected(0, 1) = 1;
  EXPECT_EQ(linear, expected);
  EXPECT_TRUE(system_of("x'' = -x/(x^2 + 1) + cos(t^2) + cos(x) + t x'").load().empty());
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
