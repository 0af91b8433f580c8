/// @file
/// Every integrator by name, nlmech methods and peers, for the tests of all of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::testing {

/// A row of the registry. Methods with adaptive and fixed steps occur twice: with a tolerance and with a step
/// size.
struct Integrator {
  std::string label;  ///< "series", "series_by_steps"
  const MethodInfo* row;
  bool by_steps;
};

inline const std::vector<Integrator>& all_integrators() {
  static const std::vector<Integrator> all = [] {
    std::vector<Integrator> found;
    const auto add = [&found](const MethodInfo& row, const std::string& suffix, bool by_steps) {
      std::string label = std::string(row.name) + suffix;
      std::replace(label.begin(), label.end(), '-', '_');
      found.push_back({label, &row, by_steps});
    };
    for (const MethodInfo& row : named_methods()) {
      if (row.steps != Steps::adaptive) add(row, row.fixed_step() ? "" : "_by_steps", true);
      if (row.steps != Steps::fixed) add(row, "", false);
    }
    for (const MethodInfo& row : peers::peer_methods()) add(row, "", false);
    return found;
  }();
  return all;
}

/// The labels of the integrators for which @p belongs is true.
template <class Belongs>
std::vector<std::string> integrators_that(const Belongs& belongs) {
  std::vector<std::string> labels;
  for (const Integrator& integrator : all_integrators())
    if (belongs(integrator)) labels.push_back(integrator.label);
  return labels;
}

/// Bound on the error of Duffing's oscillator over four periods, in tolerances. A tolerance bounds the error
/// of one step; the errors of all steps are propagated and add up. Formulas of low order take many steps, and
/// multistep formulas underestimate their errors. Measured multiples were at most a third of these.
inline double multiple_of_tolerance(std::string_view method) {
  static const std::map<std::string_view, double> multiples = {{"ode45", 40},
                                                               {"dop853", 25},
                                                               {"rkn1210", 5},
                                                               {"series", 25},
                                                               {"adaptive-collocation", 1},
                                                               {"laier", 2200},
                                                               {"argyris", 1600},
                                                               {"hoff", 40000},
                                                               {"bazzi", 40000},
                                                               {"cvode-adams", 600},
                                                               {"cvode-bdf", 5000},
                                                               {"arkode-erk", 25},
                                                               {"arkode-dirk", 12},
                                                               {"gsl-rkf45", 350},
                                                               {"gsl-rk8pd", 50},
                                                               {"gsl-bsimp", 300},
                                                               {"gsl-msadams", 1500},
                                                               {"gsl-msbdf", 45000},
                                                               {"odeint-dopri5", 120},
                                                               {"odeint-fehlberg78", 150},
                                                               {"odeint-bulirsch-stoer", 400},
                                                               {"odeint-rosenbrock4", 35}};
  return multiples.at(method);
}

/// Each test runs for one integrator. Peers that this build lacks are skipped. Nothing may be printed to
/// standard error.
class EveryIntegrator : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!row().is_available()) GTEST_SKIP() << row().absent_sentence();
    ::testing::internal::CaptureStderr();
    captures_ = true;
  }
  void TearDown() override {
    if (captures_) {
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    }
  }

  [[nodiscard]] static const Integrator& integrator() {
    return *std::ranges::find(all_integrators(), GetParam(), &Integrator::label);
  }
  [[nodiscard]] static const MethodInfo& row() { return *integrator().row; }
  [[nodiscard]] static bool by_steps() { return integrator().by_steps; }

  /// Gaussian bases reproduce neither constants nor parabolas; their matrix amplifies rounding errors by
  /// `condition`.
  [[nodiscard]] static bool gaussians() { return by_steps() && row().has(shape_setting); }
  static constexpr double condition = 1e6;

  /// Hermitian operators with adaptive steps.
  [[nodiscard]] static bool hermitian() {
    return !by_steps() && row().second_order_only && row().steps == Steps::both;
  }

  static constexpr double default_step = 0.01, default_tolerance = 1e-9;

  /// The integrator with a step size or a tolerance. Gaussians get a fixed shape parameter: with the default,
  /// which follows the step size, they do not converge.
  [[nodiscard]] static NamedIntegrator with(double step_or_tolerance) {
    Settings settings;
    (by_steps() ? settings.step : settings.tolerance) = step_or_tolerance;
    if (gaussians()) settings.shape = 0.367 / step_or_tolerance;
    return row().with(settings);
  }
  /// Integrates with the usual step size or tolerance.
  static Solution run(const System& system, const State& x0, double t0, double t1,
                      const Observer& observer = {},
                      const Limits& limits = {.steps = 1'000'000, .seconds = 20}) {
    return with(by_steps() ? default_step : default_tolerance)(system, x0, t0, t1, observer, limits);
  }
  /// Largest error of such an integration where nothing grows: that of forward Euler on a cosine is 0.005 a
  /// unit of time.
  [[nodiscard]] static double most_off() {
    return by_steps() ? 0.03 : multiple_of_tolerance(row().name) * default_tolerance;
  }

  /// Expects that a failure names the method and the time, and returns the last finite state.
  static void expect_failure(const Solution& solution, Outcome outcome) {
    EXPECT_EQ(solution.status.outcome(), outcome) << solution.status.text();
    expect_failure(solution);
  }
  static void expect_failure(const Solution& solution) {
    const std::string& sentence = solution.status.sentence();
    EXPECT_FALSE(solution.status.ok());
    EXPECT_TRUE(solution.x.allFinite()) << sentence;
    EXPECT_TRUE(std::isfinite(solution.t));
    EXPECT_TRUE(sentence.starts_with(std::string(row().name) + ":")) << sentence;
    EXPECT_NE(sentence.find("t = "), std::string::npos) << sentence;
  }

 private:
  bool captures_ = false;
};

inline std::string label_of(const ::testing::TestParamInfo<std::string>& info) { return info.param; }

}  // namespace nlmech::ivp::testing
