/// Dependence of an equation on time, and the default method on random equations with forces of time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::comparison::default_method_test {
namespace {

using ivp::State;
using ivp::testing::typed;

TEST(DependsOnTime, BySymbolsAndByClocks) {
  const auto depends = [](const std::string& equation) {
    return depends_on_time(typed(equation), 0, State{1, 0.5});
  };
  EXPECT_TRUE(depends("x'' = cos(10 t)"));
  EXPECT_TRUE(depends("x'' + x = 1e-300 t"));
  EXPECT_TRUE(depends("x'' = exp(-((t-50)/0.5)^2)"));    // its derivative at 0 is 0 in doubles
  EXPECT_TRUE(depends("x' = cos(10 s); s' = 1"));        // a component acts as the time
  EXPECT_TRUE(depends("x' = max(sin(t), 0); y' = -y"));  // it switches at known times
  EXPECT_FALSE(depends("x'' + 0.1 x' + x + x^3 = 0"));
  EXPECT_FALSE(depends("x' = k x; k' = 0"));  // a constant unknown does not depend on time
  EXPECT_FALSE(depends("x'' = -sin(x) + 2"));
}

/// Random numbers that do not depend on the standard library: its distributions are implementation-defined.
class Random {
 public:
  /// Uniformly distributed in the logarithm between @p least and @p most.
  [[nodiscard]] double size(double least, double most) {
    const double share = static_cast<double>(engine_() >> 11) * 0x1p-53;
    return least * std::pow(most / least, share);
  }

 private:
  std::mt19937_64 engine_{20261127};
};

/// A random equation and its exact solution at the end.
struct Forced {
  std::string text;
  double end, exact;
};

// Force a cos(w t) alone (first and second order), with decay, and on a damped oscillator; two smooth
// quadratures: closed forms.
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

// Within the bound of the verification, a hundred tolerances of 1e-9, without failures and remarks.
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
                             .order = problem.printed_order(""),
                             .limits = {.seconds = 60},
                             .verify = true};
    const ivp::MethodInfo& method = default_method(problem, options);
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

/// Integration from @p x0 by the default method, or by another one if its result is wrong.
Trajectory default_run(const std::string& text, double x0, double end,
                       const std::function<bool(double t)>& reached = {}) {
  const auto problem = typed_problem(program::SourceText("equation", text), {});
  const RunOptions options{.x0 = State::Constant(1, x0),
                           .t0 = 0,
                           .t1 = end,
                           .settings = {},
                           .every = {},
                           .order = problem.printed_order(""),
                           .limits = {.seconds = 60},
                           .verify = true,
                           .reached = reached};
  return default_trajectory(problem, options, default_method(problem, options));
}

// Cases where long steps may miss a feature: a switch so steep that its derivatives underflow, a pulse after
// a long rest, and slopes that are constant between switches.
TEST(DefaultMethod, MissesNoSwitchAndNoPulse) {
  struct Leap {
    std::string text;
    double x0, end, exact;
  };
  const double pi = 3.14159265358979323846;
  for (const Leap& leap :
       {Leap{"x' = tanh(100 (t - 4.75))", 0, 11.5, 2},  // (log cosh(675) - log cosh(475))/100
        Leap{"x' = exp(-((t - 50)/0.5)^2)", 0, 100, 0.5 * std::sqrt(pi)},
        Leap{"x' = sign(sin(pi t))", 0, 160.5, 0.5}, Leap{"x' = max(sign(sin(pi t)), 0)", 0, 101, 51},
        Leap{"x' = 1 - 2 max(sign(x), 0)", 1, 3, 0}}) {
    SCOPED_TRACE(leap.text);
    const Trajectory run = default_run(leap.text, leap.x0, leap.end);
    const std::string last = run.rows.substr(run.rows.rfind('\n', run.rows.size() - 2) + 1);
    EXPECT_NEAR(std::stod(last.substr(last.find(',') + 1)), leap.exact, 1e-7 * (1 + leap.exact));
    EXPECT_EQ(run.remark, "");
  }
}

TEST(DefaultMethod, ReportsTheUsualMethodWhereNoneArrives) {
  try {
    (void)default_run("x' = x^2", 1, 2);
    ADD_FAILURE() << "it ends at t = 1";
  } catch (const Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("series"), std::string::npos) << failure.what();
  }
}

/// Time and state of the last row.
std::pair<double, double> last_row(const std::string& rows) {
  const std::string last = rows.substr(rows.rfind('\n', rows.size() - 2) + 1);
  return {std::stod(last), std::stod(last.substr(last.find(',') + 1))};
}

TEST(DefaultMethod, EndsWhereItsCallerWantsWithTheRowsUpToThere) {
  double latest = 0;
  const auto until_one = [&latest](double t) { return latest < 1 && (latest = t) < 1; };
  try {
    (void)default_run("x' = cos(10 t)", 0, 1000, until_one);
    ADD_FAILURE() << "it was interrupted";
  } catch (const RunFailure& failure) {
    EXPECT_EQ(failure.status().outcome(), Outcome::interrupted);
    const auto [t, x] = last_row(failure.rows());
    EXPECT_EQ(t, latest);
    EXPECT_NEAR(x, std::sin(10 * t) / 10, 1e-7);  // 100 steps' errors of 1e-9
  }
}

}  // namespace
}  // namespace nlmech::comparison::default_method_test
