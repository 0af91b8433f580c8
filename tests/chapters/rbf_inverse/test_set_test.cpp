/// Mazzia and Cash's test set against closed forms and multiple shooting in 24 digits
/// (tools/bvp_test_set_references.py).
#include "chapters/rbf_inverse/test_set/test_set.hpp"

#include <gtest/gtest.h>

namespace nlmech::chapters::rbf_inverse::test_set_test {
namespace {

class TestSet : public testing::TestWithParam<TestProblem> {};

/// Problem 35 multiplies errors by exp(1/(2 eps)), 5e21 at 0.01.
bool is_hopeless(const TestProblem& test, double value) { return test.number == 35 && value < 0.02; }

// The residual is 1e-9 of the largest slope at most, and the problems multiply it by some tens; relative to
// the largest value of each component.
TEST_P(TestSet, IsSolvedOrRefused) {
  const TestProblem& test = GetParam();
  for (const double value : {test.moderate, test.hard}) {
    const bvp::TypedProblem problem = typed(test, value);
    const std::vector<ReferenceValue> known = references(test, value);
    ASSERT_GE(known.size(), 6U);
    const bvp::Solution solution = solve_test(test, value, 1e-9);
    EXPECT_EQ(solution.status.ok(), !is_hopeless(test, value)) << value << ": " << solution.status.text();
    if (solution.status.ok()) {
      EXPECT_LE(error_of(known, problem, solution), 1e-8) << value;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(MazziaAndCash, TestSet,
                         testing::ValuesIn(test_problems().begin(), test_problems().end()),
                         [](const auto& named) { return "T" + std::to_string(named.param.number); });

// Errors of exp(1/(2 eps)) times rounding become as large as the solution at eps = 0.014: no success is wrong
// by more than its tolerance from there on.
TEST(TestSetOf35, RefusesWhatRoundingDecides) {
  const TestProblem& last = test_problems().back();
  for (const double eps : {0.025, 0.02, 0.015, 0.0125, 0.008, 0.005, 0.003, 0.001}) {
    const bvp::Solution solution = solve_test(last, eps, 1e-9);
    if (!solution.status.ok()) continue;
    // Antisymmetric part t/2, the same at any eps; the other part is below 2e-7 at these t.
    const bvp::TypedProblem problem = typed(last, eps);
    for (const double t : {-0.1, -0.05, 0.1}) EXPECT_NEAR(solution.at(t)[0], t / 2, 1e-6) << eps;
  }
}

}  // namespace
}  // namespace nlmech::chapters::rbf_inverse::test_set_test
