#include "nlmech/problems/reference_trajectory.hpp"

#include <gtest/gtest.h>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/problems/oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::problems::tests::reference_trajectory_test {
namespace {

using Long = long double;
constexpr double long_epsilon = 0x1p-63;

template <class Problem>
ReferenceTrajectory<Long, Problem> trajectory(const Problem& problem, double t1,
                                              const ReferenceOptions& options = {}) {
  return {problem, problem.initial_state().template cast<Long>(), 0, t1, options};
}

// In 50 digits against the Jacobi function: rounding errors of some hundred steps only.
TEST(ReferenceStates, OfTheFreeOscillatorInFiftyDigits) {
  const Duffing problem{.natural_frequency = 1.25, .hardening = 3};
  const std::vector<Real> times = {0, 0.125, 1, Real(10) / 3, 10};
  std::vector<Vector<Real, Eigen::Dynamic>> states;
  const Vector<Real, Eigen::Dynamic> x0 = ivp::BasicState<Real>{1, 0};
  const Status status = reference_states(problem.text(), x0, Real(0), std::span<const Real>(times), states);
  ASSERT_TRUE(status.ok()) << status.text();
  ASSERT_EQ(states.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_LT(distance(states[i], free_oscillation(problem, 1, times[i])), 1e-46) << times[i];
}

// In long double to t = 500. Each of N = 3800 steps of h = 0.13 has a random rounding error of its increment
// h x' of eps; an error at time s shifts the phase by up to |d omega/dX| (500 - s) < 300 times itself: 300
// sqrt(N) h eps = 2.6e-16.
TEST(ReferenceTrajectory, FollowsTheJacobiFunctionForAHundredPeriods) {
  const auto solution = trajectory(TextProblem("duffing"), 500);
  ASSERT_TRUE(solution.status().ok()) << solution.status().text();
  for (const double t : {0.0, 0.1, 4.7, 77.7, 333.3, 476.8, 499.999, 500.0})
    EXPECT_LT(distance(solution(t), free_oscillation(Duffing{}, 1, t)), 2.6e-16) << t;
}

// The same estimate for the table: after the impact the orbit has half the amplitude (h = 0.2, N = 2500,
// phase 150); the three masses are a damped system in 500 steps, whose errors grow at most tenfold.
TEST(ReferenceTrajectory, EndsAtTheStatesOfTheTable) {
  const auto impact = trajectory(TextProblem("impact"), 500);
  for (const char* t : {"0.5", "1", "499", "500"})
    EXPECT_LT(distance(impact(std::stold(t)), reference_state<2>("impact", "", t)), 1.6e-16) << t;
  EXPECT_LT(distance(impact(1), reference_state<2>("impact", "", "1")), 4 * long_epsilon);
  const auto rounded = trajectory(TextProblem("three-dof"), 200);
  EXPECT_LT(distance(rounded(200), reference_state<6>("three-dof", "as doubles", "200")),
            10 * 23 * long_epsilon);
}

// Parameters rounded to double define another problem: the phase of its load differs by 200 eps in the end,
// and the state of the resonant chain by some 5e-15. A double-precision method must be compared with the
// solution of the rounded problem.
TEST(ReferenceTrajectory, TellsRoundedParametersFromExactOnes) {
  const double shift = distance(reference_state<6>("three-dof", "as doubles", "200"),
                                reference_state<6>("three-dof", "", "200"));
  EXPECT_GT(shift, 1e-15);
  EXPECT_LT(shift, 1e-14);
}

RC_GTEST_PROP(ReferenceTrajectory, IsSmoothAcrossItsSteps, ()) {
  static const auto solution = trajectory(TextProblem("duffing"), 50);
  // Two close times may lie in different steps: the states differ by f dt and the rounding of the first.
  const Long t = *between(0, 49.9), dt = 1e-12L;
  Vector<Long, Eigen::Dynamic> slope(2);
  static const TextProblem duffing("duffing");
  duffing(t, solution(t), slope);
  RC_ASSERT(distance(solution(t + dt), ivp::LongState(solution(t) + dt * slope)) < 1e-17);
  RC_ASSERT(std::abs(Duffing{}.energy(solution(t)) - 0.75L) < 1e-17L);
}

TEST(ReferenceTrajectory, DoesNotDependOnOrderAndStep) {
  for (const int order : {12, 30}) {
    const auto chosen =
        trajectory(TextProblem("van-der-pol", {{"mu", 10}}), 20, {.order = order, .tolerance = 1e-21});
    ASSERT_TRUE(chosen.status().ok());
    EXPECT_LT(distance(chosen(20), reference_state<2>("van-der-pol", "mu=10", "20")), 1e-17) << order;
  }
  // A larger tolerance gives fewer steps and a larger error.
  const auto loose = trajectory(TextProblem("duffing"), 20, {.order = 12, .tolerance = 1e-8});
  EXPECT_LT(loose.steps(), trajectory(TextProblem("duffing"), 20).steps());
  const double error = distance(loose(20), free_oscillation(Duffing{}, 1, 20));
  EXPECT_GT(error, 1e-13);
  EXPECT_LT(error, 1e-6);
}

TEST(ReferenceTrajectory, StopsAtAnnouncedTimes) {
  // The states at 1/2 and 1 equal those of the table only if no series crosses a corner of the force.
  const std::vector<Long> times = {0.5L, 1};
  std::vector<Vector<Long, Eigen::Dynamic>> states;
  const Vector<Long, Eigen::Dynamic> rest = Vector<Long, Eigen::Dynamic>::Zero(2);
  ASSERT_TRUE(
      reference_states(TextProblem("impact"), rest, Long(0), std::span<const Long>(times), states).ok());
  EXPECT_LT(distance(states[0], reference_state<2>("impact", "", "0.5")), 4 * long_epsilon);
  EXPECT_LT(distance(states[1], reference_state<2>("impact", "", "1")), 4 * long_epsilon);
}

TEST(ReferenceTrajectory, OfNoLengthIsItsStart) {
  const ReferenceTrajectory<double, TextProblem> solution(TextProblem("duffing"), {1, 2}, 3, 3);
  EXPECT_TRUE(solution.status().ok());
  EXPECT_EQ(solution.steps(), 0U);
  EXPECT_EQ(solution(3), (ivp::State{1, 2}));
}

TEST(ReferenceTrajectory, SumsAreCompensated) {
  Vector<double, 1> sum(1.0), carry(0.0);
  for (int i = 0; i < 1000; ++i) detail::add_compensated(sum, carry, Vector<double, 1>(epsilon / 8));
  EXPECT_EQ(sum[0], 1 + 125 * epsilon);  // without compensation the sum would still be 1
  EXPECT_EQ(carry[0], 0);
}

// Sums of a million such step sizes are exact if their exponents differ by at most 53 - 8 - 20.
RC_GTEST_PROP(ReferenceTrajectory, StepsAreShortBinaryNumbers, ()) {
  const double log2 = *between(-40, 10), step = detail::short_step<double>(log2);
  RC_ASSERT(step <= std::exp2(log2) && step > std::exp2(log2) * (1 - 1.0 / 256));
  const double scaled = std::ldexp(step, 8 - std::ilogb(step));
  RC_ASSERT(scaled == std::floor(scaled));
}

/// x' = 3 t^2: its solution is a polynomial, exact for every step size.
struct Cubic {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& /*x*/, Vector<T, 1>& dxdt) const {
    dxdt[0] = 3 * (t * t);
  }
};

TEST(ReferenceTrajectory, TakesAPolynomialInOneStep) {
  const ReferenceTrajectory<double, Cubic> solution(Cubic{}, Vector<double, 1>(1.0), -2, 1024);
  EXPECT_EQ(solution.steps(), 1U);
  EXPECT_EQ(solution(1024)[0], 9 + 1024.0 * 1024.0 * 1024.0);
}

TEST(ReferenceTrajectory, SaysWhereASolutionEnds) {
  const auto solution = trajectory(TextProblem("blow-up"), 1);
  EXPECT_EQ(solution.status().outcome(), Outcome::step_underflow);
  EXPECT_TRUE(nlmech::tests::holds(solution.status().sentence(), "t = 0.5"));
  EXPECT_LE(solution.end(), 0.5L + 8 * long_epsilon);
  EXPECT_GE(solution.end(), 0.5L - 1e-15L);
  EXPECT_LT(solution.steps(), 2000U);
  // y(0.49) = 1/sqrt(1 - 0.98) has the condition number 0.98/0.04 = 25.
  EXPECT_NEAR(static_cast<double>(solution(0.49L)[0] / std::sqrt(50.0L) - 1), 0, 100 * 0x1p-53);
  EXPECT_THROW((void)solution(0.75L), std::invalid_argument);
}

/// x' = sqrt(1 - t), which is NaN for t > 1.
struct Root {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    using std::sqrt;
    dxdt[0] = sqrt(1 - t) + 0 * x[0];
  }
};

