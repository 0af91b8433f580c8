/// State-transition matrices against closed forms, conserved quantities and differences; partial derivatives
/// of Lambert's problem; square roots of covariances.
#include "nlmech/orbit/transition.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/orbit/covariance.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/transfer/lambert_partials.hpp"
#include "tests/orbit/oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::orbit::transition_test {
namespace {

using namespace oracle;
using Six = Vector<double, 6>;
using Matrix6 = TransitionMatrix;

Six joined(const State& s) {
  Six x;
  x << s.position, s.velocity;
  return x;
}
Six slopes(const State& s, const Gravity& gravity) {
  Six f;
  f << s.velocity, acceleration(s.position, gravity);
  return f;
}
Matrix6 symplectic_unit() {
  Matrix6 j = Matrix6::Zero();
  j.topRightCorner<3, 3>().setIdentity();
  j.bottomLeftCorner<3, 3>() = -j.topRightCorner<3, 3>();
  return j;
}

/// Largest defect of what every transition matrix of a field satisfies, in eps of the sum of its terms:
/// symplectic; time translation, Phi f(x_0) = f(x); rotations about z (about all axes for a point mass); the
/// gradient of the energy.
double invariant_defect(const State& start, const State& end, const Matrix6& phi, const Gravity& gravity) {
  const Matrix6 j = symplectic_unit();
  double worst = (phi.transpose() * j * phi - j).norm() / (phi.norm() * phi.norm());
  const auto add = [&](const Six& before, const Six& after) {
    const double terms = (phi.cwiseAbs() * before.cwiseAbs()).norm() + after.norm();
    worst = std::max(worst, (phi * before - after).norm() / terms);
  };
  add(slopes(start, gravity), slopes(end, gravity));
  for (int axis = gravity.degree() == 0 ? 0 : 2; axis < 3; ++axis) {
    const Vector3<double> w = Vector3<double>::Unit(axis);
    add(joined({cross(w, start.position), cross(w, start.velocity)}),
        joined({cross(w, end.position), cross(w, end.velocity)}));
  }
  const Six after = j * slopes(end, gravity), before = j * slopes(start, gravity);  // grad E = -J f
  const double terms = (phi.transpose().cwiseAbs() * after.cwiseAbs()).norm() + before.norm();
  return std::max(worst, (phi.transpose() * after - before).norm() / terms) / eps;
}

/// Scaling: with lengths times a and velocities times a the motion for mu a^3 is scaled; with times times a
/// and velocities over a that for mu/a^2. Derivatives at a = 1.
double scaling_defect(const State& s, const KeplerTransition& k, double time, double mu) {
  const Six before = joined(s), after = joined(k.state);
  const Six lengths = k.transition * before + 3 * mu * k.by_mu - after;
  Six slower = -time * k.by_time + 2 * mu * k.by_mu;
  slower += k.transition.rightCols<3>() * s.velocity;
  slower.tail<3>() -= k.state.velocity;
  const double terms = (k.transition.cwiseAbs() * before.cwiseAbs()).norm() + mu * k.by_mu.norm() +
                       after.norm() + std::abs(time) * k.by_time.norm();
  return std::max(lengths.norm(), slower.norm()) / (terms * eps);
}

/// All identities on one orbit with |r| = 1 and mu = 1, in kappa.
double defect(const State& s, double time) {
  const KeplerTransition k = kepler_transition(s, time, 1);
  EXPECT_TRUE(k.status.ok()) << k.status.text();
  EXPECT_EQ(k.by_time.head<3>(), k.state.velocity);
  const KeplerCondition kappa = kepler_condition(s, time, 1);
  return std::max(invariant_defect(s, k.state, k.transition, {}), scaling_defect(s, k, time, 1)) /
         (1 + std::max(kappa.position, kappa.velocity));
}

// 64: five products of six terms, each with the error 8 kappa eps of the matrix.
constexpr double identities = 64;

RC_GTEST_PROP(KeplerTransition, ConservesWhatTheMotionConserves, ()) {
  const State s = random_state(1, 1, *between(0, 3), *between(0, pi));
  const double time = *between(-1, 1) * std::pow(10, *between(-3, 3));
  if (!propagate_kepler(s, time, 1).status.ok()) return;
  RC_ASSERT(defect(s, time) <= identities);
}

// From the periapsis: circle, nearly parabolic on both sides, parabola, fast hyperbola, some for 1e4
// revolutions and more; at rest and thrown upwards.
TEST(KeplerTransition, EveryConic) {
  for (const double e : {0., 0.1, 1 - 1e-12, 1., 1 + 1e-12, 1e3}) {
    const State s{{0, 0.6, 0.8}, {std::sqrt(1 + e), 0, 0}};
    for (const double t : {-1e4, -1., 1e-8, 0.3, 1e2, 1e5})
      EXPECT_LE(defect(s, t), identities) << e << " " << t;
    EXPECT_EQ(kepler_transition(s, 0, 1).transition, Matrix6::Identity());
    EXPECT_EQ(kepler_transition(s, 0, 1).by_mu, Six::Zero());
  }
  for (const double v : {0., 0.5, std::sqrt(2.), 3.})
    EXPECT_LE(defect({{0, 0.6, 0.8}, {0, 0.6 * v, 0.8 * v}}, 0.4), identities) << v;
}

// One step or two, and back.
RC_GTEST_PROP(KeplerTransition, Composition, ()) {
  const State s = random_state(1, 1, *between(0.3, 2), *between(0.3, 2.8));
  const double first = *between(-8, 8), second = *between(-8, 8);
  const KeplerTransition a = kepler_transition(s, first, 1), b = kepler_transition(a.state, second, 1),
                         whole = kepler_transition(s, first + second, 1),
                         back = kepler_transition(a.state, -first, 1);
  if (!a.status.ok() || !b.status.ok() || !whole.status.ok() || !back.status.ok()) return;
  const double kappa = kepler_condition(s, first, 1).velocity * kepler_condition(a.state, second, 1).velocity;
  RC_ASSERT((b.transition * a.transition - whole.transition).norm() <=
            64 * kappa * eps * b.transition.norm() * a.transition.norm());
  RC_ASSERT((back.transition * a.transition - Matrix6::Identity()).norm() <=
            64 * kappa * eps * back.transition.norm() * a.transition.norm());
}

// Circle of radius 1 with mu = 1: the matrix of Clohessy and Wiltshire, J. Aerospace Sci. 27 (1960) 653, in
// the rotating frame, here transformed to the inertial one. After 1e4 revolutions too, whose terms grow with
// t.
TEST(KeplerTransition, OfACircleIsThatOfClohessyAndWiltshire) {
  for (const double t : {-2., 0.5, 3., 2 * pi * 1e4 + 1}) {
    const double s = std::sin(t), c = std::cos(t);
    Matrix6 relative;                                       // x outwards, y forwards, z; relative velocities
    relative << 4 - 3 * c, 0, 0, s, 2 * (1 - c), 0,         //
        6 * (s - t), 1, 0, -2 * (1 - c), 4 * s - 3 * t, 0,  //
        0, 0, c, 0, 0, s,                                   //
        3 * s, 0, 0, c, 2 * s, 0,                           //
        -6 * (1 - c), 0, 0, -2 * s, 4 * c - 3, 0,           //
        0, 0, -s, 0, 0, c;
    Matrix6 to_relative = Matrix6::Identity();  // v_relative = v - z x r
    to_relative(3, 1) = 1, to_relative(4, 0) = -1;
    Matrix6 from_relative = Matrix6::Identity();
    from_relative(3, 1) = -1, from_relative(4, 0) = 1;
    Matrix6 turn = Matrix6::Identity();
    for (const int i : {0, 3})
      turn(i, i) = c, turn(i, i + 1) = -s, turn(i + 1, i) = s, turn(i + 1, i + 1) = c;
    const Matrix6 exact = turn * from_relative * relative * to_relative;
    const KeplerTransition k = kepler_transition({{1, 0, 0}, {0, 1, 0}}, t, 1);
    // t eps of the phase, times the growth of the entries.
    EXPECT_LE((k.transition - exact).norm(), 8 * eps * (1 + std::abs(t)) * exact.norm()) << t;
  }
}

// Straight parabola r = (9 mu/2)^(1/3) T^(2/3), T the time since the centre, for mu = 2, r_0 = 1, v_0 = 2 and
// T_0 = 1/3: deviations satisfy y'' = -(2/9) y/T^2 across and x'' = (4/9) x/T^2 along, with the solutions
// T^(1/3) and T^(2/3), T^(4/3) and T^(-1/3).
TEST(KeplerTransition, OfAStraightParabolaHasPowersOfTime) {
  const auto powers = [](double p, double q, double t0, double t1) {
    Matrix<double, 2> before, after;
    before << std::pow(t0, p), std::pow(t0, q), p * std::pow(t0, p - 1), q * std::pow(t0, q - 1);
    after << std::pow(t1, p), std::pow(t1, q), p * std::pow(t1, p - 1), q * std::pow(t1, q - 1);
    return Matrix<double, 2>(after * before.inverse());
  };
  for (const double t : {-0.3, 0.2, 5., 1e4}) {
    const KeplerTransition k = kepler_transition({{0, 1, 0}, {0, 2, 0}}, t, 2);
    ASSERT_TRUE(k.status.ok());
    const double last = 1. / 3 + t, kappa = kepler_condition({{0, 1, 0}, {0, 2, 0}}, t, 2).velocity;
    for (int axis = 0; axis < 3; ++axis) {
      const Matrix<double, 2> exact =
          axis == 1 ? powers(4. / 3, -1. / 3, 1. / 3, last) : powers(1. / 3, 2. / 3, 1. / 3, last);
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j)
          EXPECT_NEAR(k.transition(3 * i + axis, 3 * j + axis), exact(i, j),
                      16 * eps * (1 + kappa) * exact.row(i).norm())
              << t << " " << axis;
      }
    }
  }
}

