#include "nlmech/ivp/domain.hpp"

#include <algorithm>
#include <utility>

#include "nlmech/ivp/near_zero.hpp"
#include "nlmech/program/domain.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::ivp {

using program::Interval;

Event event_of(program::Graph graph, program::NodeId node, const std::vector<program::NodeId>& slopes) {
  const std::vector<program::NodeId> jumps = program::jumps_of(graph, node);
  std::vector<program::NodeId> of_rate = {program::rates(graph, {node}, slopes).front()};
  of_rate.insert(of_rate.end(), jumps.begin(), jumps.end());
  const auto program = std::make_shared<const program::Program>(graph, std::vector{node});
  const auto rate = std::make_shared<const program::Program>(graph, of_rate);
  Event event;
  event.value = [program](double t, const State& x) {
    double value = 0;
    program->run(t, x, 0, 1, [&value](int, double v) { value = v; });
    return value;
  };
  event.bounds = [program](const Interval& t, std::span<const Interval> x) {
    Interval value;
    program->run(t, x, 0, 1, [&value](int, const Interval& v) { value = v; });
    return value;
  };
  event.rate_bounds = [rate](const Interval& t, std::span<const Interval> x) {
    Interval bounds;
    rate->run(t, x, 0, rate->outputs(), [&bounds](int i, const Interval& v) {
      if (i == 0)
        bounds = v;
      else if (v.has(0))
        bounds = {};  // a jump has no bound on its rate
    });
    return bounds;
  };
  event.slopes = [all = std::make_shared<const program::Program>(graph, slopes)](
                     const Interval& t, std::span<const Interval> x, std::span<Interval> bounds) {
    all->run(t, x, 0, bounds.size(),
             [&bounds](int i, const Interval& v) { bounds[static_cast<std::size_t>(i)] = v; });
  };
  return event;
}

Domain::Domain(const program::Equations& equations) {
  const program::Domain domain(equations);
  const std::vector<program::NodeId>& slopes = equations.slopes();
  corners = domain.arguments.size();
  for (const std::vector<program::NodeId>& ids : {domain.arguments, domain.corners}) {
    for (const program::NodeId id : ids) {
      arguments.push_back(event_of(domain.graph, id, slopes));
      beyond_arguments.push_back(event_of(domain.graph, id, domain.beyond));
    }
  }
  const std::vector<Interval> anywhere(static_cast<std::size_t>(equations.size()));
  for (const program::NodeId id : domain.denominators) {
    ends.push_back(event_of(domain.graph, id, slopes));
    constexpr double rounding = 1e-300;  // of bounds that are zero
    if (ends.back().bounds({}, anywhere).low < -rounding)
      crossings.push_back(ends.back());
    else
      sums.push_back(ends.size() - 1);
  }
  for (const program::NodeId id : domain.logarithms) ends.push_back(event_of(domain.graph, id, slopes));
  names = equations.state_names();
  for (const std::vector<program::NodeId>& ids : {domain.denominators, domain.logarithms}) {
    for (const program::NodeId id : ids) {
      const std::vector<bool> part = program::parts_of(domain.graph, {id});
      components.emplace_back();
      for (int k = 0; k < equations.size(); ++k) {
        if (part[program::index(program::Graph::state(k))]) components.back().push_back(k);
      }
    }
  }
  for (const program::NodeId id : domain.timed) timed.push_back(event_of(domain.graph, id, slopes));
  for (const program::NodeId id : domain.timed_arguments)
    timed_arguments.push_back(event_of(domain.graph, id, slopes));
  if (!arguments.empty())
    beyond.emplace(program::Problem(equations).with_slopes(domain.graph, domain.beyond));
}

bool several_begin(const Domain& domain, double t, const State& x, int direction) {
  for (std::size_t i = 0; i < domain.arguments.size(); ++i) {
    const Event& g = domain.arguments[i];
    const double near = 1e-6 * std::max(x.norm(), 1.);
    if (g.value(t, x) != 0) continue;
    const bool may_rest = direction * rate_at(domain.beyond_arguments[i], t, x) <= 0;
    if (i < domain.corners ? may_rest && repels(g, t, x, near, direction)
                           : stays_or_leaves(g, t, x, near, direction))
      return true;
  }
  return false;
}

}  // namespace nlmech::ivp
