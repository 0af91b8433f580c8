/// Misprints of the control part, Eqs. 3.49-3.58: printed forms give wrong numbers, corrected forms the right
/// ones.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/plant/closed_form.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/spacecraft/oracle.hpp"

namespace nlmech::spacecraft::closed_loop_errata_test {
namespace {

using tests::expect_erratum;

// 3.49: I_hub theta'' = u + (M_0 - r S_0) counts one of two appendages. I_hub + B is half of 2 I_hub + 2B.
TEST(ControlErrata, HubBalanceOfOneAppendage) {
  Parameters printed = table_3_1();
  printed.hub_inertia *= 2;
  const Frequencies one = poles(Plant(printed), 2), two = poles(Plant(table_3_1()), 2);
  EXPECT_NEAR(one.omega[0], 5.53133, 5e-6);
  EXPECT_NEAR(one.omega[1], 51.7418, 5e-5);
  // Hub-locked frequencies lie at 4.37, 51.40 and 155.7.
  const std::array<double, 2> exact = {oracle::pole(table_3_1(), 4.4, 9),
                                       oracle::pole(table_3_1(), 51.41, 60)};
  for (std::size_t i = 0; i < 2; ++i)
    expect_erratum("gss_control-3.49-two", {one.omega[i], two.omega[i], exact[i], 2e-12});
}

// 3.50: dropping I_tip is called a small perturbation; it moves modes 4 to 6 by 6 to 26 %.
TEST(ControlErrata, TipInertiaIsNoSmallPerturbation) {
  Parameters dropped = table_3_1();
  dropped.tip_inertia = 0;
  const LoopPoles without = ClosedLoop(dropped, designed_gains).poles(6);
  const LoopPoles with = ClosedLoop(table_3_1(), designed_gains).poles(6);
  const std::array<double, 4> expected = {53.1326888, 166.168013, 343.825153, 586.139024};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(std::abs(without.s[2 + i].imag()), expected[i], 1e-8 * expected[i]);
  EXPECT_NEAR(without.s[3].imag() / with.s[3].imag() - 1, 0.064, 1e-3);
  EXPECT_NEAR(without.s[5].imag() / with.s[5].imag() - 1, 0.256, 1e-3);
  const auto exact = [](Complex s) { return oracle::characteristic(table_3_1(), designed_gains, s); };
  for (std::size_t i = 3; i < 6; ++i) {
    const Complex pole = oracle::root_near(exact, with.s[i] * 1.0001);
    // Poles have 12 digits of their modulus.
    EXPECT_NEAR(with.s[i].imag(), pole.imag(), 1e-12 * pole.imag());
  }
}

// 3.52, 3.53: of a spacecraft of three modes, in any state, the rate of V by the accelerations that (3.15)
// and the torque (3.55) give. It is to be -k3 theta'^2.
TEST(ControlErrata, LyapunovFunctionOfTwoAppendages) {
  Parameters p = table_3_1();
  p.tip_inertia = 0;  // V of (3.52) leaves it out
  const DiscreteModel model = assumed_modes(p, 3);
  const Eigen::MatrixXd mass = model.full_mass(), stiffness = model.full_stiffness();
  const Gains g = {12, 0.7, 16};
  const double aim = 1;
  const Eigen::Vector4d x(0.4, 0.02, -0.01, 0.003), v(0.3, -0.2, 0.05, 0.01);
  // The root load is half of what turns the hub besides u: I_hub theta'' = u - 2 load. So, by (3.55),
  // u = -(k1 e + k3 theta' + k2 (u - I_hub theta'')/2).
  Eigen::MatrixXd balance = mass;
  balance(0, 0) -= g.k2 / 2 * p.hub_inertia / (1 + g.k2 / 2);
  Eigen::VectorXd force = -stiffness * x;
  force[0] -= (g.k1 * (x[0] - aim) + g.k3 * v[0]) / (1 + g.k2 / 2);
  const Eigen::VectorXd a = balance.fullPivLu().solve(force);
  // Power into the energy of both appendages, their motion with the hub included.
  const double beams = v.dot(mass * a) - p.hub_inertia * v[0] * a[0] + v.dot(stiffness * x);
  const double hub = p.hub_inertia * v[0] * a[0] + g.k1 * (x[0] - aim) * v[0];
  const double printed = hub + (1 + g.k2) * beams / 2;            // w3 = (1 + k2) w1, one appendage
  const double corrected = hub + 2 * (1 + g.k2 / 2) * beams / 2;  // w3 = (1 + k2/2) w1, two
  // Power of some ten terms of up to 100 lb ft/s.
  expect_erratum("gss_control-3.52", {printed, corrected, -g.k3 * v[0] * v[0], 1e-11});
}

/// Largest real part of the poles of a spacecraft of three modes under these gains, k1 and k3 being 1.
double least_damping(double k2) {
  const DiscreteModel model = assumed_modes(table_3_1(), 3, ModeFunctions::eigenfunctions);
  const double hub = table_3_1().hub_inertia;
  Eigen::Matrix4d mass = model.full_mass() * (1 + k2 / 2), stiffness = model.full_stiffness() * (1 + k2 / 2);
  mass(0, 0) -= hub * k2 / 2;
  stiffness(0, 0) += 1;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(8, 8);
  a.topRightCorner<4, 4>().setIdentity();
  const Eigen::Matrix4d inverse = mass.inverse();
  a.bottomLeftCorner<4, 4>() = -inverse * stiffness;
  a.block<4, 1>(4, 4) = -inverse.col(0);
  return Eigen::EigenSolver<Eigen::MatrixXd>(a, false).eigenvalues().real().maxCoeff();
}

// 3.54-3.55: with w3 on one root load k2 = 2 (w3 - w1)/w1 > -2; k2 > -1 is sufficient only.
TEST(ControlErrata, BoundOfK2) {
  for (const double k2 : {-1.5, -1.999}) {
    const LoopPoles poles = ClosedLoop(table_3_1(), {12, k2, 16}).poles(10);
    ASSERT_TRUE(poles.status.ok());
    for (const Complex s : poles.s) EXPECT_LT(s.real(), 0) << k2;
  }
  // Where the eigenvalues of a truncated model cross. Damping is of the order of 2 + k2 there: 1e-5 of it
  // exceeds the rounding of eigenvalues of 100 rad/s.
  double unstable = -2.5, stable = -1;
  while (stable - unstable > 1e-6) {
    const double middle = (stable + unstable) / 2;
    (least_damping(middle) < 0 ? stable : unstable) = middle;
  }
  expect_erratum("gss_control-3.55", {.printed = -1, .corrected = -2, .oracle = stable, .tolerance = 1e-5});
}

// 3.56: the root load of (3.55) from the momentum of the appendage. Without I_tip (theta + y'(L)) it differs
// from moment and shear at the root: half of the hub's load minus its own inertia.
TEST(ControlErrata, RootLoadHoldsTheTipInertia) {
  const Parameters p = table_3_1();
  const Appendage a(p);
  const double l = p.length, r = p.hub_radius;
  for (const double omega : {5., 45., 150.}) {
    const Complex s(0, omega), square = s * s;
    const auto w = [&](double x) { return r + x + a.deflection(s, x); };
    const Complex momentum =
        p.mass_per_length * oracle::integral(l, [&](double x) { return (r + x) * w(x); });
    const Complex printed = momentum + p.tip_mass * (r + l) * w(l),
                  corrected = printed + p.tip_inertia * (1. + a.slope(s, l));
    const Complex load = (oracle::hub_load(p, s) - square * p.hub_inertia) / 2.;
    // Gauss' rule, and the digits that the difference of loads loses.
    expect_erratum("gss_control-3.56", oracle::distances(square * printed, square * corrected, load, 1e-9));
  }
}

// 3.57: the torque by the states of the closed form, all of which are for theta = 1. The hub's balance has
// the same torque.
TEST(ControlErrata, TorqueByTheStates) {
  Parameters p = table_3_1();
  p.tip_inertia = 0;  // of (3.56)
  const Gains g = {12, 0.7, 16};
  const double l = p.length, reach = p.hub_radius + l;
  for (const double omega : {2., 20., 60.}) {
    const Complex s(0.1, omega), square = s * s;
    const Complex theta = g.k1 / s / oracle::characteristic(p, g, s);
    const auto z = GssSolution<Complex>(p, s).state(l);
    const double rigid = p.appendage_inertia();
    const Complex flexible = p.mass_per_length * (reach * z[1] - z[0]) + p.tip_mass * reach * z[2];
    const Complex stiff = (-g.k1 - g.k2 * square * rigid - g.k3 * s) * theta + g.k1 / s;
    const Complex printed = stiff - g.k2 * square * flexible,
                  corrected = stiff - g.k2 * square * flexible * theta;
    // The closed form loses some digits.
    expect_erratum("gss_control-3.57",
                   oracle::distances(printed, corrected, oracle::hub_load(p, s) * theta, 1e-10));
  }
}

/// 3.58 as printed, with x = L, for a step: the terms of g outside the product with theta, one appendage of
/// those in the denominator.
Complex printed_theta(const ClosedLoop& loop, Complex s) {
  const Parameters& p = loop.parameters();
  const Gains& g = loop.gains();
  const Complex tip = p.tip_inertia * loop.plant().appendage().slope(s, p.length);
  const double rigid = p.appendage_inertia();
  const Complex flexible =
      loop.plant().appendage().inertia(s) - rigid;  // rho (..) + m (r + L) g3(L) + I_tip g4(L)
  const Complex numerator = g.k1 / s - g.k2 * s * s * (flexible - tip);
  return numerator /
         (g.k1 + g.k3 * s + s * s * (g.k2 * (rigid - p.tip_inertia) + p.total_inertia() + flexible));
}

TEST(ControlErrata, ClosedLoopTransferFunction) {
  const ClosedLoop designed(table_3_1(), designed_gains), unit(table_3_1(), unit_gains);
  struct Row {
    double omega, ratio, printed, exact;
  };
  // |printed/corrected| with the designed gains; |s theta| printed and corrected with unit gains.
  for (const Row row :
       {Row{10, 0.506, 3.54, 2.0e-3}, Row{100, 0.615, 27.8, 1.2e-5}, Row{1000, 0.632, 268.6, 1.2e-7}}) {
    const Complex s(0, row.omega);
    EXPECT_NEAR(std::abs(printed_theta(designed, s) * s / designed.response(s).theta), row.ratio, 6e-4);
    EXPECT_NEAR(std::abs(printed_theta(unit, s) * s), row.printed, 5e-3 * row.printed);
    EXPECT_NEAR(std::abs(unit.response(s).theta), row.exact, 0.05 * row.exact);
    for (const ClosedLoop& loop : {designed, unit}) {
      const Complex exact = loop.gains().k1 / oracle::characteristic(loop.parameters(), loop.gains(), s);
      expect_erratum("gss_control-3.58",
                     oracle::distances(printed_theta(loop, s) * s, loop.response(s).theta, exact, 1e-12));
    }
  }
}

}  // namespace
}  // namespace nlmech::spacecraft::closed_loop_errata_test
