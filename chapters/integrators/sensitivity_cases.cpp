#include "chapters/integrators/sensitivity_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/sensitivities.hpp"
#include "nlmech/peers/ivp/sundials/cvodes.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::integrators {
namespace {

using Run = SensitivityMethod::Run;

const ivp::Limits enough{.steps = 1'000'000};

program::Equations text_of(const std::string& name, const program::Settings& settings) {
  const auto texts = problems::problem_texts();
  const auto known = std::ranges::find(texts, name, &problems::ProblemText::name);
  return program::Equations({name, std::string(known->text)}, settings);
}

ivp::State initial_state(program::Equations equations) {
  const std::vector<double> x = equations.initial_state("initial state", "");
  return Eigen::Map<const Eigen::VectorXd>(x.data(), std::ssize(x));
}

ivp::Settings settings_of(double tolerance) {
  return {.tolerance = tolerance, .absolute_tolerance = tolerance};
}

SensitivityMethod by_variational_equations(const SensitivityCase& c, const std::string& method) {
  const ivp::System scaled(
      program::Problem(c.equations.with_sensitivities("sensitivities", c.of, ivp::unseen_scale)));
  return {method, [&c, method, scaled](double tolerance) -> Run {
            const auto run =
                ivp::controlled_by_solution(ivp::named_integrator(method, settings_of(tolerance)), scaled);
            return [&c, run](double t1) -> std::optional<ivp::State> {
              const ivp::Solution end = run(c.all, c.x0, 0, t1, {}, enough);
              return end.status.ok() ? std::optional(end.x) : std::nullopt;
            };
          }};
}

SensitivityMethod by_cvodes(const SensitivityCase& c, peers::Cvode::Formula formula) {
  const bool adams = formula == peers::Cvode::Formula::adams;
  return {adams ? "cvodes-adams" : "cvodes-bdf", [&c, formula](double tolerance) -> Run {
            return [&c, method = peers::Cvode{formula, tolerance, tolerance}](
                       double t1) -> std::optional<ivp::State> {
              ivp::State x = c.x0;
              if (!peers::cvodes_natively(method, c.system, c.all, c.sizes, 0, t1, x)) return std::nullopt;
              return x;
            };
          }};
}

/// The change of the central differences for errors of the runs of one tolerance: its cube root.
SensitivityMethod by_differences(const SensitivityCase& c) {
  struct Pair {
    ivp::System system[2];
    ivp::State x0[2];
    double change;
  };
  return {"differences", [&c](double tolerance) -> Run {
            std::vector<Pair> pairs;
            const program::VariationalLayout layout = c.extended.layout();
            for (std::size_t k = 0; k < c.of.size(); ++k) {
              Pair pair{
                  {c.system, c.system}, {initial_state(c.equations), {}}, std::cbrt(tolerance) * c.sizes[k]};
              pair.x0[1] = pair.x0[0];
              const std::vector<std::string> components = c.equations.state_names();
              const auto component = std::ranges::find(components, c.of[k]) - components.begin();
              for (const int side : {0, 1}) {
                const double change = side == 0 ? pair.change : -pair.change;
                if (component < layout.size) {
                  pair.x0[side][component] += change;
                } else {
                  const auto value = std::ranges::find(c.equations.parameters(), c.of[k],
                                                       &std::pair<std::string, double>::first);
                  pair.system[side] =
                      ivp::System(program::Problem(text_of(c.name, {{c.of[k], value->second + change}})));
                }
              }
              pairs.push_back(std::move(pair));
            }
            return [&c, pairs, layout, run = ivp::named_integrator("dop853", settings_of(tolerance))](
                       double t1) -> std::optional<ivp::State> {
              ivp::State all = c.x0;
              for (int k = 1; k <= layout.columns; ++k) {
                const Pair& pair = pairs[static_cast<std::size_t>(k - 1)];
                const ivp::Solution plus = run(pair.system[0], pair.x0[0], 0, t1, {}, enough),
                                    minus = run(pair.system[1], pair.x0[1], 0, t1, {}, enough);
                if (!plus.status.ok() || !minus.status.ok()) return std::nullopt;
                for (int i = 0; i < layout.size; ++i)
                  all[layout.place(i, k)] = (plus.x[i] - minus.x[i]) / (2 * pair.change);
              }
              return all;
            };
          }};
}

}  // namespace

SensitivityCase::SensitivityCase(std::string called, std::vector<std::string> by, double t1)
    : name(std::move(called)),
      of(std::move(by)),
      end(t1),
      equations(text_of(name, {})),
      extended(equations.with_sensitivities("sensitivities", of)),
      system(program::Problem(equations)),
      all(program::Problem(extended)),
      x0(initial_state(extended)) {
  for (const std::string& column : of) {
    const auto known =
        std::ranges::find(equations.parameters(), column, &std::pair<std::string, double>::first);
    sizes.push_back(known == equations.parameters().end() ? 1 : std::abs(known->second));
  }
  using Path = problems::ReferenceTrajectory<long double, program::Problem>;
  const Vector<long double, Eigen::Dynamic> start = x0.cast<long double>();
  const Path path(program::Problem(extended), start, 0, end);
  if (!path.status().ok()) throw Failure(path.status());
  for (int k = 0; k < times; ++k) exact.emplace_back(path(time(k)).template cast<double>());
}

double SensitivityCase::error(const ivp::State& x, int k) const {
  const program::VariationalLayout& layout = extended.layout();
  const ivp::State& reference = exact[static_cast<std::size_t>(k)];
  double worst = 0;
  for (int column = 1; column <= layout.columns; ++column) {
    double difference = 0, size = 0;
    for (int i = 0; i < layout.size; ++i) {
      const int place = layout.place(i, column);
      difference = std::max(difference, std::abs(x[place] - reference[place]));
      size = std::max(size, std::abs(reference[place]));
    }
    worst = std::max(worst, difference / size);
  }
  return worst;
}

std::optional<double> SensitivityCase::error(const Run& run) const {
  std::vector<double> errors;
  for (int k = 0; k < times; ++k) {
    const std::optional<ivp::State> x = run(time(k));
    if (!x) return std::nullopt;
    errors.push_back(error(*x, k));
  }
  return median(errors);
}

std::vector<SensitivityMethod> SensitivityCase::methods() const {
  std::vector<SensitivityMethod> methods;
  for (const char* const method : {"series", "dop853", "adaptive-collocation"})
    methods.push_back(by_variational_equations(*this, method));
  if (peers::cvodes_available()) {
    methods.push_back(by_cvodes(*this, peers::Cvode::Formula::adams));
    methods.push_back(by_cvodes(*this, peers::Cvode::Formula::bdf));
  }
  methods.push_back(by_differences(*this));
  return methods;
}

std::vector<SensitivityCase> sensitivity_cases() {
  std::vector<SensitivityCase> cases;
  using Names = std::vector<std::string>;
  cases.emplace_back("duffing", Names{"x", "x'", "hardening"}, 50);
  cases.emplace_back("lorenz", Names{"u", "v", "w", "r"}, 5);
  cases.emplace_back("arenstorf", Names{"x", "y", "x'", "y'"}, 10);
  return cases;
}

}  // namespace nlmech::chapters::integrators