TEST(KeplerTransition, FailuresAreThoseOfTheMotion) {
  EXPECT_EQ(kepler_transition(low_orbit, 1e100, earth_mu).status.outcome(), Outcome::outside_validity);
  EXPECT_EQ(kepler_transition({{1, 0, 0}, {0, 1e155, 0}}, 1, 1).status.outcome(), Outcome::outside_validity);
  EXPECT_THROW((void)kepler_transition({{0, 0, 0}, {1, 0, 0}}, 1, 1), std::invalid_argument);
  EXPECT_THROW((void)kepler_transition(low_orbit, NAN, 1), std::invalid_argument);
}

// Units change no digit but by powers of two.
TEST(KeplerTransition, ExtremeUnits) {
  const State s{{1, 0.5, 0.25}, {-0.5, 0.75, 0.125}};
  const KeplerTransition here = kepler_transition(s, 3, 1);
  const double length = 0x1p+500, time = 0x1p+600;
  const KeplerTransition far =
      kepler_transition({s.position * length, s.velocity * (length / time)}, 3 * time, std::ldexp(1, 300));
  ASSERT_TRUE(far.status.ok()) << far.status.text();
  Matrix6 scaled = far.transition;
  scaled.topRightCorner<3, 3>() /= time;
  scaled.bottomLeftCorner<3, 3>() *= time;
  EXPECT_LE((scaled - here.transition).norm(), 16 * eps * here.transition.norm());
  EXPECT_LE((far.by_mu.head<3>() * std::ldexp(1, 300 - 500) - here.by_mu.head<3>()).norm(),
            16 * eps * here.by_mu.norm());
}

