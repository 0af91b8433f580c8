/// Verification of runs, for problems whose condition number has a closed form.
#include "nlmech/comparison/reference/verification.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/reference/reference_of.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/oracle.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::comparison::verification_test {
namespace {

using Verdict = Verification::Verdict;

/// From (1, -1) the solution decays as exp(-t), and every error grows as exp(t).
program::Problem saddle() { return ivp::testing::typed_problem("x'' = x"); }

/// Verifies a run whose first component has an error of @p error at the end.
template <class Problem>
Verification verdict(const Problem& problem, const problems::StateOf<double, Problem>& x0, double end,
                     double error, const Tolerance& tolerance, const WorkLimit& effort = {}) {
  const std::vector<double> times = times_to_check(0, end, 16);
  const Reference expected = reference_of(problem, x0, 0, times, tolerance / 10, effort);
  Verified run{times, Eigen::MatrixXd(x0.size(), 16), tolerance};
  if (expected.status.ok()) run.states = expected.states.template cast<double>();
  run.states(0, 15) += error;
  return verify(ivp::System(problem), x0, 0, run, expected, {});
}

TEST(Verify, CountsTolerances) {
  const Tolerance tolerance{1e-9, 1e-9};
  const Vector<double, 2> end = oracle::duffing(3);
  const double unit = 1e-9 * (1 + std::abs(end[0]));
  const Verification good = verdict(problems::TextProblem("duffing"), {1, 0}, 3, 40 * unit, tolerance);
  EXPECT_EQ(good.verdict, Verdict::right);
  EXPECT_NEAR(good.tolerances, 40, 0.01);  // rounding of the state adds 1e-15
  const Verification off = verdict(problems::TextProblem("duffing"), {1, 0}, 3, 1000 * unit, tolerance);
  EXPECT_EQ(off.verdict, Verdict::inexact);
  EXPECT_EQ(off.component, 0);
  EXPECT_EQ(off.t, 3);
  EXPECT_NEAR(off.tolerances, 1000, 0.1);
  EXPECT_NEAR(off.digits, -std::log10(1000 * unit / std::abs(end[0])), 1e-3);
  // Half of the nine digits are required.
  const double edge = std::pow(10, -4.5) * std::abs(end[0]);
  EXPECT_EQ(verdict(problems::TextProblem("duffing"), {1, 0}, 3, 0.9 * edge, tolerance).verdict,
            Verdict::inexact);
  const Verification bad = verdict(problems::TextProblem("duffing"), {1, 0}, 3, 1.1 * edge, tolerance);
  EXPECT_EQ(bad.verdict, Verdict::wrong);
  EXPECT_EQ(bad.component, 0);
  EXPECT_EQ(bad.t, 3);
}

TEST(Verify, EnoughAreHalfOfTheDigitsAndThree) {
  EXPECT_NEAR(required_digits(1e-12), 6, 1e-12);
  EXPECT_EQ(required_digits(1e-3), 3);
  EXPECT_EQ(required_digits(10), 3);
}

// The component decays from 1 to 8e-7: an error of 200 absolute tolerances is small relative to the initial
// size.
TEST(Verify, DigitsOfWhatDecaysAreRelativeToItsSize) {
  const Verification v = verdict(saddle(), {1, -1}, 14, 2e-7, {1e-9, 1e-9});
  EXPECT_EQ(v.verdict, Verdict::inexact);
  EXPECT_NEAR(v.digits, 6.7, 0.01);
}

// An initial error a in x and v becomes a (cosh t + sinh t) = a exp(t).
TEST(Amplification, OfTheSaddleIsTheExponential) {
  const double a = 1e-9;
  const std::vector<double> times = times_to_check(0, 5, 16);
  const Reference expected = reference_of(saddle(), {1, -1}, 0, times, {}, {});
  ASSERT_TRUE(expected.status.ok());
  const Eigen::MatrixXd weight = Eigen::MatrixXd::Constant(2, 16, a);
  Eigen::MatrixXd moved;
  const ReferenceRequest way{ExtendedState(Eigen::Vector2d(1, -1).cast<long double>()), 0, times};
  ASSERT_TRUE(amplification(way, expected, Eigen::Vector2d(a, a), weight, 10, moved).ok());
  for (Eigen::Index k = 0; k < 16; ++k) {
    const double exact = a * std::exp(times[static_cast<std::size_t>(k)]);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(moved(i, k) / exact, 1, 1e-6);  // differences over 2e-7
  }
}

// x'' + x + x^3 = 0: the frequency depends on the amplitude, so an error e of the amplitude shifts the phase
// by omega'(A) e t. The products of sixteen matrices may overestimate it only by a factor.
TEST(Amplification, OfAnOscillatorGrowsWithTimeAlone) {
  for (const double end : {100.0, 1600.0}) {
    const std::vector<double> times = times_to_check(0, end, 16);
    const Reference expected = reference_of(problems::TextProblem("duffing"), {1, 0}, 0, times, {}, {});
    ASSERT_TRUE(expected.status.ok());
    Eigen::MatrixXd moved;
    const ReferenceRequest way{ExtendedState(Eigen::Vector2d(1, 0).cast<long double>()), 0, times};
    ASSERT_TRUE(
        amplification(way, expected, Eigen::Vector2d(1, 1), Eigen::MatrixXd::Ones(2, 16), 10, moved).ok());
    const double most = moved.rightCols(1).maxCoeff();
    EXPECT_GT(most, 0.1 * end);
    EXPECT_LT(most, 3 * end);
  }
}

TEST(Verify, AllowsWhatTheProblemMakesOfErrors) {
  // At t = 8 the initial tolerance has grown 3000 times.
  const Tolerance tolerance{1e-12, 1e-12};
  const Verification v = verdict(saddle(), {1, -1}, 8, 2000 * 1e-12, tolerance);
  EXPECT_EQ(v.verdict, Verdict::inexact);
  EXPECT_GT(v.tolerances, 1000);
  EXPECT_NEAR(v.growth / std::exp(8.0), 1, 2);  // weights decrease by about half over the interval
  EXPECT_EQ(verdict(saddle(), {1, -1}, 8, 3e6 * 1e-12, tolerance).verdict, Verdict::wrong);
  // At t = 14 an initial error of 1e-9 has grown to 1e-3, a thousand times the solution: no digit is left.
  EXPECT_EQ(verdict(saddle(), {1, -1}, 14, 1e-3, {1e-9, 1e-9}).verdict, Verdict::undetermined);
}

TEST(Verify, SaysThatNothingIsDetermined) {
  EXPECT_EQ(verdict(problems::TextProblem("lorenz"), {0, 1, 0}, 30, 5, {1e-9, 1e-9}).verdict,
            Verdict::undetermined);
  EXPECT_EQ(verdict(problems::TextProblem("lorenz"), {0, 1, 0}, 60, 5, {1e-12, 1e-12}).verdict,
            Verdict::undetermined);
}

// A motion far below the tolerance is not chaotic: an error far above the tolerance is wrong.
TEST(Verify, ACoarseToleranceIsNoExcuse) {
  EXPECT_EQ(verdict(problems::TextProblem("duffing"), {1e-7, 0}, 3, 5, {1e-6, 1e-6}).verdict, Verdict::wrong);
  EXPECT_EQ(verdict(problems::TextProblem("duffing"), {1e-7, 0}, 3, 1e-5, {1e-6, 1e-6}).verdict,
            Verdict::right);
  const Verification off = verdict(problems::TextProblem("duffing"), {1e-7, 0}, 3, 2e-4, {1e-6, 1e-6});
  EXPECT_EQ(off.verdict, Verdict::inexact);  // digits below the absolute tolerance are not required
  EXPECT_NEAR(off.digits, -std::log10(2e-4), 0.01);
}

TEST(Verify, SaysThatItDoesNotKnow) {
  const Verification v = verdict(problems::TextProblem("duffing", {{"natural_frequency", 1e12}}), {1, 0}, 1e3,
                                 0, {1e-9, 1e-9}, {.work = 0.02});
  EXPECT_EQ(v.verdict, Verdict::unknown);
  EXPECT_NE(v.reason.find("step_limit"), std::string::npos) << v.reason;
}

// y' = -1/(2 y) ends at t = 1 with an infinite slope; before that time verification works as usual.
TEST(Verify, SaysThatTheSolutionEnds) {
  const program::Problem problem = problems::TextProblem("dead-end");
  const Verification v = verdict(problem, ivp::State{1}, 2, 0, {1e-3, 1e-3});
  EXPECT_EQ(v.verdict, Verdict::ended) << v.reason;
  EXPECT_NE(v.reason.find("step_underflow"), std::string::npos) << v.reason;
  EXPECT_EQ(verdict(problem, ivp::State{1}, 0.9, 0, {1e-3, 1e-3}).verdict, Verdict::right);
}

// An error below the uncertainty of the reference does not give the verdict wrong.
TEST(Verify, TakesTheUncertaintyOfTheReferenceIntoAccount) {
  const std::vector<double> times = {1};
  Reference expected = reference_of(problems::TextProblem("duffing"), {1, 0}, 0, times, {}, {});
  expected.difference.setConstant(1e-6);
  Verified run{times, expected.states.cast<double>(), {1e-9, 1e-9}};
  run.states(0, 0) += 9e-7;
  const ivp::System system{problems::TextProblem("duffing")};
  EXPECT_EQ(verify(system, {1, 0}, 0, run, expected, {}).verdict, Verdict::unknown);
  run.states(0, 0) += 1e-4;
  EXPECT_EQ(verify(system, {1, 0}, 0, run, expected, {}).verdict, Verdict::wrong);
}

// Exact solution of a Duffing oscillator (elliptic functions) with an error of some tolerances at the end,
// against another method; and a method that does not reach the end.
TEST(Verify, AgreesWithAnotherMethod) {
  const ivp::System system{problems::TextProblem("duffing")};
  const std::vector<double> times = {1, 2, 3};
  const ivp::NamedIntegrator other = ivp::named_integrator("dop853", {.tolerance = 1e-10});
  const auto agree = [&](double error, const ivp::Limits& limits) {
    Verified run{times, Eigen::MatrixXd(2, 3), {1e-9, 1e-9}};
    for (Eigen::Index k = 0; k < 3; ++k)
      run.states.col(k) = oracle::duffing(times[static_cast<std::size_t>(k)]);
    run.states.col(1).setConstant(std::nan(""));  // not requested at this time
    run.states(0, 2) += error * 1e-9 * (1 + std::abs(run.states(0, 2)));
    return agrees(system, {1, 0}, 0, run, other, limits);
  };
  EXPECT_TRUE(agree(0, {}));
  EXPECT_TRUE(agree(most_tolerances - 10, {}));  // dop853's own error is some tenths of a tolerance
  EXPECT_FALSE(agree(most_tolerances + 10, {}));
  EXPECT_FALSE(agree(0, {.steps = 3}));
}

TEST(Remark, NamesWhatToChange) {
  const ivp::MethodInfo& method = any_method("ode45");
  Verification v;
  v.verdict = Verdict::wrong;
  v.t = 20;
  v.error = 3e-5;
  v.tolerances = 3e4;
  const auto text_of = [&] {
    try {
      return remark(v, {}, method, {.tolerance = 1e-9}, {"x1", "v1"}, 20);
    } catch (const Failure& failure) {
      return "FAILED " + std::string(failure.what());
    }
  };
  // 3e4 tolerances where 100 are allowed: a factor of 300, and 3 for safety, gives 1e-12.
  for (const char* word : {"FAILED", "ode45", "x1 at t = 20", "3e-05", "3e+04 times", "1e-09",
                           "the error of each step", "--tolerance 1e-12", "--no-verify"})
    EXPECT_NE(text_of().find(word), std::string::npos) << word << " is not in " << text_of();
  v.tolerances = 1e9;
  EXPECT_EQ(text_of().find("--tolerance"), std::string::npos) << "1e-17 does not help: " << text_of();
  v.verdict = Verdict::undetermined;
  v.growth = 1e12;
  v.digits = 0;
  EXPECT_NE(text_of().find("no digit of x1 at t = 20 is certain, where 4.5 are required"), std::string::npos)
      << text_of();
  v.digits = 2.66;
  EXPECT_NE(text_of().find("2.6 digits of x1 at t = 20 are certain"), std::string::npos) << text_of();
  v.verdict = Verdict::unknown;
  v.reason = "no reference";
  EXPECT_EQ(text_of(), "not verified: no reference");
  v.verdict = Verdict::ended;
  EXPECT_NE(text_of().find("FAILED"), std::string::npos) << text_of();
  EXPECT_NE(text_of().find("seems to end before the final time"), std::string::npos) << text_of();
  v.verdict = Verdict::right;
  v.tolerances = 99;
  EXPECT_EQ(text_of(), "");
  v.verdict = Verdict::inexact;
  v.tolerances = 2000;
  v.digits = 4.58;
  EXPECT_EQ(text_of(),
            "verified: 4.5 digits at the end; x1 is off by 3e-05 there, 2e+03 tolerances; the problem "
            "multiplies errors by up to 1e+12");
  v.growth = 0;  // growth unknown
  v.t = 19;
  EXPECT_EQ(text_of(), "verified: 4.5 digits at t = 19; x1 is off by 3e-05 there, 2e+03 tolerances");
}

}  // namespace
}  // namespace nlmech::comparison::verification_test
