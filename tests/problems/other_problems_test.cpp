#include <gtest/gtest.h>

#include "nlmech/ivp/system.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/program/dual.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::other_problems_test {
namespace {

RC_GTEST_PROP(VanDerPolEquation, HasItsJacobian, ()) {
  const double mu = *between(0, 100);
  const ivp::System system(TextProblem("van-der-pol", {{"mu", mu}}));
  const ivp::State x{*between(-2, 2), *between(-2, 2)};
  ivp::State f;
  ivp::Jacobian j;
  system.rhs(0, x, f);
  system.jacobian(0, x, j);
  // Terms up to 100 * 5 * 2 in the value, 2 * 100 * 4 + 1 in the derivatives; four roundings each.
  const double tolerance = 4 * 1000 * epsilon, a = mu * (1 - x[0] * x[0]) * x[1] - x[0];
  RC_ASSERT(f[0] == x[1] && j(0, 0) == 0 && j(0, 1) == 1);
  RC_ASSERT(std::abs(f[1] - a) <= tolerance);
  RC_ASSERT(std::abs(j(1, 0) + 2 * mu * x[0] * x[1] + 1) <= tolerance);
  RC_ASSERT(std::abs(j(1, 1) - mu * (1 - x[0] * x[0])) <= tolerance);
}

// Its closed form satisfies y' = s y^3: its slope by dual numbers, from the closed form alone. Close to its
// end the root of 1 - 2 s y0^2 t is ill-conditioned, hence up to 0.9 of the way.
RC_GTEST_PROP(BlowUpEquation, IsSolvedByItsClosedForm, ()) {
  using D = Dual<double, 1>;
  const double s = *between(0.5, 2), y0 = *between(0.5, 2), t = *between(-1, 0.9) / (2 * s * y0 * y0);
  const D y = y0 / sqrt(1 - 2 * s * y0 * y0 * D::variable(t, 0));
  ivp::State f;
  ivp::System(TextProblem("blow-up", {{"strength", s}})).rhs(t, ivp::State{y.value}, f);
  RC_ASSERT(std::abs(f[0] - y.partial[0]) <= 128 * epsilon * std::abs(f[0]));
}

}  // namespace
}  // namespace nlmech::problems::tests::other_problems_test
