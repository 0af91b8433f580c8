/// What every method that chooses its steps owes, ours and peers: no step beyond Limits::largest_step, and an
/// error estimate that sees forces of the time alone, unless its row of the registry says otherwise. And the
/// method that is taken by default on random equations with such forces.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/ivp/step_control.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison::chosen_steps_test {
namespace {

using ivp::State;

ivp::System typed(const std::string& equation) {
  return ivp::System(program::Problem(program::Equations(program::SourceText("equation", equation))));
}

/// Tolerances by which the worst method may be off at an end: gsl-msbdf on an oscillator (peers_ivp).
constexpr double worst = 45000;

class EveryMethod : public ::testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static ivp::Solution run(const std::string& equation, const State& x0, double t0, double t1,
                                         double tolerance, const ivp::Limits& limits,
                                         const ivp::Observer& observer = {}) {
    return any_method(GetParam())
        .with({.tolerance = tolerance})(typed(equation), x0, t0, t1, observer, limits);
  }
};

std::vector<std::string> with_chosen_steps() {
  std::vector<std::string> names;
  for (const std::string& name : built_method_names()) {
    if (!any_method(name).fixed_step()) names.push_back(name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(ChosenSteps, EveryMethod, ::testing::ValuesIn(with_chosen_steps()),
                         [](const auto& method) {
                           std::string name = method.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Odeint meets the end by a step that is longer by at most 1e-12 of itself; times are rounded.
TEST_P(EveryMethod, TakesNoStepBeyondTheBound) {
  for (const double end : {10.0, -10.0}) {
    for (const double bound : {0.03, 0.7}) {
      double longest = 0, t = 0;
      const auto look = [&](const ivp::Step& step) {
        EXPECT_EQ(step.t0, t);
        t = step.t1;
        longest = std::max(longest, std::abs(step.t1 - step.t0) - 2 * ivp::spacing(10));
        return true;
      };
      const auto solution = run("x'' = -x", {1, 0}, 0, end, 1e-3, {.largest_step = bound}, look);
      ASSERT_TRUE(solution.status.ok()) << solution.status.text();
      EXPECT_EQ(t, end);
      EXPECT_LE(longest, bound * (1 + 1e-12)) << end;
      EXPECT_GE(static_cast<double>(solution.statistics.steps), 10 / bound - 1);
    }
  }
}

// After a rest of a hundred times its length. What does not see the pulse is off by 0.886; the bound is
// gsl-msbdf's.
TEST_P(EveryMethod, MeetsAPulseAfterARest) {
  const double area = std::sqrt(std::numbers::pi) / 2, tolerance = 1e-7;
  const auto solution = run("x'' = exp(-((t-50)/0.5)^2)", {0, 0}, 0, 100, tolerance, {.largest_step = 0.25});
  ASSERT_TRUE(solution.status.ok()) << solution.status.text();
  EXPECT_NEAR(solution.x[1], area, worst * tolerance);
  EXPECT_NEAR(solution.x[0], 50 * area, 50 * worst * tolerance);
}

TEST_P(EveryMethod, ABoundBeyondItsStepsChangesNothing) {
  const std::string equation = "x'' = cos(3 t) - x - x^3";
  const auto free = run(equation, {1, 0}, 0, 10, 1e-6, {}),
             bounded = run(equation, {1, 0}, 0, 10, 1e-6, {.largest_step = 1e3});
  EXPECT_TRUE(free.status.ok()) << free.status.text();
  EXPECT_EQ(free.x, bounded.x);
  EXPECT_EQ(free.statistics.steps, bounded.statistics.steps);
  EXPECT_EQ(free.statistics.right_hand_sides, bounded.statistics.right_hand_sides);
}

// Beside a component that rests. An estimate of 0 leaves an error that does not depend on the tolerance.
TEST_P(EveryMethod, EstimatesTheErrorOfAQuadrature) {
  const ivp::MethodInfo info = any_method(GetParam());
  if (info.second_order_only) GTEST_SKIP() << "for accelerations";
  const auto error = [&](double tolerance) {
    const auto solution = run("x' = cos(10 t); y' = 0", {0, 1}, 0, 1, tolerance, {});
    EXPECT_TRUE(solution.status.ok()) << solution.status.text();
    return std::abs(solution.x[0] - std::sin(10) / 10);
  };
  if (info.estimate_misses_time)
    EXPECT_GT(error(1e-10), worst * 1e-10);
  else
    for (const double tolerance : {1e-7, 1e-10}) EXPECT_LT(error(tolerance), worst * tolerance);
}

TEST_P(EveryMethod, EstimatesTheErrorOfAForce) {
  const ivp::MethodInfo info = any_method(GetParam());
  if (info.estimate_misses_time) GTEST_SKIP() << "is not chosen for it";
  for (const double tolerance : {1e-7, 1e-9}) {
    const auto solution = run("x'' = cos(10 t)", {0, 0}, 0, 5, tolerance, {});
    ASSERT_TRUE(solution.status.ok()) << solution.status.text();
    EXPECT_NEAR(solution.x[0], (1 - std::cos(50)) / 100, worst * tolerance);
    EXPECT_NEAR(solution.x[1], std::sin(50) / 10, worst * tolerance);
  }
}

TEST(DependsOnTime, BySymbolsAndByClocks) {
  const auto depends = [](const std::string& equation) {
    return depends_on_time(typed(equation), 0, State{1, 0.5});
  };
  EXPECT_TRUE(depends("x'' = cos(10 t)"));
  EXPECT_TRUE(depends("x'' + x = 1e-300 t"));
  EXPECT_TRUE(depends("x'' = exp(-((t-50)/0.5)^2)"));    // whose derivative at 0 is 0 in doubles
  EXPECT_TRUE(depends("x' = cos(10 s); s' = 1"));        // a component in the place of the time
  EXPECT_TRUE(depends("x' = max(sin(t), 0); y' = -y"));  // where it switches
  EXPECT_FALSE(depends("x'' + 0.1 x' + x + x^3 = 0"));
  EXPECT_FALSE(depends("x' = k x; k' = 0"));  // a constant unknown is no clock
  EXPECT_FALSE(depends("x'' = -sin(x) + 2"));
}

/// Numbers that are the same everywhere: distributions of the library differ between its implementations.
class Random {
 public:
  /// From least to most, equally likely in the logarithm.
  [[nodiscard]] double size(double least, double most) {
    const double share = static_cast<double>(engine_() >> 11) * 0x1p-53;
    return least * std::pow(most / least, share);
  }

 private:
  std::mt19937_64 engine_{20261127};
};

/// A random equation with its solution at an end.
struct Forced {
  std::string text;
  double end, exact;
};

// a cos(w t) over a rest, over a decay, over an oscillator, and three smooth quadratures: closed forms.
Forced forced(Random& random, int kind) {
  using Complex = std::complex<double>;
  const double a = random.size(0.1, 10), w = random.size(0.5, 50), end = random.size(0.5, 10),
               k = random.size(1e-3, 1);
  switch (kind) {
    case 0: return {fmt::format("x' = {}*cos({}*t)", a, w), end, a / w * std::sin(w * end)};
    case 1:
      return {fmt::format("x' = {}/(1 + {}*t^2)", a, w), end,
              a / std::sqrt(w) * std::atan(std::sqrt(w) * end)};
    case 2:
      return {fmt::format("x' = {}*sqrt(t + {})", a, k), end,
              a * 2 / 3 * (std::pow(end + k, 1.5) - std::pow(k, 1.5))};
    case 3: return {fmt::format("x'' = {}*cos({}*t)", a, w), end, a / (w * w) * (1 - std::cos(w * end))};
    case 4: {
      const Complex part = a / Complex(k, w);
      return {fmt::format("x' = {}*cos({}*t) - {}*x", a, w, k), end,
              (part * std::exp(Complex(0, w * end))).real() - part.real() * std::exp(-k * end)};
    }
    default: {  // x'' + 2 k x' + k^2 (1 + 9) x: roots -k +- 3 k i
      const Complex r(-k, 3 * k), part = a / Complex(10 * k * k - w * w, 2 * k * w);
      const double x0 = -part.real(), v0 = -(Complex(0, w) * part).real();
      const Complex c = (v0 - std::conj(r) * x0) / (r - std::conj(r));
      return {fmt::format("x'' + {}*x' + {}*x = {}*cos({}*t)", 2 * k, 10 * k * k, a, w), end,
              (2.0 * c * std::exp(r * end) + part * std::exp(Complex(0, w * end))).real()};
    }
  }
}

// Right within what verification allows, a hundred tolerances of 1e-9, and never refused.
TEST(DefaultMethod, AnswersWhatIsForced) {
  Random random;
  for (int i = 0; i < 60; ++i) {
    const Forced f = forced(random, i % 6);
    SCOPED_TRACE(fmt::format("{} to {}", f.text, f.end));
    const auto problem = typed_problem(program::SourceText("equation", f.text), {});
    const RunOptions options{.x0 = ivp::State::Zero(problem.system.size()),
                             .t0 = 0,
                             .t1 = f.end,
                             .settings = {},
                             .every = {},
                             .limits = {.seconds = 60},
                             .verify = true};
    const ivp::MethodInfo& method = usual_method(problem, options);
    try {
      const Trajectory run = trajectory(problem, options, method);
      const std::string last = run.rows.substr(run.rows.rfind('\n', run.rows.size() - 2) + 1);
      const double x = std::stod(last.substr(last.find(',') + 1));
      EXPECT_NEAR(x, f.exact, 1e-7 * (1 + std::abs(f.exact))) << method.name;
      EXPECT_EQ(run.remark, "") << method.name;
    } catch (const Failure& failure) {
      ADD_FAILURE() << method.name << ": " << failure.what();
    }
  }
}

}  // namespace
}  // namespace nlmech::comparison::chosen_steps_test
