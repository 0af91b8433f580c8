#include "nlmech/program/variational.hpp"

#include "nlmech/program/partials.hpp"

namespace nlmech::program {

std::vector<NodeId> VariationalLayout::variables() const {
  std::vector<NodeId> all = {Graph::time()};
  for (int i = 0; i < size; ++i) all.push_back(Graph::state(place(i)));
  return all;
}

namespace {

/// Derivatives of nodes along columns. A node that depends on the state by one other node alone, its source,
/// has the source's derivative times a factor that all columns share: 1/r^3 has that of r^2.
class AlongColumns {
 public:
  AlongColumns(Graph& graph, const std::vector<NodeId>& ids) : graph_(graph), needed_(parts_of(graph, ids)) {
    source_.assign(needed_.size(), constant);
    factor_.assign(needed_.size(), graph.number(0));
    for (NodeId i = 1; i < static_cast<NodeId>(needed_.size()); ++i) {
      if (needed_[index(i)] && !graph.is_number(i)) find_source(i);
    }
  }
  std::vector<NodeId> of(const std::vector<NodeId>& ids, const VariationalLayout& layout, int column) {
    known_.assign(needed_.size(), graph_.number(0));
    for (int i = 0; i < layout.size; ++i) {
      const std::size_t place = index(Graph::state(layout.place(i)));
      if (place < known_.size()) known_[place] = Graph::state(layout.place(i, column));
    }
    for (NodeId i = graph_.size() + 1; i < static_cast<NodeId>(needed_.size()); ++i) {
      if (source_[index(i)] != i) continue;
      const Node n = graph_[i];
      known_[index(i)] = derivative_of(graph_, i, derivative(n.a), derivative(n.b));
    }
    std::vector<NodeId> all;
    for (const NodeId id : ids) all.push_back(derivative(id));
    return all;
  }

 private:
  static constexpr NodeId constant = -1;

  void find_source(NodeId i) {
    const Node n = graph_[i];
    NodeId source = i;
    if (n.operation != Operation::variable) {
      const NodeId a = source_[index(n.a)], b = has_two_operands(n.operation) ? source_[index(n.b)] : a;
      if (a == b || b == constant) source = a;
      if (a == constant) source = b;
    }
    source_[index(i)] = source;
    if (source == i)
      factor_[index(i)] = graph_.number(1);
    else if (source != constant)
      factor_[index(i)] = derivative_of(graph_, i, factor_[index(n.a)], factor_[index(n.b)]);
  }
  // Along the present column.
  NodeId derivative(NodeId i) {
    const NodeId source = source_[index(i)];
    return source == constant ? graph_.number(0) : graph_.product(factor_[index(i)], known_[index(source)]);
  }

  Graph& graph_;
  std::vector<bool> needed_;
  std::vector<NodeId> source_, factor_, known_;
};

}  // namespace

std::vector<std::vector<NodeId>> along_columns(Graph& graph, const std::vector<NodeId>& ids,
                                               const VariationalLayout& layout) {
  AlongColumns derivatives(graph, ids);
  std::vector<std::vector<NodeId>> all;
  for (int k = 1; k <= layout.columns; ++k) all.push_back(derivatives.of(ids, layout, k));
  return all;
}

VariationalEquations variational_equations(const Graph& graph, const std::vector<NodeId>& slopes,
                                           const VariationalLayout& layout,
                                           const std::vector<std::vector<NodeId>>& forcing) {
  VariationalEquations made{Graph(layout.all()), std::vector<NodeId>(index(layout.all()))};
  const std::vector<NodeId> variables = layout.variables(),
                            f = substituted(graph, slopes, made.graph, variables);
  const std::vector<std::vector<NodeId>> along = along_columns(made.graph, f, layout);
  for (int k = 0; k <= layout.columns; ++k) {
    std::vector<NodeId> column = k == 0 ? f : along[index(k - 1)];
    if (k > 0 && !forcing.empty()) {
      const std::vector<NodeId> q = substituted(graph, forcing[index(k - 1)], made.graph, variables);
      for (std::size_t i = 0; i < q.size(); ++i) column[i] = made.graph.sum(column[i], q[i]);
    }
    for (int i = 0; i < layout.size; ++i) made.slopes[index(layout.place(i, k))] = column[index(i)];
  }
  return made;
}

}  // namespace nlmech::program