// ---- By series.

// Of a field so weak that it is a point mass.
RC_GTEST_PROP(SeriesTransition, WithoutAnEffectOfTheFieldIsKeplers, ()) {
  const State s = random_state(1, 1, *between(0.8, 1.6), *between(1.2, 1.9));
  const double time = *between(-30, 30);
  const KeplerTransition k = kepler_transition(s, time, 1);
  const TransitionSolution c = propagate_transition(s, 0, time, {.zonal = {1e-40}});
  if (!k.status.ok() || !c.end.status.ok()) return;
  const double kappa = kepler_condition(s, time, 1).velocity;
  RC_ASSERT((c.transition - k.transition).norm() <=
            static_cast<double>(c.end.statistics.steps + 4) * 4 * eps * kappa * k.transition.norm());
}

// J_2 to J_6, thousand times those of the Earth: against differences in 34 digits, and the conserved
// quantities.
TEST(SeriesTransition, OfZonalFields) {
  using Quad = ExtendedReal<34>;
  Gravity g{.mu = 1, .radius = 1, .zonal = {1e-2, -2e-3, -1.6e-3, -2.3e-4, 5.4e-4}};
  const State start{{1.2, 0.1, -0.3}, {0.1, 0.5, 0.7}};
  const double time = 9;
  for (const int degree : {6, 2, 3, 4, 5, 0}) {
    for (int k = degree + 1; k <= 6; ++k)
      if (k >= 2) g.zonal[static_cast<std::size_t>(k - 2)] = 0;
    const TransitionSolution c = propagate_transition(start, 0, time, g);
    ASSERT_TRUE(c.end.status.ok()) << c.end.status.text();
    EXPECT_EQ(c.end.x.position, propagate(start, 0, time, g).x.position);
    EXPECT_LE(invariant_defect(start, c.end.x, c.transition, g),
              20 * static_cast<double>(c.end.statistics.steps));
    if (degree != 6) continue;
    const Quad part(1e-11);  // second-order differences: 1e-22 of third derivatives
    for (int j = 0; j < 6; ++j) {
      const auto end = [&](const Quad& change) {
        auto s = as<Quad>(start);
        (j < 3 ? s.position[j] : s.velocity[j - 3]) += change;
        return continue_analytically<Quad>(s, Quad(time), g.as<Quad>(), 30, Quad(1e-27));
      };
      const auto above = end(part), below = end(-part);
      for (int i = 0; i < 6; ++i) {
        const Quad difference = i < 3 ? Quad(above.position[i] - below.position[i])
                                      : Quad(above.velocity[i - 3] - below.velocity[i - 3]);
        EXPECT_NEAR(c.transition(i, j), static_cast<double>(Quad(difference / (2 * part))),
                    1e-13 * c.transition.norm())
            << i << j;
      }
    }
  }
}

