#include "nlmech/program/linear_terms.hpp"

#include <cmath>
#include <map>
#include <optional>

namespace nlmech::program {
namespace {

/// w t + p
struct Phase {
  double w, p;
};

class Collector {
 public:
  explicit Collector(const Graph& graph) : graph_(graph) {
    for (NodeId id = 0; id < graph.nodes(); ++id) numbers_.push_back(number_in(graph[id]));
  }

  // From the slope down to its parts, each once: a part that stands in several places has the sum of factors.
  void row(int i, NodeId slope) {
    row_ = i;
    factors_ = {{slope, 1}};
    while (!factors_.empty()) {
      const auto [id, factor] = *factors_.rbegin();
      factors_.erase(id);
      expand(graph_[id], factor);
    }
    if (const double c = numbers_[index(slope)]; c != 0) terms.load.push_back({i, 0, c, 0});
  }

  LinearTerms terms;

 private:
  void expand(const Node& node, double factor) {
    switch (node.operation) {
      case Operation::variable:
        if (node.a > 0) terms.terms.push_back({row_, node.a - 1, factor});
        return;
      case Operation::sum: return add(node.a, factor), add(node.b, factor);
      case Operation::difference: return add(node.a, factor), add(node.b, -factor);
      case Operation::shifted: return add(node.a, factor);
      case Operation::scaled: return add(node.a, factor * node.c);
      case Operation::divided: return add(node.a, factor / node.c);
      case Operation::product:
        return add(node.b, factor * numbers_[index(node.a)]), add(node.a, factor * numbers_[index(node.b)]);
      case Operation::function: return harmonic(node, factor);
      default: return;
    }
  }
  void add(NodeId id, double factor) {
    if (factor != 0) factors_[id] += factor;
  }

  void harmonic(const Node& node, double factor) {
    if (node.function != Function::cos && node.function != Function::sin) return;
    const std::optional<Phase> phase = phase_of(node.a);
    if (!phase) return;
    const double c = factor * std::cos(phase->p), s = factor * std::sin(phase->p);
    terms.load.push_back(node.function == Function::cos ? Harmonic{row_, phase->w, c, -s}
                                                        : Harmonic{row_, phase->w, s, c});
  }
  [[nodiscard]] std::optional<Phase> phase_of(NodeId id) const {
    const Node& node = graph_[id];
    if (node.operation == Operation::variable && node.a == 0) return Phase{1, 0};
    const bool goes_on = node.operation == Operation::shifted || node.operation == Operation::scaled ||
                         node.operation == Operation::divided;
    const std::optional<Phase> inner = goes_on ? phase_of(node.a) : std::nullopt;
    if (!inner) return {};
    if (node.operation == Operation::shifted) return Phase{inner->w, inner->p + node.c};
    if (node.operation == Operation::scaled) return Phase{node.c * inner->w, node.c * inner->p};
    return Phase{inner->w / node.c, inner->p / node.c};
  }

  // The term of the expanded expression that is a number.
  [[nodiscard]] double number_in(const Node& node) const {
    const auto of = [this](NodeId id) { return numbers_[index(id)]; };
    switch (node.operation) {
      case Operation::number: return node.c;
      case Operation::sum: return of(node.a) + of(node.b);
      case Operation::difference: return of(node.a) - of(node.b);
      case Operation::shifted: return of(node.a) + node.c;
      case Operation::scaled: return node.c * of(node.a);
      case Operation::divided: return of(node.a) / node.c;
      case Operation::product: return of(node.a) * of(node.b);
      default: return 0;
    }
  }

  const Graph& graph_;
  std::vector<double> numbers_;
  std::map<NodeId, double> factors_;  ///< of what is still to be expanded
  int row_ = 0;
};

}  // namespace

LinearTerms linear_terms(const Graph& graph, const std::vector<NodeId>& slopes) {
  Collector collector(graph);
  for (std::size_t i = 0; i < slopes.size(); ++i) collector.row(static_cast<int>(i), slopes[i]);
  return collector.terms;
}

}  // namespace nlmech::program
