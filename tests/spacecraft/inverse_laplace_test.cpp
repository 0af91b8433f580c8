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

// The function begins when the contour's factor e^(st) overcomes e^(-s): before it the sum is a number
// without meaning, and what is left of the contour has no bound.
TEST(InverseLaplace, RefusesADelay) {
  const Transform late = [](Complex s) { return std::exp(-s) / s; };
  for (const double t : {0.5, 1., 3.}) {
    EXPECT_FALSE(talbot(late, t).status.ok()) << t;
    EXPECT_FALSE(de_hoog(late, t).status.ok()) << t;
  }
}

TEST(DeHoog, InvertsSmoothFunctions) {
  for (const Pair& pair : smooth_pairs()) {
    for (const double t : {0.01, 1., 3.}) {
      const double exact = pair.function(t);
      // The aliasing that is allowed, times the growth of f over the period 4 t.
      const Inverted f = de_hoog(pair.transform, t);
      EXPECT_TRUE(f.status.ok()) << f.status.text();
      EXPECT_NEAR(f.value, exact, 1e-8 * std::max(1., std::abs(exact))) << pair.name << " at " << t;
    }
  }
}

TEST(DeHoog, NeedsMoreTermsForFasterOscillations) {
  const Transform fast = [](Complex s) { return 20. / (s * s + 400.); };
  EXPECT_GT(std::abs(de_hoog(fast, 1., {.degree = 4}).value - std::sin(20.)), 1e-2);
  EXPECT_NEAR(de_hoog(fast, 1., {.degree = 30}).value, std::sin(20.), 1e-7);
}

// The continued fraction of an undamped sine of 100 rad/s: too few frequencies at low degrees, beyond
// that rounding. No success may be wrong by more than the agreement that was asked for, of the amplitude.
TEST(DeHoog, SaysWhereTwoSumsDoNotAgree) {
  const Transform fast = [](Complex s) { return 100. / (s * s + 1e4); };
  int failures = 0;
  for (const int degree : {20, 40, 80, 120, 240}) {
    for (const double t : {0.5, 1., 2.}) {
      const Inverted f = de_hoog(fast, t, {.degree = degree});
      if (f.status.ok()) {
        EXPECT_NEAR(f.value, std::sin(100 * t), 1e-4) << degree << " at " << t;
      } else {
        ++failures;
        EXPECT_EQ(f.status.outcome(), Outcome::not_converged) << f.status.text();
        const std::string& why = f.status.sentence();
        EXPECT_TRUE(why.find("two sums") != std::string::npos || why.find("residues") != std::string::npos)
            << why;
      }
    }
  }
  EXPECT_GT(failures, 0) << "the comparison measures nothing";
}

// 1 - cos(wt) at t = 1, where all depends on wt and the degree alone: the highest frequency is M pi. Right,
// or refused; and right where that is well above w.
TEST(DeHoog, NeverTakesAMeanForAnOscillation) {
  int right = 0;
  for (const int degree : {10, 20, 40, 80}) {
    for (double w = 1; w < 1e7; w *= w < degree ? 1.1 : 3.3) {
      const Inverted f = de_hoog(about_one(w), 1, {.degree = degree});
      const double exact = 1 - std::cos(w);
      if (!f.status.ok()) {
        EXPECT_EQ(f.status.outcome(), Outcome::not_converged) << f.status.text();
        continue;
      }
      ++right;
      EXPECT_LT(w, degree * std::numbers::pi / 4) << "beyond what is checked";
      EXPECT_NEAR(f.value, exact, 1e-3 * exact) << degree << " and " << w;
    }
  }
  EXPECT_GT(right, 40) << "of some 120 below";
  EXPECT_NEAR(de_hoog_sum(about_one(100), 1, {.degree = 20}), 1, 1e-3) << "what is refused";
}

// Where f is zero no two sums agree relative to it, unless the difference is said to be negligible.
TEST(DeHoog, TakesWhatIsNegligibleForZero) {
  const Transform sine = [](Complex s) { return 1. / (s * s + 1.); };
  EXPECT_EQ(de_hoog(sine, std::numbers::pi).status.outcome(), Outcome::not_converged);
  const Inverted zero = de_hoog(sine, std::numbers::pi, {.negligible = 1e-8});
  EXPECT_TRUE(zero.status.ok()) << zero.status.text();
  EXPECT_NEAR(zero.value, 0, 1e-8);
}

