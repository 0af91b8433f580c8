/// Forward sensitivities by CVODES against a closed form.
#include "nlmech/peers/ivp/sundials/cvodes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/program/equations.hpp"

namespace nlmech::peers::cvodes_test {
namespace {

// x = a cos(w t) with a = x(0): dx/da = cos(w t) and dx/dw = -a t sin(w t); velocities are their derivatives.
// A thousand times the tolerance: errors of some hundred steps add up.
TEST(Cvodes, SensitivitiesOfAnOscillatorAreItsClosedForm) {
  if (!cvode_available()) GTEST_SKIP() << "no CVODES in this build";
  program::Equations equations({"oscillator", "x'' = -w^2 x; w = 2; x(0) = 3; x'(0) = 0"});
  program::Equations extended = equations.with_sensitivities("sensitivities", {"x", "w"});
  const ivp::System system{program::Problem(equations)}, all{program::Problem(extended)};
  const std::vector<double> start = extended.initial_state("initial state", "");
  const Eigen::Map<const Eigen::VectorXd> x0(start.data(), std::ssize(start));
  const double t = 5, c = std::cos(2 * t), s = std::sin(2 * t);
  for (const auto formula : {Cvode::Formula::adams, Cvode::Formula::bdf}) {
    int steps = 0;
    const auto count = [&steps](double /*t*/, const ivp::State& /*x*/) { ++steps; };
    const ivp::Solution end =
        integrate_by_cvodes({formula, 1e-9, 1e-9}, system, all, {3, 2}, x0, 0, t, count);
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    EXPECT_EQ(end.t, t);
    EXPECT_EQ(end.statistics.steps, steps);
    const ivp::State exact{3 * c, c, -3 * t * s, -6 * s, -2 * s, -3 * s - 6 * t * c};
    EXPECT_LE((end.x - exact).cwiseAbs().maxCoeff(), 1e-6) << end.x.transpose();
  }
}

}  // namespace
}  // namespace nlmech::peers::cvodes_test
