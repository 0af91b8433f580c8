/// @file
/// OwnProblem for a problem of the library. Included where own_problem<Problem>() is instantiated, once a
/// problem: everything that integrates it is compiled there.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/comparison/comparison_table.hpp"
#include "nlmech/comparison/judgement.hpp"
#include "nlmech/comparison/reference/reference_of.hpp"
#include "nlmech/comparison/rows.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

/// One run, repeated if it is short: its solution, and the median time without the first, which warms up.
/// @param enough seconds after which it is not repeated
template <int n>
[[nodiscard]] std::pair<ivp::Solution<n>, double> timed(const std::function<ivp::Solution<n>()>& work,
                                                        double enough) {
  constexpr int repeats = 5;
  const Stopwatch watch;
  const ivp::Solution<n> first = work();
  std::vector<double> seconds = {first.statistics.seconds};
  while (static_cast<int>(seconds.size()) <= repeats && watch.seconds() + seconds.back() < enough)
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

  [[nodiscard]] std::string_view equation() const override { return Problem::equation; }

  [[nodiscard]] Trajectory trajectory(const Request& r, const AnyMethod& method) const override {
    const Stopwatch watch;
    const auto run = about("--method", [&] { return any_integrator<m>(method, r.settings); });
    const ivp::System<m> system(problem_);
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
        about("--method", [&] { return run(system, x0, r.t0, r.t1, observer, r.limits); });
    if (!end.status.ok()) throw Failure(end.status);
    rows.add(end.t, end.x);
    if (!r.verify || r.t0 == r.t1) return {rows.text(), ""};
    const Verified what = rows.verified(tolerance_of(r.settings));
    const scene::Doing doing("verifying the run by integration");
    const Effort effort = effort_after(end.statistics, n, r.limits.seconds - watch.seconds());
    const Reference truth =
        reference_of(problem_, Vector<double, n>(x0), r.t0, what.times, needed_for(what.tolerance), effort);
    const Verification found = verify<m>(system, x0, r.t0, what, truth, effort);
    return {rows.text(), remark(found, truth, method, r.settings, state_names())};
  }

  [[nodiscard]] std::string comparison(const Request& r, const std::vector<Choice>& methods,
                                       std::string_view program) const override {
    const Stopwatch watch;
    const auto left = [&] { return r.limits.seconds - watch.seconds(); };
    const ivp::System<m> system(problem_);
    const ivp::State<m> x0 = begin(r);
    constexpr double work = 6;  // seconds, or so
    std::optional<scene::Doing> doing("computing a reference");
    const Reference truth = reference_of(problem_, Vector<double, n>(x0), r.t0, look_at(r.t0, r.t1, 64),
                                         {.relative = 1e-13, .absolute = 1e-30}, {work, left() / 3});
    ComparisonTable table(program, truth, x0.template cast<double>());
    for (std::size_t i = 0; i < methods.size(); ++i) {
      doing.emplace("running " + methods[i].method.name);
      const double share = left() / static_cast<double>(methods.size() - i);
      try {
        const auto run = any_integrator<m>(methods[i].method, methods[i].settings);
        const std::function<ivp::Solution<m>()> once = [&] {
          return run(system, x0, r.t0, r.t1, {}, {r.limits.steps, share});
        };
        const auto [end, seconds] = timed<m>(once, std::min(0.5, share / 2));
        table.add(methods[i], end.status, end.statistics, Eigen::VectorXd(end.x), seconds);
      } catch (const std::invalid_argument& error) {
        table.add_unsuitable(methods[i], error.what());
      }
    }
    return table.text();
  }

 private:
  static constexpr int n = Problem::dimension;
  // Methods are compiled for small dimensions; larger ones go by the dynamic one.
  static constexpr int m = ivp::compiled_dimension<Problem>;
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
