/// Verdicts on runs, against problems whose condition has a closed form.
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

/// From (1, -1) it decays as exp(-t), and every error grows as exp(t).
program::Problem saddle() { return ivp::testing::typed_problem("x'' = x"); }

/// A run of a problem that is off by @p error in its first component at the end.
template <class Problem>
Verification verdict(const Problem& problem, const problems::StateOf<double, Problem>& x0, double end,
                     double error, const Tolerance& tolerance, const WorkLimit& effort = {}) {
  const std::vector<double> times = look_at(0, end, 16);
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
  // Half of nine digits are enough.
  const double edge = std::pow(10, -4.5) * std::abs(end[0]);
  EXPECT_EQ(verdict(problems::TextProblem("duffing"), {1, 0}, 3, 0.9 * edge, tolerance).verdict,
            Verdict::inexact);
  const Verification bad = verdict(problems::TextProblem("duffing"), {1, 0}, 3, 1.1 * edge, tolerance);
  EXPECT_EQ(bad.verdict, Verdict::wrong);
  EXPECT_EQ(bad.component, 0);
  EXPECT_EQ(bad.t, 3);
}

TEST(Verify, EnoughAreHalfOfTheDigitsAndThree) {
  EXPECT_NEAR(enough_digits(1e-12), 6, 1e-12);
  EXPECT_EQ(enough_digits(1e-3), 3);
  EXPECT_EQ(enough_digits(10), 3);
}

// 1 decays to 8e-7: an error of 200 absolute tolerances there is no loss of digits.
TEST(Verify, DigitsOfWhatDecaysAreRelativeToItsSize) {
  const Verification v = verdict(saddle(), {1, -1}, 14, 2e-7, {1e-9, 1e-9});
  EXPECT_EQ(v.verdict, Verdict::inexact);
  EXPECT_NEAR(v.digits, 6.7, 0.01);
}

