#include "nlmech/comparison/commands/problem_of_size.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "nlmech/comparison/commands/look_out.hpp"
#include "nlmech/comparison/comparison_table.hpp"
#include "nlmech/comparison/judgement.hpp"
#include "nlmech/comparison/reference/reference_methods.hpp"
#include "nlmech/comparison/reference/verification.hpp"
#include "nlmech/comparison/rows.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

/// One run, repeated if it is short: its solution, and the median time without the first, which warms up.
/// @param enough seconds after which it is not repeated
template <int n>
std::pair<ivp::Solution<n>, double> timed(const std::function<ivp::Solution<n>()>& work, double enough) {
  constexpr int repeats = 5;
  const Stopwatch watch;
  const ivp::Solution<n> first = work();
  std::vector<double> seconds = {first.statistics.seconds};
  while (static_cast<int>(seconds.size()) <= repeats && watch.seconds() + seconds.back() < enough)
    seconds.push_back(work().statistics.seconds);
  if (seconds.size() > 1) seconds.erase(seconds.begin());
  return {first, median(seconds)};
}

template <int m>
ivp::State<m> begin(const Request& r) {
  return Eigen::Map<const ivp::State<m>>(r.x0.data(), static_cast<Eigen::Index>(r.x0.size()));
}

}  // namespace

template <int m>
Reference ProblemOfSize<m>::reference(const ivp::State<m>& x0, double t0, const std::vector<double>& times,
                                      const Needed& needed, const Effort& effort) const {
  std::vector<Candidate> all = extended(effort);
  for (Candidate& c : method_candidates<m>(system(), needed, effort)) all.push_back(std::move(c));
  return agree(all, {x0.template cast<long double>(), t0, times}, needed, effort.seconds);
}

// Where a component decays many times within the way, its decay and not the solution would bound the steps of
// an explicit method.
template <int m>
std::string ProblemOfSize<m>::usual_method(const Request& r) const {
  constexpr double many_decays = 2000;
  const ivp::System<m> system = this->system();
  ivp::Jacobian<m> j(system.size(), system.size());
  system.jacobian(r.t0, begin<m>(r), j);
  if (!j.allFinite()) return "series";
  const Eigen::VectorXcd rates = Eigen::MatrixXd(j).eigenvalues();
  const double fastest = (r.t1 > r.t0 ? -1 : 1) * rates.real().minCoeff();
  return fastest * std::abs(r.t1 - r.t0) > many_decays ? "adaptive-collocation" : "series";
}

template <int m>
Trajectory ProblemOfSize<m>::trajectory(const Request& r, const AnyMethod& method) const {
  const Stopwatch watch;
  const auto run = about("--method", [&] { return any_integrator<m>(method, r.settings); });
  const ivp::System<m> system = this->system();
  const ivp::State<m> x0 = begin<m>(r);
  Request way = r;
  Rows rows(way, state_names());
  rows.add(r.t0, x0);
  LookOut<m> events(r, run, system, rows);
  ivp::Observer<m> observer;
  if (r.every || !r.events.empty())
    observer = [&events](const ivp::Step<m>& step) { return events.see(step); };
  ivp::Solution<m> end = about("--method", [&] { return run(system, x0, r.t0, r.t1, observer, r.limits); });
  events.finish(end);
  if (!end.status.ok()) throw Failure(end.status);
  way.t1 = end.t;
  if (!events.ended()) rows.add(end.t, end.x);
  if (events.ended()) rows.keep(end.t, end.x);
  if (!r.verify || r.t0 == r.t1) return {rows.text(), ""};
  const Verified what = rows.verified(tolerance_of(r.settings));
  const scene::Doing doing("verifying the run by integration");
  const Effort effort = effort_after(end.statistics, system.size(), r.limits.seconds - watch.seconds());
  const Reference truth = reference(x0, r.t0, what.times, needed_for(what.tolerance), effort);
  const Verification found = verify<m>(system, x0, r.t0, what, truth, effort);
  return {rows.text(), remark(found, truth, method, r.settings, state_names())};
}

template <int m>
std::string ProblemOfSize<m>::comparison(const Request& r, const std::vector<Choice>& methods,
                                         std::string_view program) const {
  const Stopwatch watch;
  const auto left = [&] { return r.limits.seconds - watch.seconds(); };
  const ivp::System<m> system = this->system();
  const ivp::State<m> x0 = begin<m>(r);
  constexpr double work = 6;  // seconds, or so
  std::optional<scene::Doing> doing("computing a reference");
  const Reference truth = reference(x0, r.t0, look_at(r.t0, r.t1, 64), {.relative = 1e-13, .absolute = 1e-30},
                                    {work, left() / 3});
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

template class ProblemOfSize<1>;
template class ProblemOfSize<2>;
template class ProblemOfSize<3>;
template class ProblemOfSize<4>;
template class ProblemOfSize<6>;
template class ProblemOfSize<Eigen::Dynamic>;

}  // namespace nlmech::comparison
