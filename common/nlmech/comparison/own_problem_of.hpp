/// @file
/// OwnProblem for a problem of the library. Included where own_problem<Problem>() is instantiated, once a
/// problem: everything that integrates it is compiled there.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/comparison_table.hpp"
#include "nlmech/comparison/own_problem.hpp"
#include "nlmech/comparison/rows.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

/// One run, repeated if it is short: its solution, and the median time without the first, which warms up.
template <int n>
[[nodiscard]] std::pair<ivp::Solution<n>, double> timed(const std::function<ivp::Solution<n>()>& work) {
  constexpr int repeats = 5;
  constexpr double enough = 0.5;  // seconds
  const Stopwatch watch;
  const ivp::Solution<n> first = work();
  std::vector<double> seconds = {first.statistics.seconds};
  while (static_cast<int>(seconds.size()) <= repeats && watch.seconds() < enough)
    seconds.push_back(work().statistics.seconds);
  if (seconds.size() > 1) seconds.erase(seconds.begin());
  return {first, median(seconds)};
}

/// A problem with its parameters.
template <class Problem>
class OwnProblemOf final : public OwnProblem {
 public:
  /// With the parameters as set.
  [[nodiscard]] const Problem& problem() const { return problem_; }
  [[nodiscard]] std::string_view name() const override { return Problem::name; }
  [[nodiscard]] std::vector<std::pair<std::string, double>> parameters() const override {
    std::vector<std::pair<std::string, double>> all;
    for (const auto& parameter : Problem::parameters)
      all.emplace_back(parameter.name, problem_.*(parameter.member));
    return all;
  }
  void set_parameter(std::string_view parameter, double value) override {
    problems::set_parameter(problem_, parameter, value);
  }
  [[nodiscard]] std::vector<std::string> state_names() const override {
    return problems::state_names<Problem>();
  }
  [[nodiscard]] std::vector<double> initial_state() const override {
    const auto x = problem_.initial_state();
    return {x.begin(), x.end()};
  }
  [[nodiscard]] double initial_time() const override { return Problem::initial_time; }

  [[nodiscard]] std::string trajectory(const Request& r, const AnyMethod& method) const override {
    const auto run = about("--method", [&] { return any_integrator<m>(method, r.settings); });
    const ivp::State<m> x0 = begin(r);
    Rows rows(r, state_names());
    rows.add(r.t0, x0);
    ivp::Observer<m> observer;
    if (r.every) {
      observer = [&rows](const ivp::Step<m>& step) {
        rows.add_within(step);
        return true;
      };
    }
    const ivp::Solution<m> end =
        about("--method", [&] { return run(ivp::System<m>(problem_), x0, r.t0, r.t1, observer, r.limits); });
    if (!end.status.ok()) throw Failure(end.status);
    rows.add(end.t, end.x);
    return rows.text();
  }

  [[nodiscard]] std::string comparison(const Request& r, const std::vector<Choice>& methods,
                                       std::string_view program) const override {
    std::vector<ivp::NamedIntegrator<m>> integrators;
    for (const Choice& c : methods)
      integrators.push_back(about("--methods", [&] { return any_integrator<m>(c.method, c.settings); }));
    const ivp::System<m> system(problem_);
    const ivp::State<m> x0 = begin(r);
    const auto truth = reference_end(problem_, Vector<double, n>(x0), r.t0, r.t1);
    ComparisonTable table(program, truth.status);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const std::function<ivp::Solution<m>()> work = [&] {
        return integrators[i](system, x0, r.t0, r.t1, {}, r.limits);
      };
      const auto result = about("--methods", [&] { return timed<m>(work); });
      const ivp::Solution<m>& end = result.first;
      const double error = end.status.ok() && truth.status.ok()
                               ? relative_error<n>(Vector<double, n>(end.x), truth.x, truth.size)
                               : 0;
      table.add(methods[i], end.status, end.statistics, error, result.second);
    }
    return table.text();
  }

 private:
  static constexpr int n = Problem::dimension;
  // Methods are compiled for small dimensions; larger ones go by the dynamic one.
  static constexpr int m = n <= 4 || n == 6 ? n : Eigen::Dynamic;
  static ivp::State<m> begin(const Request& r) {
    return Eigen::Map<const ivp::State<m>>(r.x0.data(), static_cast<Eigen::Index>(r.x0.size()));
  }

  Problem problem_;
};

template <class Problem>
std::unique_ptr<OwnProblem> own_problem() {
  return std::make_unique<OwnProblemOf<Problem>>();
}

}  // namespace nlmech::comparison
