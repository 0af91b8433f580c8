/// @file
/// Random toggles with random initial guesses, and checks of an equilibrium, for the short and the long test.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/paths/path_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::frames {

/// A toggle, a load and an initial guess.
struct RandomCase {
  Toggle toggle;
  double load;
  Eigen::VectorXd start;
  bool is_thrown;  ///< are nodes and rotations displaced at random, in addition to a smooth deflection?
};

/// Heights from 0.1 to 0.6, loads from -100 to 100, 1 to 64 elements per member, half or full model. The
/// initial guess lowers the apex by -0.3 to 1 inch; half of all cases also displace nodes at random by up to
/// 0.3 element lengths and rotate them by up to half a radian.
inline RandomCase random_case(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  RandomCase c{};
  c.toggle.height = uniform(0.1, 0.6);
  c.toggle.elements = static_cast<int>(std::pow(64.99, uniform(0, 1)));
  c.toggle.full = uniform(0, 1) < 0.5;
  c.load = uniform(-100, 100);
  c.is_thrown = uniform(0, 1) < 0.5;
  const ToggleFrame t = make_frame(c.toggle);
  c.start = Eigen::VectorXd::Zero(t.frame.size());
  const double drop = uniform(-0.3, 1), element = c.toggle.length / c.toggle.elements;
  const double half_span = -t.frame.nodes()[0].x;
  for (int i = 0; i < static_cast<int>(t.frame.nodes().size()); ++i) {
    const double s = 1 - std::abs(t.frame.nodes()[static_cast<std::size_t>(i)].x) / half_span;
    const Eigen::Index x = t.frame.unknown(i, Motion::x), y = t.frame.unknown(i, Motion::y),
                       r = t.frame.unknown(i, Motion::rotation);
    if (y >= 0) c.start[y] = -drop * s * s * (3 - 2 * s);
    if (!c.is_thrown) continue;
    for (const Eigen::Index k : {x, y}) {
      if (k >= 0) c.start[k] += 0.3 * element * uniform(-1, 1) / std::sqrt(2.);
    }
    if (r >= 0) c.start[r] += uniform(-0.5, 0.5);
  }
  return c;
}

/// Expects that x is an equilibrium to rounding: F in double and, if @p wide, in 50 digits is at most 64
/// times the effect of a change of every unknown and every axial force in its last place. If @p is_stable,
/// the Cholesky factorisation of K must exist.
inline void expect_equilibrium(Equilibrium& equations, const Eigen::VectorXd& x, bool is_stable, bool wide) {
  const double eps = std::numeric_limits<double>::epsilon();
  Eigen::VectorXd f(x.size());
  Eigen::MatrixXd k;
  equations.residual(x, f);
  equations.linearise(x);
  equations.matrix(k);
  double axial = std::abs(equations.load());
  for (std::size_t i = 0; i < equations.frame().members().size(); ++i)
    axial = std::max(axial, std::abs(equations.frame().member<double>(x, i).axial_force));
  const double floor = eps * ((k.cwiseAbs() * x.cwiseAbs()).norm() + axial);
  EXPECT_LE(f.norm(), 64 * floor);
  if (is_stable) {
    EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(k).info(), Eigen::Success);
  }
  if (!wide) return;
  using Real = ExtendedReal<50>;
  Frame::Displacements<Real> exact;
  EXPECT_TRUE(equations.frame().force<Real>(x.cast<Real>(), exact).ok());
  exact -= (equations.load() * equations.direction()).cast<Real>();
  EXPECT_LE(exact.cast<double>().norm(), 64 * floor);
}

/// Minimises the energy of random toggles and follows their paths from rest; expects verified equilibria.
inline void expect_equilibria_of_random_toggles(int cases, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < cases; ++i) {
    const RandomCase c = random_case(random);
    SCOPED_TRACE(testing::Message() << "case " << i << ": height " << c.toggle.height << ", load " << c.load
                                    << ", elements " << c.toggle.elements << ", full " << c.toggle.full
                                    << ", thrown " << c.is_thrown);
    const ToggleFrame t = make_frame(c.toggle);
    Equilibrium equations(t.frame, t.load, c.load);
    Eigen::VectorXd x = c.start;
    const algebraic::Report report = find_root(algebraic::EnergyTrustRegion{}, equations, x);
    ASSERT_TRUE(report.status.ok()) << report.status.text();
    expect_equilibrium(equations, x, true, i % 16 == 0 && c.toggle.elements <= 16);
    const auto kind = static_cast<algebraic::PathMethod::Kind>(i % 3);
    x.setZero();
    const algebraic::Report path = find_root(algebraic::ArcLength{{.kind = kind}}, equations, x);
    ASSERT_TRUE(path.status.ok()) << "path " << i % 3 << ": " << path.status.text();
    expect_equilibrium(equations, x, false, false);
  }
}

}  // namespace nlmech::frames
