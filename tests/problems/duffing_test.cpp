#include "nlmech/problems/duffing.hpp"

#include <gtest/gtest.h>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/dual.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::duffing_test {
namespace {

/// Linear, hardening and (where the orbit of amplitude 1 is closed) softening oscillators.
rc::Gen<Duffing> any_duffing() {
  return rc::gen::map(rc::gen::pair(between(0.5, 3), between(-0.2, 5)), [](const auto& p) {
    return Duffing{p.first, p.second};
  });
}

RC_GTEST_PROP(DuffingEquation, HasItsJacobian, ()) {
  const Duffing problem = *any_duffing();
  const ivp::System system(problem.text());
  const ivp::State x{*between(-2, 2), *between(-2, 2)};
  ivp::State f;
  ivp::Jacobian j;
  system.rhs(0, x, f);
  system.jacobian(0, x, j);
  const double w2 = problem.natural_frequency * problem.natural_frequency;
  RC_ASSERT(f[0] == x[1]);
  // Terms up to 9 * 2 and 5 * 8 in the value, 9 and 3 * 5 * 4 in the derivative; four roundings each.
  RC_ASSERT(std::abs(f[1] + w2 * x[0] + problem.hardening * std::pow(x[0], 3)) <= 4 * 58 * epsilon);
  RC_ASSERT(j(0, 0) == 0 && j(0, 1) == 1 && j(1, 1) == 0);
  RC_ASSERT(std::abs(j(1, 0) + w2 + 3 * problem.hardening * x[0] * x[0]) <= 4 * 69 * epsilon);
}

// The closed form satisfies the equation: its second derivative by differences in 50 digits, h^2 f''''/12.
RC_GTEST_PROP(DuffingEquation, IsSolvedByTheJacobiFunction, ()) {
  const Duffing problem{*between(0.5, 3), *between(0, 5)};
  const Real amplitude = *between(0.1, 2), t = *between(0, 10), h = 1e-12;
  const auto x = [&](const Real& time) { return free_oscillation(problem, amplitude, time)[0]; };
  const Real second = (x(t + h) - 2 * x(t) + x(t - h)) / (h * h);
  Vector<Real, 1> a;
  problem.text().acceleration(t, Vector<Real, 1>(x(t)), Vector<Real, 1>(Real(0)), a);
  // The square of the frequency is rounded in the text. Greatest fourth derivative: (omega^2)^2 X with
  // omega^2 = 9 + 5 * 4, times small factors.
  RC_ASSERT(abs(second - a[0]) <= Real(1e-24) * 29 * 29 * 2 * 20 + Real(9 * 2 * epsilon));
}

// dE/dt = grad E . f vanishes: the gradient by dual numbers, from the energy alone. The text says the same.
RC_GTEST_PROP(DuffingEnergy, IsInvariant, ()) {
  const Duffing problem = *any_duffing();
  const ivp::State x{*between(-2, 2), *between(-2, 2)};
  const auto energy = problem.energy(variables(Vector<double, 2>(x)));
  ivp::State f;
  const ivp::System system(problem.text());
  system.rhs(0, x, f);
  const double rate = energy.partial[0] * f[0] + energy.partial[1] * f[1];
  // Both terms are below 2 * 58; a few roundings each.
  RC_ASSERT(std::abs(rate) <= 8 * 2 * 58 * epsilon);
  Eigen::VectorXd kept;
  RC_ASSERT(system.invariants(0, x, kept) && std::abs(kept[0] - energy.value) <= 8 * 58 * epsilon);
}

RC_GTEST_PROP(DuffingAmplitude, IsWhereTheOrbitTurns, ()) {
  const Duffing problem{*between(0.5, 3), *between(-0.2, 5)};
  const Real amplitude = *between(0.01, 1), phase = *between(0, 3);
  // Any point of the orbit: x anywhere below X, v from the energy.
  const Real x = amplitude * cos(phase), w2 = Real(problem.natural_frequency) * problem.natural_frequency;
  const auto potential = [&](const Real& y) {
    return Real(w2 * y * y / 2 + problem.hardening * pow(y, 4) / 4);
  };
  const Real v = sqrt(2 * (potential(amplitude) - potential(x)));
  RC_ASSERT(abs(problem.amplitude(Vector<Real, 2>(x, v)) - amplitude) < Real(1e-47));
}

// Against Boost's complete elliptic integral in 50 digits. A softening spring has an imaginary modulus: then
// through K(m) = K(m/(m-1))/sqrt(1-m).
RC_GTEST_PROP(DuffingPeriod, IsFourTimesTheQuarterPeriod, ()) {
  const Duffing problem{*between(0.5, 3), *between(-0.2, 5)};
  const double amplitude = *between(0.01, 1);
  const Real m = problem.elliptic_parameter(Real(amplitude)),
             omega = problem.argument_frequency(Real(amplitude));
  const Real k = m >= 0 ? Real(boost::math::ellint_1(Real(sqrt(m))))
                        : Real(boost::math::ellint_1(Real(sqrt(m / (m - 1)))) / sqrt(1 - m));
  const Real exact = 4 * k / omega;
  RC_ASSERT(abs(problem.period(Real(amplitude)) / exact - 1) < 8 * std::numeric_limits<Real>::epsilon());
  RC_ASSERT(abs(problem.period(amplitude) / exact - 1) <= 4 * epsilon);
  RC_ASSERT(abs(problem.period(static_cast<long double>(amplitude)) / exact - 1) <= 4 * 0x1p-63);
}

TEST(DuffingPeriod, OfExtremeOscillators) {
  const double two_pi = 6.283185307179586477;
  // Linear: exact. Very hard: 4 K(1/2)/sqrt(eta) with K(1/2) = Gamma(1/4)^2/(4 sqrt(pi)) = 1.854...
  EXPECT_NEAR((Duffing{2, 0}.period(5.0)), two_pi / 2, 4 * epsilon * two_pi);
  EXPECT_NEAR((Duffing{0, 1e6}.period(1.0)), 4 * 1.8540746773013719184e-3, 4 * epsilon * 7.5e-3);
  // Close to the separatrix w^2 + eta X^2 = 0 the period grows without bound; beyond it there is none.
  EXPECT_GT((Duffing{1, -1}.period(1 - 1e-12)), 30);
  EXPECT_TRUE(std::isnan(Duffing{1, -1}.period(1.0)));
  EXPECT_TRUE(std::isnan(Duffing{1, -1}.period(2.0)));
  EXPECT_TRUE(std::isnan(Duffing{1, -1}.period(std::nan(""))));
  // The Table 4.1 value 4.77 is 4.768 rounded up: P = 4.768022029...
  EXPECT_NEAR(Duffing{}.period(1.0), 4.768022029102461, 1e-14);
}

}  // namespace
}  // namespace nlmech::problems::tests::duffing_test