// Results between, backwards, with a large tolerance whose steps the matrix halves; failures.
TEST(SeriesTransition, TimesAndFailures) {
  const std::vector<double> times = {-1, -2.5, -4};
  std::vector<double> seen;
  const State s = at_periapsis(0.2);
  const Gravity weak{.zonal = {1e-40}};
  const TransitionSolution c =
      propagate_transition(s, 0, -4, weak, {}, times, [&](double t, const State& x, const Matrix6& phi) {
        const KeplerTransition k = kepler_transition(s, t, 1);
        EXPECT_LE((phi - k.transition).norm(), 1e-13 * k.transition.norm()) << t;
        EXPECT_LE((x.position - k.state.position).norm(), 1e-13);
        seen.push_back(t);
        return true;
      });
  EXPECT_TRUE(c.end.status.ok());
  EXPECT_EQ(seen, times);
  const Matrix6 exact = kepler_transition(s, 40, 1).transition;
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const TransitionSolution rough = propagate_transition(s, 0, 40, weak, {.tolerance = tolerance});
    EXPECT_LE((rough.transition - exact).norm(), 1e3 * tolerance * exact.norm()) << tolerance;
  }
  const auto stop = [](double, const State&, const Matrix6&) { return false; };
  EXPECT_EQ(propagate_transition(s, 0, -4, {}, {}, times, stop).end.status.outcome(), Outcome::interrupted);
  for (const Gravity& g : {Gravity{.mu = 1}, weak})
    EXPECT_EQ(propagate_transition({{1, 0, 0}, {0, 0, 0}}, 0, 5, g).end.status.outcome(), Outcome::collision);
}

// ---- Lambert's problem.

// The action S(r_1, r_2, t) has v_2 = dS/dr_2, v_1 = -dS/dr_1 and the energy -dS/dt, so derivatives are
// symmetric.
TEST(LambertPartials, AreThoseOfAnAction) {
  const TransferProblem p{{2.87e6, 5.19e6, 2.85e6}, {2.09e6, 7.82e6, 0}, 4320, {.mu = 3.986e14}};
  for (const Gravity& gravity : {p.gravity, Gravity{3.986e14, 6378137, {1.08262668e-3, -2.5e-6}}}) {
    for (const LambertArc& arc : {LambertArc{}, LambertArc{true}, LambertArc{false, 1, LambertBranch::low},
                                  LambertArc{false, 1, LambertBranch::high}}) {
      const TransferProblem q{p.from, p.to, p.time, gravity};
      const Transfer t = corrected_transfer(q, arc);
      ASSERT_TRUE(t.status.ok());
      const LambertPartials d = lambert_partials(q, t.v1);
      ASSERT_TRUE(d.status.ok()) << d.status.text();
      EXPECT_EQ(d.v2_by_r1, -d.v1_by_r2.transpose());
      for (const auto& m : {d.v1_by_r1, d.v2_by_r2})
        EXPECT_LE((m - m.transpose()).norm(), 1e-12 * d.condition * m.norm());
      // A later arrival at the place that is reached then: dv_2/dt + (dv_2/dr_2) v_2 is the acceleration.
      EXPECT_LE((d.v2_by_r2 * t.v2 + d.v2_by_time - acceleration(q.to, gravity)).norm(),
                1e-12 * d.condition * d.v2_by_time.norm());
    }
  }
}

