#include "nlmech/expression/switches.hpp"

#include <algorithm>

namespace nlmech::expression {
namespace {

std::size_t index(NodeId id) { return static_cast<std::size_t>(id); }

// The nodes that @p id is made of.
std::vector<bool> parts_of(const Graph& graph, const std::vector<NodeId>& ids) {
  std::vector<bool> part(index(graph.nodes()));
  for (const NodeId id : ids) part[index(id)] = true;
  for (NodeId i = graph.nodes() - 1; i > graph.size(); --i) {
    const Node& n = graph[i];
    if (!part[index(i)] || n.operation == Operation::number) continue;
    part[index(n.a)] = true;
    if (has_two_operands(n.operation)) part[index(n.b)] = true;
    if (n.operation == Operation::choice) part[index(n.decides)] = true;
  }
  return part;
}

}  // namespace

Switches::Switches(const Graph& graph, const std::vector<NodeId>& slopes) : graph_(graph), slopes_(slopes) {
  const std::vector<bool> part = parts_of(graph_, slopes_);
  for (NodeId i = 0; i < graph_.nodes(); ++i) {
    if (!part[index(i)] || graph_[i].operation != Operation::choice) continue;
    const NodeId decides = graph_[i].decides;
    if (std::find(deciding_.begin(), deciding_.end(), decides) == deciding_.end())
      deciding_.push_back(decides);
  }
}

// The same expression without choices, for a mode without zeros among the functions that it depends on.
NodeId Switches::resolved(NodeId id, const Mode& mode) const {
  const std::vector<bool> part = parts_of(graph_, {id});
  std::vector<NodeId> made(index(id) + 1);
  for (NodeId i = 0; i <= id; ++i) {
    if (!part[index(i)]) continue;
    const Node n = graph_[i];
    if (i <= graph_.size() || n.operation == Operation::number) {
      made[index(i)] = i;
    } else if (n.operation == Operation::choice) {
      const auto decides = std::find(deciding_.begin(), deciding_.end(), n.decides) - deciding_.begin();
      made[index(i)] = made[index(mode[static_cast<std::size_t>(decides)] < 0 ? n.b : n.a)];
    } else {
      made[index(i)] = graph_.again(n, made[index(n.a)], made[index(n.b)]);
    }
  }
  return made.back();
}

// dg/dt along a solution.
NodeId Switches::rate(NodeId g, const std::vector<NodeId>& slopes) const {
  NodeId sum = derivative(graph_, g, 0);
  for (std::size_t i = 0; i < slopes.size(); ++i)
    sum = graph_.sum(sum, graph_.product(derivative(graph_, g, static_cast<int>(i) + 1), slopes[i]));
  return sum;
}

std::vector<NodeId> Switches::slopes(const Mode& mode) const {
  const auto zero = std::find(mode.begin(), mode.end(), 0);
  if (zero != mode.end()) return sliding(mode, static_cast<std::size_t>(zero - mode.begin()));
  std::vector<NodeId> all;
  for (const NodeId slope : slopes_) all.push_back(resolved(slope, mode));
  return all;
}

std::vector<NodeId> Switches::sliding(const Mode& mode, std::size_t on) const {
  Mode above = mode, below = mode;
  above[on] = 1;
  below[on] = -1;
  const std::vector<NodeId> up = slopes(above), down = slopes(below);
  const NodeId g = resolved(deciding_[on], above), rise = rate(g, up), fall = rate(g, down);
  const NodeId share = graph_.quotient(fall, graph_.difference(fall, rise));  // of the upper side
  std::vector<NodeId> mixed;
  for (std::size_t i = 0; i < up.size(); ++i)
    mixed.push_back(graph_.sum(down[i], graph_.product(share, graph_.difference(up[i], down[i]))));
  return mixed;
}

std::shared_ptr<const Program> Switches::in_mode(const Mode& mode) const {
  const std::scoped_lock lock(mutex_);
  std::shared_ptr<const Program>& program = known_[mode];
  if (!program) {
    std::vector<NodeId> outputs = slopes(mode);
    const std::vector<NodeId> along = outputs;
    std::vector<NodeId> watched, rates;
    for (const NodeId id : deciding_) {
      watched.push_back(resolved(id, mode));
      rates.push_back(rate(watched.back(), along));
    }
    outputs.insert(outputs.end(), watched.begin(), watched.end());
    outputs.insert(outputs.end(), rates.begin(), rates.end());
    program = std::make_shared<const Program>(graph_, outputs);
  }
  return program;
}

}  // namespace nlmech::expression
