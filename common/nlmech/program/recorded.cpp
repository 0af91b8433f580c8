#include "nlmech/program/recorded.hpp"

#include <stdexcept>

#include "nlmech/program/expansion_errors.hpp"

namespace nlmech {

void throw_unannounced_branch(bool timed) {
  if (timed)
    throw std::invalid_argument(
        "series: the right-hand side branches on time, but its discontinuities are not declared; give the "
        "problem a member discontinuities(t0, t1)");
  throw std::invalid_argument(
      "series: the right-hand side branches on the state, so that one power series cannot hold for a whole "
      "step; integrate by another method, or split the problem where it branches");
}

namespace program {

double Recorder::branch_value(NodeId node) const {
  const std::vector<bool> part = parts_of(graph_, {node});
  std::vector<double> value(part.size());
  bool timed = true;
  for (NodeId i = 0; i < graph_.nodes(); ++i) {
    if (!part[index(i)]) continue;
    const Node& n = graph_[i];
    const bool is_time = i == Graph::time();
    timed = timed && (is_time || n.operation != Operation::variable);
    value[index(i)] = is_time ? t_ : evaluate(n, value[index(n.a)], value[index(n.b)]);
  }
  if (!timed || !announced_) throw_unannounced_branch(timed);
  return value[index(node)];
}

template <class Note>
Recorded Recorded::noted(Note note, const Recorded& a, const Recorded& b) {
  Recorder* const recorder = a.recorder_ != nullptr ? a.recorder_ : b.recorder_;
  Graph numbers(0);
  Graph& graph = recorder != nullptr ? recorder->graph() : numbers;
  const NodeId id = note(graph, a.node(graph), b.node(graph));
  if (graph.is_number(id)) return graph[id].c;
  return {*recorder, id};
}

Recorded Recorded::made(NodeId (Graph::*operation)(NodeId, NodeId), const Recorded& a, const Recorded& b) {
  return noted([&](Graph& graph, NodeId x, NodeId y) { return (graph.*operation)(x, y); }, a, b);
}

Recorded Recorded::call(Function function, const Recorded& a, const Recorded& b) {
  return noted([&](Graph& graph, NodeId x, NodeId y) { return graph.call(function, x, y); }, a, b);
}

}  // namespace program
}  // namespace nlmech
