#include <gtest/gtest.h>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/program/dual.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::other_problems_test {
namespace {

RC_GTEST_PROP(VanDerPolEquation, HasItsJacobian, ()) {
  const VanDerPol problem{.mu = *between(0, 100)};
  const Vector<double, 2> x(*between(-2, 2), *between(-2, 2));
  Vector<Dual<double, 2>, 2> f;
  problem(Dual<double, 2>(0.0), variables(x), f);
  const Matrix<double, 2> j = jacobian_of(f);
  // Terms up to 100 * 5 * 2 in the value, 2 * 100 * 4 + 1 in the derivatives; four roundings each.
  const double tolerance = 4 * 1000 * epsilon, a = problem.mu * (1 - x[0] * x[0]) * x[1] - x[0];
  RC_ASSERT(f[0].value == x[1] && j(0, 0) == 0 && j(0, 1) == 1);
  RC_ASSERT(std::abs(f[1].value - a) <= tolerance);
  RC_ASSERT(std::abs(j(1, 0) + 2 * problem.mu * x[0] * x[1] + 1) <= tolerance);
  RC_ASSERT(std::abs(j(1, 1) - problem.mu * (1 - x[0] * x[0])) <= tolerance);
}

// The closed form satisfies y' = s y^3: its slope by dual numbers, from the closed form alone. Close to its
// end the root of 1 - 2 s y0^2 t is ill-conditioned, hence up to 0.9 of the way.
RC_GTEST_PROP(BlowUpEquation, IsSolvedByItsClosedForm, ()) {
  const BlowUp problem{.strength = *between(0.5, 2)};
  using D = Dual<double, 1>;
  const double y0 = *between(0.5, 2), t = *between(-1, 0.9) * problem.end_time(y0);
  const D y = problem.exact(D::variable(t, 0), D(y0));
  Vector<double, 1> f;
  problem(t, Vector<double, 1>(y.value), f);
  RC_ASSERT(std::abs(f[0] - y.partial[0]) <= 128 * epsilon * std::abs(f[0]));
  RC_ASSERT(problem.exact(0.0, y0) == y0);
}

TEST(BlowUpEquation, EndsWhereItSays) {
  EXPECT_EQ(BlowUp{}.end_time(1), 0.5);
  EXPECT_EQ(BlowUp{.strength = 2}.end_time(2), 0.0625);
  EXPECT_EQ(BlowUp{.strength = -1}.end_time(2), std::numeric_limits<double>::infinity());
  EXPECT_EQ(BlowUp{}.end_time(0), std::numeric_limits<double>::infinity());
  EXPECT_GT(BlowUp{}.exact(0.5 - 1e-12, 1.0), 7e5);
  EXPECT_TRUE(std::isnan(BlowUp{}.exact(0.6, 1.0)));
}

}  // namespace
}  // namespace nlmech::problems::tests::other_problems_test
