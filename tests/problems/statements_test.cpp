// What problems say of themselves: the equation as text, bounds, conserved sums.
#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_body.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/series/dual.hpp"
#include "tests/problems/oracle.hpp"

namespace nlmech::problems::tests::statements_test {
namespace {

template <class Problem>
class StatementsOf : public ::testing::Test {};
using All = ::testing::Types<BlowUp, FourBodies, DrivenDuffing, Duffing, ForcedDuffing, Hires, ImpactDuffing,
                             LinearOscillator, Lorenz, Projectile, Robertson, StrongOscillator,
                             ThreeMassChain, TwoBody, TwoDof, VanDerPol>;
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
