#include "chapters/integrators/sensitivity_cases.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/ivp/sensitivities.hpp"
#include "nlmech/peers/ivp/sundials/cvodes.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::integrators {
namespace {

using Names = std::vector<std::string>;

program::Equations equations_of(const std::string& name, const program::Settings& settings) {
  const auto texts = problems::problem_texts();
  const auto known = std::ranges::find(texts, name, &problems::ProblemText::name);
  return program::Equations({name, std::string(known->text)}, settings);
}

comparison::Example extended(const SensitivityCase& c, double end) {
  program::Equations all = c.plain.with_sensitivities("sensitivities", c.of);
  const std::vector<double> x0 = all.initial_state("initial state", "");
  return comparison::example_of(program::Problem(all), c.name,
                                Eigen::Map<const Eigen::VectorXd>(x0.data(), std::ssize(x0)), 0, end);
}

/// The end of a step, without dense output.
class EndOnly final : public ivp::DenseOutput {
 public:
  explicit EndOnly(const ivp::State& x) : x_(x) {}
  void at(double /*t*/, ivp::State& x) const override { x = x_; }

 private:
  const ivp::State& x_;
};
void show(const ivp::Observer& observer, double t, const ivp::State& x) {
  observer({1, t, t, x, x, {}, x, EndOnly(x)});
}

ivp::NamedIntegrator by_cvodes(const SensitivityCase& c, const peers::Cvode& method) {
  return [&c, method](const ivp::System& all, const ivp::State& x0, double t0, double t1,
                      const ivp::Observer& observer, const ivp::Limits& /*limits*/) {
    std::function<void(double, const ivp::State&)> observe;
    if (observer) observe = [&observer](double t, const ivp::State& x) { show(observer, t, x); };
    return peers::integrate_by_cvodes(method, c.system, all, c.sizes, x0, t0, t1, observe);
  };
}

/// Two problems that differ in one initial value or parameter.
struct Pair {
  problems::TextProblem problem[2];
  ivp::System system[2] = {ivp::System(problem[0]), ivp::System(problem[1])};
  ivp::State x0[2] = {problem[0].initial_state(), problem[1].initial_state()};
};

std::vector<Pair> pairs_of(const SensitivityCase& c, double change) {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < c.of.size(); ++k) {
    const Names components = c.plain.state_names();
    const auto component = std::ranges::find(components, c.of[k]) - components.begin();
    program::Settings settings[2] = {c.settings, c.settings};
    if (component == std::ssize(components)) {
      const double value = problems::TextProblem(c.name, c.settings).parameter(c.of[k]);
      for (const int side : {0, 1})
        settings[side][c.of[k]] = value + (side == 0 ? 1 : -1) * change * c.sizes[k];
    }
    Pair pair{{problems::TextProblem(c.name, settings[0]), problems::TextProblem(c.name, settings[1])}};
    if (component < std::ssize(components))
      pair.x0[0][component] += change * c.sizes[k], pair.x0[1][component] -= change * c.sizes[k];
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// @param change of a datum, in its size
ivp::NamedIntegrator by_differences(const SensitivityCase& c, const ivp::NamedIntegrator& run,
                                    double change) {
  return [&c, run, change, pairs = pairs_of(c, change)](const ivp::System& all, const ivp::State& x0,
                                                        double t0, double t1, const ivp::Observer& observer,
                                                        const ivp::Limits& limits) {
    const program::VariationalLayout layout = all.layout();
    ivp::Solution end{t1, x0, {}, {}};
    const int ends = observer ? 16 : 1;
    for (int k = ends - 1; k >= 0 && end.status.ok(); --k) {
      const double t = t1 - (t1 - t0) / 10 * k / 15;
      end.statistics = {};
      for (int column = 1; column <= layout.columns; ++column) {
        const Pair& pair = pairs[static_cast<std::size_t>(column - 1)];
        const ivp::Solution plus = run(pair.system[0], pair.x0[0], t0, t, {}, limits),
                            minus = run(pair.system[1], pair.x0[1], t0, t, {}, limits);
        end.statistics += plus.statistics + minus.statistics;
        if (!plus.status.ok() || !minus.status.ok()) {
          end.status = plus.status.ok() ? minus.status : plus.status;
          return end;
        }
        for (int i = 0; i < layout.size; ++i) {
          end.x[layout.place(i)] = (plus.x[i] + minus.x[i]) / 2;
          end.x[layout.place(i, column)] =
              (plus.x[i] - minus.x[i]) / (2 * change * c.sizes[static_cast<std::size_t>(column - 1)]);
        }
      }
      if (observer) show(observer, t, end.x);
    }
    return end;
  };
}

/// With the best change of the cube root of the tolerance times 1e-4, 1e-3, ..., 1.
ivp::NamedIntegrator by_best_differences(const SensitivityCase& c, const ivp::Settings& settings) {
  const auto run = ivp::named_integrator(c.stiff ? "adaptive-collocation" : "dop853", settings);
  ivp::NamedIntegrator best;
  double least = HUGE_VAL;
  for (const double factor : {1e-4, 1e-3, 1e-2, 1e-1, 1.}) {
    ivp::NamedIntegrator found = by_differences(c, run, std::cbrt(*settings.tolerance) * factor);
    const double error = comparison::accuracy_of(c.example, found, {}).error.value_or(HUGE_VAL);
    if (best && !(error < least)) break;
    least = error;
    best = std::move(found);
  }
  return best;
}

}  // namespace

SensitivityCase::SensitivityCase(std::string called, program::Settings values, Names by, double end,
                                 bool is_stiff, double smallest)
    : name(std::move(called)),
      settings(std::move(values)),
      of(std::move(by)),
      stiff(is_stiff),
      absolute(smallest),
      plain(equations_of(name, settings)),
      system(program::Problem(plain)),
      scaled(program::Problem(plain.with_sensitivities("sensitivities", of, ivp::unseen_scale))),
      example(extended(*this, end)) {
  for (const std::string& column : of) {
    const auto known = std::ranges::find(plain.parameters(), column, &std::pair<std::string, double>::first);
    sizes.push_back(known == plain.parameters().end() ? 1 : std::abs(known->second));
  }
}

Names SensitivityCase::methods() const {
  Names names = stiff ? Names{"adaptive-collocation"} : Names{"series", "dop853", "adaptive-collocation"};
  if (peers::cvode_available() && !stiff) names.emplace_back("cvodes-adams");
  if (peers::cvode_available()) names.emplace_back("cvodes-bdf");
  names.emplace_back("differences");
  return names;
}

ivp::NamedIntegrator SensitivityCase::method(const std::string& called, double tolerance) const {
  const ivp::Settings setting{.tolerance = tolerance, .absolute_tolerance = tolerance * absolute};
  if (called == "differences") return by_best_differences(*this, setting);
  if (!called.starts_with("cvodes"))
    return ivp::controlled_by_solution(ivp::named_integrator(called, setting), scaled);
  const auto formula = called == "cvodes-adams" ? peers::Cvode::Formula::adams : peers::Cvode::Formula::bdf;
  return by_cvodes(*this, {formula, tolerance, tolerance * absolute});
}

std::vector<SensitivityCase> sensitivity_cases(bool stiff) {
  using Set = program::Settings;
  std::vector<SensitivityCase> cases;
  cases.reserve(3);  // methods refer to their case
  if (stiff) {
    cases.emplace_back("van-der-pol", Set{{"mu", 100}}, Names{"x", "mu"}, 160, true, 1e-3);
    cases.emplace_back("robertson", Set{}, Names{"k1", "k2", "k3"}, 40, true, 1e-6);
  } else {
    cases.emplace_back("duffing", Set{}, Names{"x", "x'", "hardening"}, 50);
    cases.emplace_back("lorenz", Set{}, Names{"u", "v", "w", "r"}, 5);
    cases.emplace_back("arenstorf", Set{}, Names{"x", "y", "x'", "y'"}, 10);
  }
  return cases;
}

}  // namespace nlmech::chapters::integrators
