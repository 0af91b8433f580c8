/// Misprints of the control part, Eqs. 3.49-3.58: what is printed gives wrong numbers, what is corrected the
/// right ones.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "nlmech/spacecraft/closed_loop.hpp"
#include "nlmech/spacecraft/poles.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::spacecraft {
namespace {

// 3.49: I_hub theta'' = u + (M_0 - r S_0) counts one of two appendages. I_hub + B is half of 2 I_hub + 2B.
TEST(ControlErrata, HubBalanceOfOneAppendage) {
  Parameters printed = table_3_1();
  printed.hub_inertia *= 2;
  const Frequencies one = poles(Plant(printed), 2), two = poles(Plant(table_3_1()), 2);
  EXPECT_NEAR(one.omega[0], 5.53133, 5e-6);
  EXPECT_NEAR(one.omega[1], 51.7418, 5e-5);
  EXPECT_NEAR(two.omega[0], 6.452959965749, 5e-12);
  EXPECT_NEAR(two.omega[1], 52.08177896598, 5e-11);
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
  }
}

// 3.54-3.55: with w3 on one root load k2 = 2 (w3 - w1)/w1 > -2; k2 > -1 is sufficient only.
TEST(ControlErrata, BoundOfK2) {
  for (const double k2 : {-1.5, -1.999}) {
    const LoopPoles poles = ClosedLoop(table_3_1(), {12, k2, 16}).poles(10);
    ASSERT_TRUE(poles.status.ok());
    for (const Complex s : poles.s) EXPECT_LT(s.real(), 0) << k2;
  }
}

}  // namespace
}  // namespace nlmech::spacecraft
