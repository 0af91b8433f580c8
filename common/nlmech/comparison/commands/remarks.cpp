#include "nlmech/comparison/commands/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/program/switches.hpp"
#include "nlmech/program/time_features.hpp"

namespace nlmech::comparison {
namespace {

/// "a and 3 more times".
std::string first_of(const std::string& first, std::size_t count) {
  if (count == 1) return first;
  return fmt::format("{} and {} more time{}", first, count - 1, count == 2 ? "" : "s");
}

std::string remark_on_pulses(const UserProblem& problem, double t0, double t1) {
  constexpr double narrow = 0.1;  // share of the run
  const program::TimeFeatures features(problem.text.graph(), problem.text.slopes());
  const auto all = features.short_activities(t0, t1, narrow * (t1 - t0));
  if (all.empty()) return {};
  return fmt::format("a function of time changes after a constant interval, within t = {}: steps start there",
                     first_of(fmt::format("{:.6g} to {:.6g}", all.front().t0, all.front().t1), all.size()));
}

std::string remark_on_jumps(const UserProblem& problem, double t0, double t1) {
  const std::vector<double> times =
      program::Switches(problem.text.graph(), problem.text.slopes()).times(t0, t1);
  if (times.empty()) return {};
  return fmt::format("the equations change at t = {}: steps end there",
                     first_of(fmt::format("{:.6g}", times.front()), times.size()));
}

/// Do solutions on both sides of a switching surface on which the start is leave it, as x' = sign(x) from 0?
/// At an integer floor has the value of the upper side, on which a solution may also stay: x' = floor(x) from
/// 0.
bool leaves_both_sides(const ivp::System& system, const RunOptions& r) {
  const ivp::Cells cells = ivp::cells_at(system, r.t0, r.x0);
  const ivp::Mode& mode = cells.mode;
  const std::vector<double>& values = cells.values;
  std::vector<double> any(values.size()), rates(values.size());
  const double direction = r.t1 > r.t0 ? 1 : -1;
  for (std::size_t i = 0; i < mode.size(); ++i) {
    const bool is_rounded = system.is_rounded(static_cast<int>(i));
    if (!ivp::is_on_surface(is_rounded, values[i])) continue;
    const auto rate_in = [&](int cell) {
      ivp::Mode there = mode;
      there[i] = cell;
      system.in_mode(there).surfaces(r.t0, r.x0, any, rates);
      return direction * rates[i];
    };
    const double above = rate_in(mode[i]), below = rate_in(mode[i] - 2);
    if ((is_rounded ? above >= 0 : above > 0) && below < 0) return true;
  }
  return false;
}

std::string remark_on_start(const UserProblem& problem, const RunOptions& r) {
  if (r.t0 == r.t1) return {};
  if (leaves_both_sides(problem.system, r))
    return fmt::format(
        "the solution from t = {:.6g} is not unique: it may go to either side of a switching surface; this "
        "run takes the side where the switching function is greater",
        r.t0);
  if (problem.domain && ivp::several_begin(*problem.domain, r.t0, r.x0, r.t1 > r.t0 ? 1 : -1))
    return fmt::format(
        "the solution from t = {:.6g} is not unique: the argument of a root is zero there and may stay zero "
        "or not; this run takes the solution for which it stays zero",
        r.t0);
  return {};
}

}  // namespace

std::vector<std::string> remarks_on(const UserProblem& problem, const RunOptions& r) {
  std::vector<std::string> all;
  const auto [first, last] = std::minmax(r.t0, r.t1);
  for (const std::string& remark : {remark_on_start(problem, r), remark_on_pulses(problem, first, last),
                                    remark_on_jumps(problem, first, last)}) {
    if (!remark.empty()) all.push_back(remark);
  }
  return all;
}

std::string Wave::text() const {
  return fmt::format("a force of frequency {:.6g} goes through {:.2g} periods", frequency, turns);
}

Wave fastest_wave(const UserProblem& problem, double t0, double t1) {
  const program::Graph& graph = problem.text.graph();
  const std::vector<bool> part = program::parts_of(graph, problem.text.slopes());
  Wave fastest;
  for (program::NodeId i = 0; i < graph.nodes(); ++i) {
    const program::Node& n = graph[i];
    const bool is_wave = n.operation == program::Operation::function &&
                         (n.function == program::Function::sin || n.function == program::Function::cos);
    if (!part[program::index(i)] || !is_wave) continue;
    const double frequency = std::abs(graph.drift(n.a));
    if (frequency > fastest.frequency) fastest.frequency = frequency;  // false for NaN
  }
  fastest.turns = fastest.frequency * std::abs(t1 - t0) / (2 * std::numbers::pi);
  return fastest;
}

}  // namespace nlmech::comparison
