// adaptive-collocation where equations are stiff.
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

/// Digits of the largest error relative to each component.
template <class X>
double digits(const X& x, const std::vector<double>& exact) {
  double error = 1e-16;
  for (std::size_t i = 0; i < exact.size(); ++i)
    error = std::max(error, std::abs(x[static_cast<Eigen::Index>(i)] / exact[i] - 1));
  return -std::log10(error);
}

// Digits that an end may lack of those asked: each of some hundred steps errs by a tolerance, and earlier
// errors fade.
constexpr double lost = 1.5;

/// A fast and a slow rate along the axes (0.8, 0.6) and (-0.6, 0.8).
System turned_rates(double fast, double slow) {
  return testing::typed(fmt::format(
      "along = -fast (0.8 x + 0.6 y); across = -slow (0.8 y - 0.6 x); fast = {:.17g}; slow = {:.17g}\n"
      "x' = 0.8 along - 0.6 across; y' = 0.6 along + 0.8 across",
      fast, slow));
}

// The sweeps of the first steps part so quickly that states overflow before a slope does.
TEST(StiffAdaptiveCollocation, SweepsThatOverflowAreNoSolution) {
  for (const double fast : {1e6, 1e9, 1e12}) {
    const double end = 0.1, slow = 0.3;
    const auto s = integrate(turned_rates(fast, slow), {-0.6, 0.8}, 0, end, to(1e-11, 1e-11));
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    const State exact = std::exp(-slow * end) * State{-0.6, 0.8};
    // 30 tolerances, and the rounding of the axes.
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

// Components of 1e-4 to 1e-2, under absolute tolerances a hundredth of the smallest and less; a fast reaction
// comes to its end just before that of the interval. Published to 14 digits. With an estimate of lower order
// than the end, held against a power of the tolerance, this lost up to five digits.
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

/// Counts its evaluations in double.
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

// The stiff spring and the hardest oscillator against Taylor series and Jacobi's functions.
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
    // In the units of the motion, time 1/sqrt(eta), this is ten periods of an oscillator like Table 4.1's.
    const double bound = static_cast<double>(fast.statistics.steps) * (tolerance + eps) * 75;
    EXPECT_LT(std::abs(fast.x[0] - exact[0]), bound) << tolerance;
  }
}

// Sweeps before the leap, Newton on the branch, and back again: a stiff problem that becomes gentle.
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
