// adaptive-collocation on stiff equations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/reference.hpp"
#include "tests/ivp/test_set.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::ivp::adaptive_collocation_stiff_test {
namespace {

using oracle::published_end_state;
using testing::eps;

AdaptiveCollocation to(double relative, double absolute) {
  return {.relative_tolerance = relative, .absolute_tolerance = absolute};
}

/// Correct digits of the component with the largest relative error.
template <class X>
double digits(const X& x, const std::vector<double>& exact) {
  double error = 1e-16;
  for (std::size_t i = 0; i < exact.size(); ++i)
    error = std::max(error, std::abs(x[static_cast<Eigen::Index>(i)] / exact[i] - 1));
  return -std::log10(error);
}

// Digits that the end state may lack compared with the tolerance: each of some hundred steps adds an error of
// one tolerance, and earlier errors decay.
constexpr double lost = 1.5;

/// A linear system with a fast and a slow rate along the axes (0.8, 0.6) and (-0.6, 0.8).
System turned_rates(double fast, double slow) {
  return testing::typed(fmt::format(
      "along = -fast (0.8 x + 0.6 y); across = -slow (0.8 y - 0.6 x); fast = {:.17g}; slow = {:.17g}\n"
      "x' = 0.8 along - 0.6 across; y' = 0.6 along + 0.8 across",
      fast, slow));
}

// Picard sweeps of the first steps diverge so quickly that states overflow before a slope does.
TEST(StiffAdaptiveCollocation, SweepsThatOverflowAreNoSolution) {
  for (const double fast : {1e6, 1e9, 1e12}) {
    const double end = 0.1, slow = 0.3;
    const auto s = integrate(turned_rates(fast, slow), {-0.6, 0.8}, 0, end, to(1e-11, 1e-11));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    const State exact = std::exp(-slow * end) * State{-0.6, 0.8};
    // 30 tolerances, and the rounding error of the axes.
    EXPECT_LT((s.x - exact).cwiseAbs().maxCoeff(), 30 * 1e-11 + 4 * eps) << fast;
  }
}

// Published to 16 digits.
TEST(StiffAdaptiveCollocation, Robertson) {
  const auto exact = published_end_state("Robertson");
  ASSERT_EQ(exact.size(), 3U);
  for (int d = 4; d <= 12; ++d) {
    const double tolerance = std::pow(10., -d);
    const auto s = integrate(System(problems::TextProblem("robertson")),
                             problems::TextProblem("robertson").initial_state(), 0, 1e11,
                             to(tolerance, 1e-8 * tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GT(digits(s.x, exact), d - lost) << tolerance;
    EXPECT_NEAR(s.x.sum(), 1, 64 * eps) << "a linear invariant is kept by Newton's iteration";
  }
}

TEST(StiffAdaptiveCollocation, VanDerPolThousand) {
  auto exact = published_end_state("van der Pol");
  ASSERT_EQ(exact.size(), 2U);
  exact[1] /= 1000;  // the test set's time is t/mu
  for (int d = 4; d <= 13; ++d) {
    const double tolerance = std::pow(10., -d);
    const auto s = integrate(System(problems::TextProblem("van-der-pol", {{"mu", 1000}})), {2, 0}, 0, 2000,
                             to(tolerance, 1e-3 * tolerance));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_GT(digits(s.x, exact), d - lost) << tolerance;
    EXPECT_GT(s.statistics.jacobians, 0) << "sweeps cannot do this";
    EXPECT_LT(s.statistics.steps, 1000) << tolerance;
  }
}

// Components of 1e-4 to 1e-2 with absolute tolerances of at most a hundredth of the smallest; a fast reaction
// ends just before t1. Published to 14 digits. An estimate of lower order than the solution, compared with a
// power of the tolerance, lost up to five digits.
TEST(StiffAdaptiveCollocation, Hires) {
  const auto exact = published_end_state("HIRES");
  ASSERT_EQ(exact.size(), 8U);
  for (int d = 4; d <= 13; ++d) {
    const double tolerance = std::pow(10., -d);
    for (const double absolute : {1e-6 * tolerance, std::min(1e-14, 1e-4 * tolerance)}) {
      const auto s =
          integrate(System(problems::TextProblem("hires")), problems::TextProblem("hires").initial_state(), 0,
                    problems::TextProblem("hires").final_time, to(tolerance, absolute));
      ASSERT_TRUE(s.status.ok()) << s.status.text();
      EXPECT_GT(digits(s.x, exact), d - lost) << tolerance << ' ' << absolute;
    }
  }
}

/// Van der Pol's equation that counts its evaluations in double.
struct Counted {
  static constexpr int dimension = Eigen::Dynamic;
  std::int64_t* count;
  problems::TextProblem problem{"van-der-pol", {{"mu", 100}}};
  [[nodiscard]] int size() const { return problem.size(); }
  template <class T>
  void operator()(const T& t, const Vector<T, Eigen::Dynamic>& x, Vector<T, Eigen::Dynamic>& f) const {
    if constexpr (std::is_same_v<T, double>) ++*count;
    problem(t, x, f);
  }
};
TEST(StiffAdaptiveCollocation, CountsEveryRightHandSide) {
  std::int64_t count = 0;
  const auto s = integrate(System(Counted{.count = &count}), {2, 0}, 0, 200, to(1e-8, 1e-8));
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_GT(s.statistics.factorisations, 0);
  EXPECT_EQ(s.statistics.right_hand_sides, count);
}

// A stiff spring against a Taylor series, and the hardest Duffing oscillator against Jacobi's functions.
TEST(StiffAdaptiveCollocation, StructuresThatVibrateFast) {
  const problems::TextProblem chain("three-dof", {{"k1", 1e8}});
  const State end = testing::reference(chain, State::Zero(6), 0, 2);
  const problems::Duffing hard{.hardening = 1e6};
  for (int d = 4; d <= 12; d += 2) {
    const double tolerance = std::pow(10., -d);
    const auto slow = integrate(System(chain), State::Zero(6), 0, 2, to(tolerance, tolerance));
    ASSERT_TRUE(slow.status.ok()) << slow.status.text();
    EXPECT_LT(oracle::distance(slow.x, end), 100 * tolerance) << tolerance;
    const double P = hard.period(1.0);
    const auto fast = integrate(System(hard.text()), {1, 0}, 0, 10 * P, to(tolerance, tolerance));
    ASSERT_TRUE(fast.status.ok()) << fast.status.text();
    const State exact = oracle::duffing(10 * P, hard);
    // In the time unit 1/sqrt(eta) of this motion the interval is ten periods of an oscillator like that of
    // Table 4.1.
    const double bound = static_cast<double>(fast.statistics.steps) * (tolerance + eps) * 75;
    EXPECT_LT(std::abs(fast.x[0] - exact[0]), bound) << tolerance;
  }
}

// A stiff problem that becomes non-stiff: Newton's iteration first, then a return to sweeps.
TEST(StiffAdaptiveCollocation, ComesBackToSweeps) {
  const System system = testing::typed("x' = cos(t) - 1e5 exp(-t) (x - sin(t))");
  const auto stiff = integrate(system, State{0.0}, 0, 10, to(1e-8, 1e-8));
  ASSERT_TRUE(stiff.status.ok()) << stiff.status.text();
  EXPECT_GT(stiff.statistics.jacobians, 0);
  const auto all = integrate(system, State{0.0}, 0, 100, to(1e-8, 1e-8));
  ASSERT_TRUE(all.status.ok()) << all.status.text();
  EXPECT_NEAR(all.x[0], std::sin(100.), 1e-6);  // 1e-8 in each of some hundred steps
  const auto late = all.statistics.factorisations - stiff.statistics.factorisations;
  EXPECT_LT(late, 40) << "Newton's iteration went on where sweeps suffice";
}

}  // namespace
}  // namespace nlmech::ivp::adaptive_collocation_stiff_test
