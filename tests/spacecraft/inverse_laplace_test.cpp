/// Numerical inverse Laplace transforms against pairs of the tables.
#include "nlmech/spacecraft/control/inverse_laplace.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace nlmech::spacecraft::inverse_laplace_test {
namespace {

using Complex = std::complex<double>;

struct Pair {
  const char* name;
  Transform transform;
  std::function<double(double)> function;
};

const std::array<Pair, 4>& smooth_pairs() {
  static const std::array<Pair, 4> pairs = {
      Pair{"exponential", [](Complex s) { return 1. / (s + 1.); }, [](double t) { return std::exp(-t); }},
      Pair{"ramp", [](Complex s) { return 1. / (s * s); }, [](double t) { return t; }},
      Pair{"root", [](Complex s) { return 1. / std::sqrt(s); },
           [](double t) { return 1 / std::sqrt(std::numbers::pi * t); }},
      Pair{"sine", [](Complex s) { return 1. / (s * s + 1.); }, [](double t) { return std::sin(t); }}};
  return pairs;
}

// Abate and Valko: about 0.6 M digits, M being the nodes, less what e^(2M/5) eps of rounding takes: with 24
// nodes the former is below the latter, 1.5e4 eps = 3e-12, times a few for the sum.
TEST(Talbot, InvertsSmoothFunctions) {
  for (const Pair& pair : smooth_pairs()) {
    for (const double t : {0.01, 1., 3.}) {
      const double exact = pair.function(t);
      const Inverted f = talbot(pair.transform, t);
      EXPECT_TRUE(f.status.ok()) << pair.name << " at " << t << ": " << f.status.text();
      EXPECT_NEAR(f.value, exact, 1e-9 * std::max(1., std::abs(exact))) << pair.name << " at " << t;
      EXPECT_EQ(talbot_sum(pair.transform, t), f.value);
    }
  }
}

// The contour with M nodes holds |Im s| below about M/t: faster oscillations are lost, whole, which is said.
TEST(Talbot, MissesFastOscillations) {
  const Transform fast = [](Complex s) { return 100. / (s * s + 1e4); };
  EXPECT_GT(std::abs(talbot_sum(fast, 1.) - std::sin(100.)), 0.1);
  const Inverted f = talbot(fast, 1.);
  EXPECT_EQ(f.status.outcome(), Outcome::not_converged);
  EXPECT_NE(f.status.sentence().find("residues"), std::string::npos) << f.status.sentence();
}

/// 1 - a cos(wt), of which an inversion that does not see w gives 1.
Transform about_one(double w, double a = 1) {
  return [w, a](Complex s) { return 1. / s - a * s / (s * s + w * w); };
}

// Frequencies from far below those of the contour to 1e9 times them: right, or refused.
TEST(Talbot, NeverTakesAMeanForAnOscillation) {
  int right = 0;
  for (double w = 0.01; w < 1e10; w *= 1.9) {
    for (const double a : {1., 1e-4}) {
      const Inverted f = talbot(about_one(w, a), 1);
      const double exact = 1 - a * std::cos(w);
      if (!f.status.ok()) {
        EXPECT_EQ(f.status.outcome(), Outcome::not_converged) << f.status.text();
        EXPECT_GT(w, 5) << "well within the contour";
        continue;
      }
      ++right;
      EXPECT_NEAR(f.value, exact, 2e-6 * std::abs(exact)) << w << " and " << a;
    }
  }
  EXPECT_GE(right, 15);
}

// 1 + 0.15 t sin(100 t): the double pole has no residue at all.
TEST(Talbot, SeesADoublePoleBeyondTheContour) {
  const Transform f = [](Complex s) { return 1. / s + 30. * s / ((s * s + 1e4) * (s * s + 1e4)); };
  EXPECT_NEAR(talbot_sum(f, 1), 1, 1e-3) << "what is refused";
  EXPECT_EQ(talbot(f, 1).status.outcome(), Outcome::not_converged);
}

// The function begins when the contour's factor e^(st) overcomes e^(-s): before it the sum is a number
// without meaning, and what is left of the contour has no bound.
TEST(Talbot, RefusesADelay) {
  const Transform late = [](Complex s) { return std::exp(-s) / s; };
  for (const double t : {0.5, 1., 3.}) EXPECT_FALSE(talbot(late, t).status.ok()) << t;
}

// Where f is zero no two sums agree relative to it, unless the difference is said to be negligible.
TEST(Talbot, TakesWhatIsNegligibleForZero) {
  const Transform sine = [](Complex s) { return 1. / (s * s + 1.); };
  EXPECT_EQ(talbot(sine, std::numbers::pi).status.outcome(), Outcome::not_converged);
  const Inverted zero = talbot(sine, std::numbers::pi, {.negligible = 1e-8});
  EXPECT_TRUE(zero.status.ok()) << zero.status.text();
  EXPECT_NEAR(zero.value, 0, 1e-8);
}

TEST(Talbot, RefusesBadInput) {
  const Transform f = [](Complex s) { return 1. / s; };
  for (const double t : {0., -1., std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW((void)talbot(f, t), std::invalid_argument) << t;
  EXPECT_THROW((void)talbot(f, 1, {.nodes = 1}), std::invalid_argument);
  EXPECT_THROW((void)talbot(f, 1, {.agreement = 0}), std::invalid_argument);
  EXPECT_THROW((void)talbot(f, 1, {.negligible = -1}), std::invalid_argument);
  EXPECT_THROW((void)talbot_sum(f, 1, 201), std::invalid_argument);
}

TEST(Talbot, SaysWhereATransformIsNotFinite) {
  const Inverted f =
      talbot([](Complex s) { return std::abs(s.imag()) > 3 ? Complex(std::nan("")) : 1. / s; }, 1);
  EXPECT_EQ(f.status.outcome(), Outcome::non_finite);
  EXPECT_NE(f.status.sentence().find("s ="), std::string::npos) << f.status.sentence();
  EXPECT_EQ(f.value, 0);
}

}  // namespace
}  // namespace nlmech::spacecraft::inverse_laplace_test
