// What problems say of themselves: the equation as text, bounds, conserved sums.
#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "nlmech/problems/arenstorf.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/dead_end.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/duffing_chain.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/kepler.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/pleiades.hpp"
#include "nlmech/problems/pollution.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/spring_pendulum.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_body.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/program/dual.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::statements_test {
namespace {

template <class Problem>
class StatementsOf : public ::testing::Test {};
using All = ::testing::Types<BlowUp, FourBodies, DrivenDuffing, Duffing, ForcedDuffing, Hires, ImpactDuffing,
                             LinearOscillator, Lorenz, Projectile, Robertson, StrongOscillator,
                             ThreeMassChain, TwoBody, TwoDof, VanDerPol, Kepler, Arenstorf, Pleiades,
                             DuffingChain, SpringPendulum, Pollution, DeadEnd, LostDomain>;
TYPED_TEST_SUITE(StatementsOf, All);

// A chain's k1 to k4 stand as kj.
TYPED_TEST(StatementsOf, EquationNamesEveryParameter) {
  const std::string text(TypeParam::equation);
  EXPECT_NE(text.find('='), std::string::npos);
  for (const char c : text) EXPECT_TRUE(c >= ' ' && c <= '~') << text;
  for (const std::string_view name : parameter_names<TypeParam>()) {
    std::string general(name.substr(0, name.find_last_not_of("0123456789") + 1));
    const bool is_named =
        text.find(name) != std::string::npos || text.find(general + "j") != std::string::npos;
    EXPECT_TRUE(is_named) << name << " is not in: " << text;
  }
}

/// Greatest rate of the invariants along the equation at @p x.
template <class Problem>
double drift(const Problem& problem, const Vector<double, Problem::dimension>& x) {
  constexpr int n = Problem::dimension;
  Vector<double, n> f;
  problem(0.0, x, f);
  Vector<Dual<double, n>, n> v;
  for (int i = 0; i < n; ++i) v[i] = Dual<double, n>::variable(x[i], i);
  const auto kept = problem.invariants(Dual<double, n>(0.0), v);
  double most = 0;
  for (int k = 0; k < kept.size(); ++k) {
    double rate = 0;
    for (int i = 0; i < n; ++i) rate += kept[k].partial[static_cast<std::size_t>(i)] * f[i];
    most = std::max(most, std::abs(rate));
  }
  return most;
}

RC_GTEST_PROP(Statements, SumsOfConcentrationsAreConserved, ()) {
  Robertson robertson;
  Hires hires{.k_plus = *between(0, 1e4)};
  Vector<double, 3> x;
  Vector<double, 8> y;
  for (int i = 0; i < 3; ++i) x[i] = *between(-1, 1);
  for (int i = 0; i < 8; ++i) y[i] = *between(-1, 1);
  // Terms up to k3 = 3e7, and to k_plus; a handful of roundings.
  RC_ASSERT(drift(robertson, x) <= 8 * 3e7 * epsilon);
  RC_ASSERT(drift(hires, y) <= 8 * 1e4 * epsilon);
}

/// A place of the plane at a distance from the origin of 0.5 to 2.
Vector<double, 2> place() {
  const double angle = *between(0, 6.28), distance = *between(0.5, 2);
  return {distance * std::cos(angle), distance * std::sin(angle)};
}

// Terms are products of velocities up to 2, accelerations up to 8 and their factors: below 64, some ten of
// them.
RC_GTEST_PROP(Statements, MotionsOfBodiesConserveWhatTheySay, ()) {
  Vector<double, 4> x;
  x << place(), place();
  RC_ASSERT(drift(Kepler{.mu = *between(0.5, 2)}, x) <= 1000 * epsilon);
  // Half a unit from the earth and a tenth from the moon at least: D1 and D2 above 1e-3.
  x[1] = *between(0.5, 2);
  RC_ASSERT(drift(Arenstorf{.moon = *between(0, 0.5)}, x) <= 1000 * epsilon);
}

RC_GTEST_PROP(Statements, StarsConserveMomentaAndEnergy, ()) {
  Vector<double, 28> x = Pleiades::initial_state();
  for (int i = 0; i < 28; ++i) x[i] += *between(-0.4, 0.4);
  // Stars are 0.2 apart at least: masses of 7 at 1/0.04, times velocities and distances of 5, 42 pairs.
  RC_ASSERT(drift(Pleiades{}, x) <= 1e6 * epsilon);
}

// The energy's rate by dual numbers, for a chain of three.
RC_GTEST_PROP(Statements, ChainConservesItsEnergy, ()) {
  const DuffingChain chain{.masses = 3,
                           .natural_frequency = *between(0, 2),
                           .hardening = *between(-1, 2),
                           .coupling = *between(0, 2)};
  Vector<double, Eigen::Dynamic> x(6), f(6);
  Vector<Dual<double, 6>, Eigen::Dynamic> v(6);
  for (int i = 0; i < 6; ++i) {
    x[i] = *between(-1, 1);
    v[i] = Dual<double, 6>::variable(x[i], i);
  }
  chain(0.0, x, f);
  const auto energy = chain.invariants(Dual<double, 6>(0.0), v)[0];
  double rate = 0;
  for (int i = 0; i < 6; ++i) rate += energy.partial[static_cast<std::size_t>(i)] * f[i];
  RC_ASSERT(std::abs(rate) <= 200 * epsilon);
}

// A chain of one is a Duffing oscillator between two springs.
RC_GTEST_PROP(Statements, ChainOfOneIsADuffingOscillator, ()) {
  const double w = *between(0, 2), eta = *between(-1, 2), k = *between(0, 2);
  const DuffingChain chain{.masses = 1, .natural_frequency = w, .hardening = eta, .coupling = k};
  const Duffing one{.natural_frequency = std::sqrt(w * w + 2 * k), .hardening = eta};
  Vector<double, Eigen::Dynamic> x(2), f(2);
  x << *between(-1, 1), *between(-1, 1);
  Vector<double, 2> g;
  chain(0.0, x, f);
  one(0.0, Vector<double, 2>(x), g);
  RC_ASSERT(f[0] == g[0]);
  RC_ASSERT(std::abs(f[1] - g[1]) <= 32 * epsilon);
}

// The damper alone lessens the energy, at the rate c r'^2.
RC_GTEST_PROP(Statements, DamperTakesEnergyFromThePendulum, ()) {
  const SpringPendulum pendulum{.stiffness = 100, .damping = *between(0, 10)};
  Vector<double, 4> x, f;
  x << place(), *between(-1, 1), *between(-1, 1);
  pendulum(0.0, x, f);
  const auto energy = pendulum.energy(variables(x));
  double rate = 0;
  for (int i = 0; i < 4; ++i) rate += energy.partial[static_cast<std::size_t>(i)] * f[i];
  const double stretching = (x[0] * x[2] + x[1] * x[3]) / std::hypot(x[0], x[1]);
  RC_ASSERT(std::abs(rate + pendulum.damping * stretching * stretching) <= 1e4 * epsilon);
}

TEST(Statements, DeadEndsEndWhereTheySay) {
  EXPECT_EQ(DeadEnd{}.exact(0.75, 1.0), 0.5);
  EXPECT_TRUE(std::isnan(DeadEnd{}.exact(1.5, 1.0)));
  Vector<double, 1> f;
  DeadEnd{}(0.75, Vector<double, 1>(0.5), f);
  EXPECT_EQ(f[0], -1);  // d sqrt(1 - t)/dt there
  LostDomain{}(0.75, Vector<double, 1>(2.0), f);
  EXPECT_EQ(f[0], -1.5);
  LostDomain{}(1.25, Vector<double, 1>(2.0), f);
  EXPECT_TRUE(std::isnan(f[0]));
}

/// Does the vector field point inwards wherever a component is at its lower bound?
template <class Problem>
bool points_inwards(const Problem& problem) {
  constexpr int n = Problem::dimension;
  const Vector<double, n> lower = problem.lower_bounds();
  bool is_inwards = true;
  for (int i = 0; i < n; ++i) {
    Vector<double, n> x, f;
    for (int k = 0; k < n; ++k) x[k] = lower[k] + *between(0, 2);
    x[i] = lower[i];
    problem(0.0, x, f);
    is_inwards = is_inwards && f[i] >= 0;
  }
  return is_inwards;
}

RC_GTEST_PROP(Statements, ConcentrationsStayPositive, ()) {
  const Robertson robertson{.k1 = *between(0, 1), .k2 = *between(0, 1e5), .k3 = *between(0, 1e8)};
  RC_ASSERT(points_inwards(robertson));
  RC_ASSERT(points_inwards(Hires{.k_plus = *between(0, 1e4)}));
  RC_ASSERT(points_inwards(Pollution{.light = *between(0, 2)}));
}

TEST(Statements, NegativeRatesHaveNoBounds) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Robertson{}.lower_bounds().maxCoeff(), 0);
  EXPECT_EQ(Robertson{.k2 = -1}.lower_bounds().maxCoeff(), -infinity);
  EXPECT_EQ(Hires{}.lower_bounds().minCoeff(), 0);
  EXPECT_EQ(Hires{.k_plus = -1}.lower_bounds().maxCoeff(), -infinity);
}

}  // namespace
}  // namespace nlmech::problems::tests::statements_test
