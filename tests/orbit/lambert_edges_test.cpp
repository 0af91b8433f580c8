/// Lambert's problem at its edges: times to 0 and without end, nearly straight lines, units, and what is
/// refused.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/orbit/lambert_problems.hpp"

namespace nlmech::orbit::lambert_edges_test {
namespace {

using namespace oracle;

// In the limit the arc is the straight line, integrated at chord over time.
TEST(Lambert, TimeOfFlightToZero) {
  LambertProblem p{{1, 0, 0}, {0.5, 1.5, 0.2}, 1, 1};
  for (const double time : {1e-3, 1e-8, 1e-50, 1e-140}) {
    p.time = time;
    const LambertSolution s = solve_lambert(p);
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    // Attraction, about 1, changes the velocity by time, of 1/time; two roundings.
    EXPECT_LE((s.v1 * time - (p.to - p.from)).norm(), 2 * time * time + 8 * eps) << time;
    EXPECT_LE(miss(p, s), promised) << time;
  }
  p.time = 1e-200;
  const LambertSolution s = solve_lambert(p);
  EXPECT_EQ(s.status.outcome(), Outcome::outside_validity);
  EXPECT_NE(s.status.sentence().find("too short"), std::string::npos);
}

// Long flights without a revolution go far out, on an ellipse whose period is nearly the time.
TEST(Lambert, VeryLongTimeOfFlight) {
  LambertProblem p{{1, 0, 0}, {0.5, 1.5, 0.2}, 1, 1};
  for (const double time : {1e3, 1e6, 1e7}) {
    p.time = time;
    for (const bool long_way : {false, true}) {
      const LambertSolution s = solve_lambert(p, {long_way, 0, LambertBranch::low});
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      // The axis has its share of eps: 1/a = (2/r - v v/mu) is a difference of numbers near 2.
      const double axis = std::pow(time / (2 * pi), 2. / 3);
      EXPECT_NEAR(s.reciprocal_axis * axis, 1, 8 / axis + 8 * eps * axis) << time;
      EXPECT_LE(miss(p, s), promised);
    }
  }
  // An error eps of v_1 changes the axis by eps a/r and so the time by eps t^(5/3): from 1e9 on by more than
  // the way through r_2 takes.
  for (const double time : {1e9, 1e12, 1e40}) {
    p.time = time;
    const LambertSolution s = solve_lambert(p);
    EXPECT_EQ(s.status.outcome(), Outcome::outside_validity);
    EXPECT_NE(s.status.sentence().find(time < 1e40 ? "take a shorter time" : "too long"), std::string::npos);
  }
}

// Found by random problems. The first goes far out and back to a ten-thousandth of the distance, where the
// body is fast: kappa eps = 0.8. The second goes through the centre at a share of 6e-17 of its speed, on the
// other side than the one asked for; its miss in double precision is small by chance.
TEST(Lambert, WhatItsRoundedVelocityDoesNotTellIsRefused) {
  const auto refused = [](const LambertProblem& p, const char* part) {
    const LambertSolution s = solve_lambert(p, {true, 0, LambertBranch::low});
    EXPECT_EQ(s.status.outcome(), Outcome::outside_validity);
    EXPECT_NE(s.status.sentence().find(part), std::string::npos) << s.status.text();
    EXPECT_EQ(s.v1, Vector3<double>(0, 0, 0));
  };
  refused({{-0.11193731147166829, 0.021730182019204743, 0.032911956889745117},
           {-3.058896910472229e-06, 4.6244578897867204e-06, -1.0493385205964173e-05},
           4.0886124808325788e-06,
           1e20},
          "undetermined");
  refused({{201994342823.63, -179147119475.69858, 53115732916.525291},
           {250590313381.82462, -222246485635.8252, 65894361054.850693},
           15748380267.59968,
           517.46942108007534},
          "so closely");
}

// Nearly on one straight line from the centre: up and back, and once around the centre the long way.
TEST(Lambert, NearlyRectilinear) {
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12}) {
    for (const double ratio : {1., 1.5}) {
      const LambertProblem p{{1, 0, 0}, {ratio * std::cos(angle), ratio * std::sin(angle), 0}, 4, 1};
      for (const SolvedArc& a : lambert_arcs(p, 2)) {
        EXPECT_LE(exact_miss(p, a.solution), promised) << angle << " " << ratio;
      }
    }
  }
}