// An error of the size a in x and v, made at the start, becomes a (cosh t + sinh t) = a exp(t).
TEST(Amplification, OfTheSaddleIsTheExponential) {
  const double a = 1e-9;
  const std::vector<double> times = look_at(0, 5, 16);
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

// Along x'' + x + x^3 = 0 the phase shears: the frequency depends on the amplitude, and an error e of it
// moves the phase by omega'(A) e t. Products of sixteen matrices must not make more of it than a factor.
TEST(Amplification, OfAnOscillatorGrowsWithTimeAlone) {
  for (const double end : {100.0, 1600.0}) {
    const std::vector<double> times = look_at(0, end, 16);
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
  // At t = 8 one tolerance of the start has become 3000.
  const Tolerance tolerance{1e-12, 1e-12};
  const Verification v = verdict(saddle(), {1, -1}, 8, 2000 * 1e-12, tolerance);
  EXPECT_EQ(v.verdict, Verdict::inexact);
  EXPECT_GT(v.tolerances, 1000);
  EXPECT_NEAR(v.growth / std::exp(8.0), 1, 2);  // weights fall by some half on the way
  EXPECT_EQ(verdict(saddle(), {1, -1}, 8, 3e6 * 1e-12, tolerance).verdict, Verdict::wrong);
  // At t = 14 one of 1e-9 has become 1e-3, so that few digits are no fault.
  EXPECT_EQ(verdict(saddle(), {1, -1}, 14, 1e-3, {1e-9, 1e-9}).verdict, Verdict::inexact);
}

TEST(Verify, SaysThatNothingIsDetermined) {
  EXPECT_EQ(verdict(problems::TextProblem("lorenz"), {0, 1, 0}, 30, 5, {1e-9, 1e-9}).verdict,
            Verdict::undetermined);
  EXPECT_EQ(verdict(problems::TextProblem("lorenz"), {0, 1, 0}, 60, 5, {1e-12, 1e-12}).verdict,
            Verdict::undetermined);
}

// A motion far below the tolerance is not chaos: what is far above it is wrong.
TEST(Verify, ACoarseToleranceIsNoExcuse) {
  EXPECT_EQ(verdict(problems::TextProblem("duffing"), {1e-7, 0}, 3, 5, {1e-6, 1e-6}).verdict, Verdict::wrong);
  EXPECT_EQ(verdict(problems::TextProblem("duffing"), {1e-7, 0}, 3, 1e-5, {1e-6, 1e-6}).verdict,
            Verdict::right);
  const Verification off = verdict(problems::TextProblem("duffing"), {1e-7, 0}, 3, 2e-4, {1e-6, 1e-6});
  EXPECT_EQ(off.verdict, Verdict::inexact);  // a digit of what is below the absolute tolerance means nothing
  EXPECT_NEAR(off.digits, -std::log10(2e-4), 0.01);
}

TEST(Verify, SaysThatItDoesNotKnow) {
  const Verification v = verdict(problems::TextProblem("duffing", {{"natural_frequency", 1e12}}), {1, 0}, 1e3,
                                 0, {1e-9, 1e-9}, {.work = 0.02});
  EXPECT_EQ(v.verdict, Verdict::unknown);
  EXPECT_NE(v.reason.find("step_limit"), std::string::npos) << v.reason;
}

// y' = -1/(2 y) ends at t = 1 with an infinite slope; before it, all is as ever.
TEST(Verify, SaysThatTheSolutionEnds) {
  const program::Problem problem = problems::TextProblem("dead-end");
  const Verification v = verdict(problem, ivp::State{1}, 2, 0, {1e-3, 1e-3});
  EXPECT_EQ(v.verdict, Verdict::ended) << v.reason;
  EXPECT_NE(v.reason.find("step_underflow"), std::string::npos) << v.reason;
  EXPECT_EQ(verdict(problem, ivp::State{1}, 0.9, 0, {1e-3, 1e-3}).verdict, Verdict::right);
}

// A reference that knows eight digits does not find a run wrong that is off by as much.
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

// What a user reads: method, place, how far off, what the tolerance holds, what to change.
// A run of a Duffing oscillator by its elliptic functions, off by some tolerances at the end, beside a method
// that shares nothing with them; and one that does not arrive.
TEST(Verify, AgreesWithAnotherMethod) {
  const ivp::System system{problems::TextProblem("duffing")};
  const std::vector<double> times = {1, 2, 3};
  const ivp::NamedIntegrator other = ivp::named_integrator("dop853", {.tolerance = 1e-10});
  const auto agree = [&](double error, const ivp::Limits& limits) {
    Verified run{times, Eigen::MatrixXd(2, 3), {1e-9, 1e-9}};
    for (Eigen::Index k = 0; k < 3; ++k)
      run.states.col(k) = oracle::duffing(times[static_cast<std::size_t>(k)]);
    run.states.col(1).setConstant(std::nan(""));  // where it was not asked
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
  // 3e4 tolerances where 100 are let pass: 300 times less, and 3 for safety, is 1e-12.
  for (const char* word : {"FAILED", "ode45", "x1 at t = 20", "3e-05", "3e+04 times", "1e-09",
                           "the error of each step", "--tolerance 1e-12", "--no-verify"})
    EXPECT_NE(text_of().find(word), std::string::npos) << word << " is not in " << text_of();
  v.tolerances = 1e9;
  EXPECT_EQ(text_of().find("--tolerance"), std::string::npos) << "1e-17 does not help: " << text_of();
  v.verdict = Verdict::undetermined;
  v.growth = 1e12;
  EXPECT_NE(text_of().find("nothing determines x1 at t = 20"), std::string::npos) << text_of();
  v.verdict = Verdict::unknown;
  v.reason = "no reference";
  EXPECT_EQ(text_of(), "not verified: no reference");
  v.verdict = Verdict::ended;
  EXPECT_NE(text_of().find("FAILED"), std::string::npos) << text_of();
  EXPECT_NE(text_of().find("seems to end on the way"), std::string::npos) << text_of();
  v.verdict = Verdict::right;
  v.tolerances = 99;
  EXPECT_EQ(text_of(), "");
  v.verdict = Verdict::inexact;
  v.tolerances = 2000;
  v.digits = 4.58;
  EXPECT_EQ(text_of(),
            "verified: 4.5 digits at the end; x1 is off by 3e-05 there, 2e+03 tolerances; the problem "
            "multiplies errors by up to 1e+12");
  v.growth = 0;  // not known
  v.t = 19;
  EXPECT_EQ(text_of(), "verified: 4.5 digits at t = 19; x1 is off by 3e-05 there, 2e+03 tolerances");
}

}  // namespace
}  // namespace nlmech::comparison::verification_test