// Of 100/(s^2 + 1e4) the terms beyond W = 1e5 fall like 100/omega^2: what is left out is at most e^(ct)
// 100/W^2 / (pi t), 1e-8 here, and aliasing e^(-2cT) = 1e-13.
TEST(Bromwich, SumsOscillationsForManyTimes) {
  const Transform fast = [](Complex s) { return 100. / (s * s + 1e4); };
  const std::array<double, 4> times = {0.5, 1, 5, 20};
  const std::vector<Inverted> f = bromwich(fast, times, {.half_period = 60, .shift = 0.25, .frequency = 1e5});
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double allowed = std::exp(0.25 * times[i]) * 1e-8 / times[i] + 2e-13;
    EXPECT_NEAR(f[i].value, std::sin(100 * times[i]), 2 * allowed) << times[i];
    EXPECT_TRUE(f[i].status.ok()) << f[i].status.text();
  }
}

// A line that ends below the oscillation gives its mean; one without a shift, all periods on top of each
// other.
TEST(Bromwich, SaysWhatItLeavesOut) {
  const std::array<double, 1> times = {1};
  const Inverted low =
      bromwich(about_one(1e4), times, {.half_period = 60, .shift = 0.25, .frequency = 1000})[0];
  EXPECT_NEAR(low.value, 1, 1e-2);
  EXPECT_EQ(low.status.outcome(), Outcome::not_converged) << low.status.text();
  const Transform decay = [](Complex s) { return 1. / ((s + 0.01) * (s + 0.01)); };
  const Inverted aliased = bromwich(decay, times, {.half_period = 60, .shift = 0, .frequency = 1e5})[0];
  EXPECT_GT(std::abs(aliased.value - std::exp(-0.01)), 1);
  EXPECT_EQ(aliased.status.outcome(), Outcome::not_converged) << aliased.status.text();
}

TEST(InverseLaplace, RefusesBadInput) {
  const Transform f = [](Complex s) { return 1. / s; };
  for (const double t : {0., -1., std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW((void)talbot(f, t), std::invalid_argument) << t;
    EXPECT_THROW((void)de_hoog(f, t), std::invalid_argument) << t;
    const std::array<double, 1> times = {t};
    EXPECT_THROW((void)bromwich(f, times), std::invalid_argument) << t;
  }
  EXPECT_THROW((void)talbot(f, 1, {.nodes = 1}), std::invalid_argument);
  EXPECT_THROW((void)talbot(f, 1, {.agreement = 0}), std::invalid_argument);
  EXPECT_THROW((void)talbot(f, 1, {.negligible = -1}), std::invalid_argument);
  EXPECT_THROW((void)talbot_sum(f, 1, 201), std::invalid_argument);
  EXPECT_THROW((void)de_hoog_sum(f, 1, {.degree = 0}), std::invalid_argument);
  EXPECT_THROW((void)bromwich(f, {}, {.agreement = 0}), std::invalid_argument);
  EXPECT_THROW((void)de_hoog(f, 1, {.degree = 0}), std::invalid_argument);
  EXPECT_THROW((void)de_hoog(f, 1, {.tolerance = 0}), std::invalid_argument);
  EXPECT_THROW((void)de_hoog(f, 1, {.scale = 0.5}), std::invalid_argument);
  EXPECT_THROW((void)de_hoog(f, 1, {.agreement = 0}), std::invalid_argument);
  EXPECT_THROW((void)de_hoog(f, 1, {.negligible = -1}), std::invalid_argument);
  const std::array<double, 1> late = {121};
  EXPECT_THROW((void)bromwich(f, late), std::invalid_argument);
  EXPECT_THROW((void)bromwich(f, {}, {.frequency = 0.01}), std::invalid_argument);
}

TEST(InverseLaplace, SaysWhereATransformIsNotFinite) {
  const Transform broken = [](Complex s) { return std::abs(s.imag()) > 3 ? Complex(std::nan("")) : 1. / s; };
  const std::array<double, 1> times = {1};
  for (const Inverted& f : {talbot(broken, 1), de_hoog(broken, 1), bromwich(broken, times)[0]}) {
    EXPECT_EQ(f.status.outcome(), Outcome::non_finite);
    EXPECT_NE(f.status.sentence().find("s ="), std::string::npos) << f.status.sentence();
    EXPECT_EQ(f.value, 0);
  }
}

}  // namespace
}  // namespace nlmech::spacecraft::inverse_laplace_test
