#include "nlmech/program/program.hpp"

#include <algorithm>

namespace nlmech::program {

/// Selects the instructions of a Program and the places of their results.
class ProgramCompiler {
 public:
  ProgramCompiler(const Graph& graph, const std::vector<NodeId>& outputs, Program& made)
      : graph_(graph),
        outputs_(outputs),
        made_(made),
        last_use_(index(graph.nodes()), never),
        place_(last_use_.size()) {}

  void compile() {
    made_.size_ = index(graph_.size());
    made_.tables_ = graph_.tables();
    made_.places_ = made_.size_ + 1;
    find_uses();
    for (NodeId i = 0; i <= graph_.size(); ++i) place_[index(i)] = static_cast<std::uint32_t>(i);
    for (NodeId i = graph_.size() + 1; i < graph_.nodes(); ++i) {
      if (last_use_[index(i)] != never && !graph_.is_number(i) && !absorbed_[index(i)]) emit(i);
    }
    for (const NodeId id : outputs_) {
      const bool number = graph_.is_number(id);
      made_.outputs_.push_back({number, number ? 0 : place_[index(id)], number ? graph_[id].c : 0});
    }
  }

 private:
  static constexpr NodeId never = -1;
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  template <class Visit>
  void for_operands(NodeId i, Visit visit) const {
    const Node& n = graph_[i];
    if (i <= graph_.size() || n.operation == Operation::number) return;
    visit(n.a);
    if (has_two_operands(n.operation)) visit(n.b);
    if (n.operation == Operation::choice) visit(n.decides);
  }

  // Finds the last node that uses each node; outputs are needed to the end.
  void find_uses() {
    std::vector<int> uses(last_use_.size());
    for (const NodeId id : outputs_) {
      last_use_[index(id)] = graph_.nodes();
      uses[index(id)] += 2;
    }
    for (NodeId i = graph_.nodes() - 1; i > graph_.size(); --i) {
      if (last_use_[index(i)] == never) continue;
      for_operands(i, [&](NodeId operand) {
        last_use_[index(operand)] = std::max(last_use_[index(operand)], i);
        ++uses[index(operand)];
      });
    }
    absorb(uses);
  }

  // Merges a multiple that is used in one sum only into that sum.
  void absorb(const std::vector<int>& uses) {
    absorbed_.assign(last_use_.size(), false);
    for (NodeId i = graph_.size() + 1; i < graph_.nodes(); ++i) {
      const Node& n = graph_[i];
      if (last_use_[index(i)] == never ||
          (n.operation != Operation::sum && n.operation != Operation::difference))
        continue;
      const bool second = can_absorb(n.b, uses),
                 first = n.operation == Operation::sum && can_absorb(n.a, uses);
      if (!second && !first) continue;
      const NodeId part = second ? n.b : n.a, inside = graph_[part].a;
      absorbed_[index(part)] = true;
      last_use_[index(inside)] = std::max(last_use_[index(inside)], i);
    }
  }
  [[nodiscard]] bool can_absorb(NodeId i, const std::vector<int>& uses) const {
    return uses[index(i)] == 1 && graph_[i].operation == Operation::scaled;
  }

  void emit(NodeId i) {
    const Node& n = graph_[i];
    Program::Instruction made{n.operation, n.function, 0, place_of(n.a), 0, 0, n.c};
    if (has_two_operands(n.operation)) made.b = place_of(n.b);
    if (n.operation == Operation::choice) made.decides = place_of(n.decides);
    if (n.operation == Operation::sum || n.operation == Operation::difference) take_multiple(n, made);
    release(i);
    made.r = new_place();
    place_[index(i)] = made.r;
    made_.instructions_.push_back(made);
  }
  // a + c b or a - c b
  void take_multiple(const Node& n, Program::Instruction& made) {
    const bool second = absorbed_[index(n.b)];
    if (!second && !absorbed_[index(n.a)]) return;
    const Node& part = graph_[second ? n.b : n.a];
    made.operation = Operation::combined;
    made.a = place_of(second ? n.a : n.b);
    made.b = place_of(part.a);
    made.c = n.operation == Operation::difference ? -part.c : part.c;
  }
  // The place of an operand. A number as operand has a place, which is written once. (Place 0 is that of the
  // time.)
  std::uint32_t place_of(NodeId i) {
    if (!graph_.is_number(i) || place_[index(i)] != 0) return place_[index(i)];
    const std::uint32_t place = new_place();
    made_.instructions_.push_back({Operation::number, {}, place, 0, 0, 0, graph_[i].c});
    place_[index(i)] = place;
    return place;
  }

  std::uint32_t new_place() {
    if (free_.empty()) return static_cast<std::uint32_t>(made_.places_++);
    const std::uint32_t place = free_.back();
    free_.pop_back();
    return place;
  }
  // Releases the places of operands that no later node needs, except those of time and state.
  void release(NodeId i) {
    const auto free_place = [&](NodeId operand) {
      if (operand <= graph_.size() || last_use_[index(operand)] != i) return;
      free_.push_back(place_[index(operand)]);
      last_use_[index(operand)] = never;  // it may be both operands: release it once
    };
    for_operands(i, [&](NodeId operand) {
      if (absorbed_[index(operand)]) {
        free_place(graph_[operand].a);
      } else {
        free_place(operand);
      }
    });
  }

  const Graph& graph_;
  const std::vector<NodeId>& outputs_;
  Program& made_;
  std::vector<NodeId> last_use_;
  std::vector<std::uint32_t> place_;
  std::vector<bool> absorbed_;
  std::vector<std::uint32_t> free_;
};

Program::Program(const Graph& graph, const std::vector<NodeId>& outputs) {
  ProgramCompiler(graph, outputs, *this).compile();
}

}  // namespace nlmech::program