TEST(LambertPartials, AreRefusedWhereTheyAreInfinite) {
  const TransferProblem half{{1, 0, 0}, {-1, 0, 0}, pi, {}, Vector3<double>(0, 0, 1)};
  const LambertSolution s = solve_lambert({half.from, half.to, half.time, 1, half.normal});
  ASSERT_TRUE(s.status.ok());
  const LambertPartials d = lambert_partials(half, s.v1);
  EXPECT_EQ(d.status.outcome(), Outcome::singular_matrix);
  EXPECT_TRUE(tests::holds(d.status.sentence(), "180 degrees"));
  EXPECT_EQ(d.v1_by_r2, (Matrix<double, 3>::Zero()));
  // The condition of a fold grows with the inverse square root of the distance in time.
  const LambertProblem plain{{1, 0, 0}, {0.5, 1.5, 0.2}, 1, 1};
  const double least = least_time(plain, false, 1);
  const auto condition = [&](double above) {
    const TransferProblem p{plain.from, plain.to, least * (1 + above), {}};
    return lambert_partials(p, solve_lambert({p.from, p.to, p.time, 1}, {false, 1}).v1).condition;
  };
  EXPECT_NEAR(condition(1e-9) / condition(1e-7), 10, 0.1);
  EXPECT_EQ(lambert_partials({{1, 0, 0}, {0, 1, 0}, 5, {}}, {0, 1e-9, 0}).status.outcome(),
            propagate_kepler({{1, 0, 0}, {0, 1e-9, 0}}, 5, 1).status.outcome());
}

// ---- Covariances.

TEST(Covariance, HasARoot) {
  Matrix6 any = Matrix6::Random();
  const Matrix6 scales = Six(1e3, 1e3, 1e2, 1e-3, 1, 0).asDiagonal();  // units, and a variance of 0
  Matrix6 root;
  for (const int rank : {6, 3, 1}) {
    any.rightCols(6 - rank).setZero();
    const Matrix6 covariance = scales * any * any.transpose() * scales;
    const auto fault = root_of_covariance(covariance, root);
    ASSERT_FALSE(fault) << fault->why;
    EXPECT_TRUE(root.isLowerTriangular(0));
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        // 1e-6: the square root of the variance that counts as 0.
        EXPECT_NEAR((root * root.transpose())(i, j), covariance(i, j),
                    (rank == 6 ? 32 * eps : 1e-11) * std::sqrt(covariance(i, i) * covariance(j, j)));
  }
}

TEST(Covariance, FaultsHaveTheirPlace) {
  const auto fault = [](int i, int j, double value, double mirrored) {
    Matrix6 p = Matrix6::Identity(), root;
    p(i, j) = value, p(j, i) = mirrored;
    const auto found = root_of_covariance(p, root);
    return found ? std::to_string(found->row) + std::to_string(found->column) + " " + found->why
                 : std::string("none");
  };
  EXPECT_EQ(fault(2, 1, 0.5, 0.5), "none");
  EXPECT_EQ(fault(2, 2, -1, -1), "22 the variance -1 is negative");
  EXPECT_EQ(fault(4, 1, 0.5, 0.25), "41 0.5 differs from 0.25, the entry across the diagonal");
  EXPECT_TRUE(tests::holds(fault(3, 1, 2, 2), "33 the variance 1 is too small"));
  EXPECT_TRUE(tests::holds(fault(3, 1, 2, 2), "negative eigenvalue"));
}

}  // namespace
}  // namespace nlmech::orbit::transition_test
