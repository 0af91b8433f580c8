/// Lyapunov functions along a discretised motion; the discretised motion against the exact one.
#include "nlmech/spacecraft/control/lyapunov.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::spacecraft::lyapunov_test {
namespace {

// Vdot = -k3 theta'^2: the corrected function decreases at every sample by the dissipation of the controller,
// integrated by Gauss quadrature in each step (1e-9 of V(0) for the rounding of the modes, up to 1e7 in
// stiffness).
TEST(Lyapunov, CorrectedFunctionFallsByTheDissipation) {
  for (const Gains& g : {unit_gains, designed_gains, Gains{12, 4.83, 31.9}, Gains{12, -1.5, 16}}) {
    const LyapunovHistory h = lyapunov_history(table_3_1(), g, 10, 20, 0.002);
    EXPECT_EQ(h.corrected_rise, 0) << g.k2;
    EXPECT_LT(h.imbalance, 1e-9) << g.k2;
    // The functions of Eq. 3.45 are nearly dependent: their mass matrix has a condition number of about 1e8.
    EXPECT_NEAR(h.samples[0].corrected, g.k1 / 2, 1e-7 * g.k1);
    EXPECT_LT(h.samples.back().corrected, h.samples[0].corrected);
  }
}

struct Differences {
  double theta = 0, rate = 0, y2 = 0, y2_rate = 0, y4 = 0;
};

Differences differences(const DiscreteModel& model, const Gains& g) {
  const std::array<double, 2> places = {2, 4};
  const TimeResponse exact = step_response(ClosedLoop(table_3_1(), g), 1, places, {.pairs = 128});
  constexpr std::size_t count = 4001;
  const double step = 0.01;
  const auto samples = [&](const ExponentialSum& f) { return f.samples(0, step, count); };
  const std::vector<double> theta = samples(exact.theta), rate = samples(exact.theta_dot),
                            y2 = samples(exact.deflection[0]), y2_rate = samples(exact.deflection_dot[0]),
                            y4 = samples(exact.deflection[1]);
  DiscreteLoop loop(model, g, 1, step);
  Differences d;
  for (std::size_t i = 0; i < count; ++i, loop.advance()) {
    d.theta = std::max(d.theta, std::abs(loop.theta() - theta[i]));
    d.rate = std::max(d.rate, std::abs(loop.theta_dot() - rate[i]));
    d.y2 = std::max(d.y2, std::abs(loop.deflection(2) - y2[i]));
    d.y2_rate = std::max(d.y2_rate, std::abs(loop.deflection_dot(2) - y2_rate[i]));
    d.y4 = std::max(d.y4, std::abs(loop.deflection(4) - y4[i]));
  }
  return d;
}

// The differences of ten assumed modes to the exact response. oracle: gss_control_loop ten modes *
TEST(DiscreteLoop, OfTenAssumedModesDiffersAsPublished) {
  const Differences d = differences(assumed_modes(table_3_1(), 10), designed_gains);
  EXPECT_NEAR(d.theta, 9.8e-6, 0.3e-6);
  EXPECT_NEAR(d.rate, 5.9e-4, 0.6e-4);
  EXPECT_NEAR(d.y2, 5.5e-4, 0.3e-4);
  EXPECT_NEAR(d.y2_rate, 0.0347, 0.004);
  EXPECT_NEAR(d.y4, 5.1e-5, 0.5e-5);
}

// Finite elements converge to the exact response: two discretisations and the residues agree.
TEST(DiscreteLoop, OfFiniteElementsConvergesToTheResidues) {
  const Differences coarse = differences(finite_elements(table_3_1(), 6), designed_gains);
  const Differences fine = differences(finite_elements(table_3_1(), 12), designed_gains);
  EXPECT_LT(fine.theta, 5e-7);
  EXPECT_LT(fine.theta, coarse.theta / 3);
  EXPECT_LT(fine.y2, coarse.y2 / 2);
  EXPECT_LT(fine.y4, coarse.y4 / 2);
}

TEST(DiscreteLoop, RefusesBadInput) {
  const DiscreteModel model = assumed_modes(table_3_1(), 3);
  EXPECT_THROW(DiscreteLoop(model, designed_gains, 1, 0), std::invalid_argument);
  EXPECT_THROW(DiscreteLoop(model, {0, 0, 1}, 1, 0.1), std::invalid_argument);
  EXPECT_THROW(DiscreteLoop(model, {1, -2, 1}, 1, 0.1), std::invalid_argument);
  EXPECT_THROW((void)lyapunov_history(table_3_1(), designed_gains, 3, 0, 0.1), std::invalid_argument);
  EXPECT_THROW((void)lyapunov_history(table_3_1(), designed_gains, 3, 1e9, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::lyapunov_test
