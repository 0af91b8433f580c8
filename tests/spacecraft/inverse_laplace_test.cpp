/// Numerical inverse Laplace transforms against pairs of the tables.
#include "nlmech/spacecraft/inverse_laplace.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace nlmech::spacecraft {
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
      EXPECT_NEAR(talbot(pair.transform, t).value, exact, 1e-9 * std::max(1., std::abs(exact)))
          << pair.name << " at " << t;
    }
  }
}

// The contour with M nodes holds |Im s| below about M/t: faster oscillations are lost, whole.
TEST(Talbot, MissesFastOscillations) {
  const Transform fast = [](Complex s) { return 100. / (s * s + 1e4); };
  EXPECT_GT(std::abs(talbot(fast, 1.).value - std::sin(100.)), 0.1);
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
TEST(DeHoog, SaysWhereTwoPeriodsDoNotAgree) {
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
        EXPECT_NE(f.status.sentence().find("two periods"), std::string::npos) << f.status.sentence();
      }
    }
  }
  EXPECT_GT(failures, 0) << "the comparison measures nothing";
}

// 1 - cos(wt) at t = 1, where all depends on wt and the degree alone: the highest frequency is M pi. Where
// that is four times w and more, a success is right; below, the mean may come out (degree 20, w = 100).
TEST(DeHoog, SeesAnOscillationAboutAMeanWellBelowItsFrequencies) {
  const auto about_one = [](double w, int degree) {
    return de_hoog([w](Complex s) { return w * w / (s * (s * s + w * w)); }, 1, {.degree = degree});
  };
  int right = 0;
  for (const int degree : {10, 20, 40, 80, 120, 240}) {
    for (double w = degree * std::numbers::pi / 4; w > 1; w /= 1.05) {
      const Inverted f = about_one(w, degree);
      if (!f.status.ok()) continue;
      EXPECT_NEAR(f.value, 1 - std::cos(w), 1e-3) << degree << " and " << w;
      ++right;
    }
  }
  EXPECT_GT(right, 200) << "of 450 or so";
  EXPECT_NEAR(about_one(100, 20).value, 1, 1e-3) << "the limit that the header names";
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
  }
}

TEST(InverseLaplace, RefusesBadInput) {
  const Transform f = [](Complex s) { return 1. / s; };
  for (const double t : {0., -1., std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW((void)talbot(f, t), std::invalid_argument) << t;
    EXPECT_THROW((void)de_hoog(f, t), std::invalid_argument) << t;
    const std::array<double, 1> times = {t};
    EXPECT_THROW((void)bromwich(f, times), std::invalid_argument) << t;
  }
  EXPECT_THROW((void)talbot(f, 1, 1), std::invalid_argument);
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
}  // namespace nlmech::spacecraft