// All but once around, in about the time of the ellipse of least energy, 2.2214: where T(x) bends so sharply
// that the iteration has to halve its bracket. The next step after that counted as the last, by which arcs
// missed by 3e-3.
TEST(Lambert, NearlyOnceAround) {
  for (double angle = 1e-6; angle < 0.3; angle *= 1.5) {
    for (double time = 2; time < 2.6; time *= 1.002) {
      const LambertProblem p{{1, 0, 0}, {std::cos(angle), std::sin(angle), 0}, time, 1};
      const LambertSolution s = solve_lambert(p, {.long_way = true});
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      EXPECT_LE(miss(p, s), promised) << angle << " " << time;
    }
  }
}

RC_GTEST_PROP(Lambert, WayBackIsTheWayThere, ()) {
  std::mt19937_64 engine(*rc::gen::arbitrary<std::uint64_t>());
  LambertProblem p = random_problem(engine, 0);
  const LambertSolution there = solve_lambert(p);
  std::swap(p.from, p.to);
  const LambertSolution back = solve_lambert(p);
  // Each is the exact solution of a problem within promised kappa eps; time reversed it is the other's.
  const double kappa = kepler_condition({p.from, back.v1}, p.time, p.mu).velocity;
  RC_ASSERT((back.v1 + there.v2).norm() <= 4 * promised * kappa * eps * there.v2.norm());
}

// Powers of two change no digit, over all the range of doubles.
TEST(Lambert, UnitsDoNotMatter) {
  const LambertProblem p{{1, 0.25, 0}, {-0.3, 1.4, 0.2}, 7, 1};
  const LambertSolution s = solve_lambert(p, {false, 0, LambertBranch::low});
  for (const int length : {-600, -100, 0, 3, 100, 600}) {
    for (const int time : {-300, 0, 7, 300}) {
      const double mu = std::ldexp(1.0, 3 * length - 2 * time);
      if (!std::isnormal(mu)) continue;
      const double unit = std::ldexp(1.0, length);
      const LambertSolution other = solve_lambert({p.from * unit, p.to * unit, std::ldexp(p.time, time), mu});
      ASSERT_TRUE(other.status.ok()) << length << " " << time;
      const Vector3<double> expected = s.v1 * std::ldexp(1.0, length - time);
      EXPECT_LE((other.v1 / expected.norm() - expected / expected.norm()).norm(), 4 * eps)
          << length << " " << time;
    }
  }
}

TEST(Lambert, WhatCannotBeMeantIsRefused) {
  const auto refused = [](const LambertProblem& p, const LambertArc& arc = {}) {
    try {
      (void)solve_lambert(p, arc);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const Vector3<double> x(1, 0, 0), y(0, 1, 0), none(0, 0, 0);
  says(refused({none, y, 1, 1}), "the position of departure is 0");
  says(refused({x, none, 1, 1}), "the position of arrival is 0");
  says(refused({x, {0, NAN, 0}, 1, 1}), "(0, nan, 0)");
  says(refused({x, {1.7e308, 1e308, 0}, 1, 1}), "beyond the range of doubles");
  says(refused({x, y, -2, 1}), "positive and finite, not -2");
  says(refused({x, y, 0, 1}), "not 0");
  says(refused({x, y, NAN, 1}), "not nan");
  says(refused({x, y, HUGE_VAL, 1}), "not inf");
  says(refused({x, y, 1, -1}), "mu must be positive and finite, not -1");
  says(refused({x, y, 1, 1}, {false, -1, LambertBranch::low}), "0 or more, not -1");
  says(refused({x, y, 1, 1, none}), "normal must be finite and not 0");
  EXPECT_THROW((void)least_time({x, y, 1, 1}, false, 0), std::invalid_argument);
  EXPECT_TRUE(std::isnan(least_time({x, x, 1, 1}, false, 1)));
}

}  // namespace
}  // namespace nlmech::orbit::lambert_edges_test
