/// @file
/// Shared by the tests of Lambert's problem: random problems, and the measure of a miss.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::oracle {

/// The constant of the error bound of solve_lambert().
inline constexpr double promised = 8;

/// Eq. 5.38 of Elgohary 2015, in metres and seconds.
inline LambertProblem printed() { return {{2.87e6, 5.19e6, 2.85e6}, {2.09e6, 7.82e6, 0}, 4320, 3.986e14}; }

/// The larger of the position miss over kappa eps |r_2| and the error of v_2 over kappa eps |v_2|.
inline double miss(const LambertProblem& p, const LambertSolution& s) {
  const State start{p.from, s.v1};
  const KeplerSolution end = propagate_kepler(start, p.time, p.mu);
  const KeplerCondition kappa = kepler_condition(start, p.time, p.mu);
  EXPECT_TRUE(end.status.ok()) << end.status.text();
  return std::max((end.state.position - p.to).norm() / (kappa.position * p.to.norm()),
                  (end.state.velocity - s.v2).norm() / (kappa.velocity * s.v2.norm())) /
         eps;
}

/// The same with Kepler's equation solved in 50 digits.
inline double exact_miss(const LambertProblem& p, const LambertSolution& s) {
  const State start{p.from, s.v1};
  const auto end = kepler(start, p.time, p.mu);
  const KeplerCondition kappa = kepler_condition(start, p.time, p.mu);
  return std::max(relative_distance(p.to, end.position) / kappa.position,
                  relative_distance(s.v2, end.velocity) / kappa.velocity) /
         eps;
}

/// Kinds: any; down to 1e-12 from 180 degrees; from 0 and 360 degrees; equal distances; any.
inline LambertProblem random_problem(std::mt19937_64& engine, int kind) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto direction = [&] {
    return Vector3<double>(normal(engine), normal(engine), normal(engine)).normalized();
  };
  LambertProblem p;
  p.from = direction();
  Vector3<double> to = direction();
  const double near = std::pow(10, -12 * uniform(engine));
  if (kind == 1) to = (near * to - p.from).normalized();  // down to 1e-12 from 180 degrees
  if (kind == 2) to = (near * to + p.from).normalized();  // and from 0 and 360 degrees
  const double ratio = std::pow(10, 2 * uniform(engine) - 1);
  p.to = kind == 3 ? to : Vector3<double>(ratio * to);  // r_1 = r_2
  p.time = std::pow(10, -2 + 5 * uniform(engine));
  return p;
}

}  // namespace nlmech::orbit::oracle