TEST(ReferenceTrajectory, ReportsWhatIsNotANumber) {
  const ReferenceTrajectory<double, Root> beyond(Root{}, Vector<double, 1>(0.0), 1.5, 3);
  EXPECT_EQ(beyond.status().outcome(), Outcome::non_finite);
  EXPECT_EQ(beyond.end(), 1.5);
  const ReferenceTrajectory<double, Root> up_to(Root{}, Vector<double, 1>(0.0), 0, 3);
  EXPECT_FALSE(up_to.status().ok());
  // Within eps^(2/3) = 4e-11 of t = 1 the term (1 - t)^(3/2) of the solution is below rounding, hence also
  // the end of the trajectory.
  EXPECT_NEAR(up_to.end(), 1, 1e-10);
}

TEST(ReferenceTrajectory, GivesUpAfterItsStepsAreUsed) {
  const auto solution = trajectory(TextProblem("duffing"), 500, {.most_steps = 10});
  EXPECT_EQ(solution.status().outcome(), Outcome::step_limit);
  EXPECT_EQ(solution.steps(), 10U);
  EXPECT_LT(solution.end(), 500);
}

TEST(ReferenceTrajectory, RefusesWhatMakesNoSense) {
  const ivp::State x{1, 0}, nan{std::nan(""), 0};
  using Trajectory = ReferenceTrajectory<double, TextProblem>;
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Trajectory(TextProblem("duffing"), x, 1, 0), std::invalid_argument);
  EXPECT_THROW(Trajectory(TextProblem("duffing"), x, 0, inf), std::invalid_argument);
  EXPECT_THROW(Trajectory(TextProblem("duffing"), x, std::nan(""), 1), std::invalid_argument);
  EXPECT_THROW(Trajectory(TextProblem("duffing"), nan, 0, 1), std::invalid_argument);
  EXPECT_THROW(Trajectory(TextProblem("duffing"), x, 0, 1, {.order = 3}), std::invalid_argument);
  for (const double tolerance : {-1.0, 1.0, std::nan("")})
    EXPECT_THROW(Trajectory(TextProblem("duffing"), x, 0, 1, {.tolerance = tolerance}),
                 std::invalid_argument);
  std::vector<Vector<double, Eigen::Dynamic>> states;
  const Vector<double, Eigen::Dynamic>& plain = x;
  const std::vector<double> descending = {2, 1}, early = {-1};
  EXPECT_THROW(
      (void)reference_states(TextProblem("duffing"), plain, 0.0, std::span<const double>(descending), states),
      std::invalid_argument);
  EXPECT_THROW(
      (void)reference_states(TextProblem("duffing"), plain, 0.0, std::span<const double>(early), states),
      std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::problems::tests::reference_trajectory_test
