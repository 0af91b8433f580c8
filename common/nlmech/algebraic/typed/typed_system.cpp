#include "nlmech/algebraic/typed/typed_system.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "nlmech/program/domain.hpp"
#include "nlmech/program/syntax.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

using namespace program;

/// Value of an expression of numbers. @throws InputError that points at the mistake
double number_of(const std::string& option, const std::string& text) {
  const SourceText source(option, text);
  SyntaxTree tree;
  Graph graph(0);
  Names names;
  const std::size_t root = parse_expression(source, tree);
  return Meaning(graph, names, source, tree).number(root, "a limit of a range");
}

std::string joined(const std::vector<std::string>& names) {
  return quoted_input(fmt::format("{}", fmt::join(names, ", ")), 200);
}

}  // namespace

NamedRanges read_ranges(const std::string& option, const std::string& text) {
  NamedRanges all;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string piece = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t sign = piece.find('='), colon = piece.find(':');
    if (sign == std::string::npos || colon == std::string::npos || colon < sign)
      throw input_error("{} {}: write a range as x = -5:5, and separate several by commas", option,
                        quoted_input(piece));
    const std::set<std::string> name = assigned_names(option, piece.substr(0, sign + 1) + "0");
    const double first = number_of(option, piece.substr(sign + 1, colon - sign - 1)),
                 last = number_of(option, piece.substr(colon + 1));
    if (first == last)
      throw input_error("{} {}: both limits are {}; give a range", option, quoted_input(piece), first);
    const auto [range, is_new] = all.try_emplace(name.empty() ? "" : *name.begin(), first, last);
    if (!is_new)
      throw input_error("{} {}: {} has a range already", option, quoted_input(piece),
                        quoted_input(range->first));
  }
  return all;
}

std::set<std::string> assigned_names(const std::string& option, const std::string& text) {
  std::set<std::string> names;
  const SourceText source(option, text);
  const SyntaxTree tree = parse(source, Separator::comma);
  for (const Statement& statement : tree.statements) {
    const Syntax& left = tree.nodes[statement.left];
    if (left.kind != SyntaxKind::name || left.primes > 0)
      throw source.mistake(left.place, "write name = value");
    names.insert(left.name);
  }
  return names;
}

/// Makes a TypedSystem from a syntax tree.
class SystemReader {
 public:
  SystemReader(TypedSystem& made, const SystemInput& input)
      : made_(made), input_(input), source_(made.source_), tree_(parse(source_)) {}

  void read() {
    refuse_foreign_statements();
    find_definitions();
    find_unknowns();
    Graph graph(static_cast<int>(made_.names_.size()) + (input_.parameter.empty() ? 0 : 1));
    Meaning meaning(graph, symbols_, source_, tree_);
    for (const auto& [name, root] : definitions_) meaning.define(name, root);
    for (const auto& [name, value] : input_.settings) symbols_.defined[name] = {graph.number(value), {}};
    compile(graph, residuals(graph, meaning));
    take_starts(meaning);
    take_conditions(source_, tree_, meaning);
  }

  void read_bounds(const std::string& option, const std::string& text) {
    Graph graph(0);
    const SourceText source(option, text);
    const SyntaxTree tree = parse(source);
    if (!tree.statements.empty() || !tree.initial_values.empty() || tree.conditions.empty())
      throw source.mistake({0, text.size()}, "write bounds as x >= 0; y < 2");
    Meaning meaning(graph, symbols_, source, tree);
    take_conditions(source, tree, meaning);
  }

 private:
  void refuse_foreign_statements() const {
    for (const Syntax& node : tree_.nodes) {
      if (node.kind == SyntaxKind::name && node.primes > 0)
        throw source_.mistake(
            node.place, "a derivative; `integrators integrate` and `rbf_inverse bvp` take such equations");
    }
    if (!tree_.conserved.empty())
      throw source_.mistake(tree_.nodes[tree_.conserved.front()].place, "no quantity is conserved here");
    for (const auto& [name, value] : input_.settings) {
      if (!std::isfinite(value)) throw input_error("--set {}: must be finite", quoted_input(name));
      if (!occurs(name) || name == "pi" || input_.unknowns.contains(name))
        throw input_error(
            "--set {}: {}", quoted_input(name),
            input_.unknowns.contains(name) ? "is an unknown" : "the equations have no such name");
    }
  }
  [[nodiscard]] bool occurs(const std::string& name) const {
    return std::ranges::any_of(
        tree_.nodes, [&](const Syntax& node) { return node.kind == SyntaxKind::name && node.name == name; });
  }

  void find_definitions() {
    std::set<std::string> unknowns = input_.unknowns;
    for (const InitialValue& given : tree_.initial_values) unknowns.insert(given.name);
    for (const Statement& statement : tree_.statements) {
      const Syntax& left = tree_.nodes[statement.left];
      if (left.kind != SyntaxKind::name || unknowns.contains(left.name)) continue;
      if (left.name == "pi") throw source_.mistake(left.place, "pi is reserved for 3.14159...");
      if (!definitions_.emplace(left.name, statement.right).second)
        throw source_.mistake(left.place,
                              fmt::format("{} is defined twice; if it is an unknown, give it a start value",
                                          quoted_input(left.name)));
    }
    for (const Statement& statement : tree_.statements) {
      const Syntax& left = tree_.nodes[statement.left];
      std::set<std::string> seen;
      const auto found = left.kind == SyntaxKind::name ? definitions_.find(left.name) : definitions_.end();
      if (found != definitions_.end() && depends(found->second, left.name, seen)) definitions_.erase(found);
    }
    definitions_.erase(input_.parameter);
  }
  /// Does the expression contain @p name, itself or through definitions?
  [[nodiscard]] bool depends(std::size_t root, const std::string& name, std::set<std::string>& seen) const {
    const Syntax& node = tree_.nodes[root];
    if (node.kind == SyntaxKind::name) {
      if (node.name == name) return true;
      const auto next = definitions_.find(node.name);
      return next != definitions_.end() && seen.insert(node.name).second && depends(next->second, name, seen);
    }
    return std::ranges::any_of(
        node.operands, [&](const Syntax::Operand& operand) { return depends(operand.node, name, seen); });
  }

  void find_unknowns() {
    std::map<std::size_t, std::string> by_place;
    for (const Syntax& node : tree_.nodes) {
      const bool is_known = node.kind != SyntaxKind::name || node.name == "pi" ||
                            definitions_.contains(node.name) || input_.settings.contains(node.name) ||
                            node.name == input_.parameter;
      if (!is_known) by_place.emplace(node.place.begin, node.name);
    }
    for (const auto& [place, name] : by_place) {
      if (std::ranges::find(made_.names_, name) == made_.names_.end()) made_.names_.push_back(name);
    }
    if (!input_.parameter.empty() && !occurs(input_.parameter))
      throw input_error("--parameter {}: the equations have no such name", quoted_input(input_.parameter));
    for (std::size_t i = 0; i < made_.names_.size(); ++i) add_component(made_.names_[i], i);
    if (!input_.parameter.empty()) add_component(input_.parameter, made_.names_.size());
    const Eigen::Index n = made_.size();
    made_.lower_.setConstant(n, -std::numeric_limits<double>::infinity());
    made_.upper_.setConstant(n, std::numeric_limits<double>::infinity());
  }
  void add_component(const std::string& name, std::size_t i) {
    symbols_.unknowns.push_back({name, 1, {}});
    symbols_.numbers[name] = static_cast<int>(i);
    symbols_.components[{name, 0}] = static_cast<int>(i);
  }

  std::vector<NodeId> residuals(Graph& graph, Meaning& meaning) {
    std::vector<NodeId> f;
    for (const Statement& statement : tree_.statements) {
      const Syntax& left = tree_.nodes[statement.left];
      if (left.kind == SyntaxKind::name &&
          (definitions_.contains(left.name) || left.name == input_.parameter))
        continue;
      f.push_back(graph.difference(meaning.expression(statement.left), meaning.expression(statement.right)));
      if (graph.is_number(f.back())) throw source_.mistake(statement.place, "this equation has no unknown");
    }
    if (f.empty() && definitions_.contains("energy")) {
      made_.has_energy_ = true;
      const NodeId energy = meaning.definition("energy", {}).rest;
      made_.energy_ = Program(graph, {energy});
      for (std::size_t i = 0; i < made_.names_.size(); ++i)
        f.push_back(rates(graph, {energy}, unit(graph, i)).front());
    }
    check_count(f.size());
    return f;
  }
  void check_count(std::size_t equations) const {
    const std::vector<std::string>& names = made_.names_;
    const Place all{0, source_.text().size()};
    if (equations == 0 || names.empty())
      throw source_.mistake(all, names.empty() ? "there is no unknown: every name has a definition; a name "
                                                 "with a start value is an unknown"
                                               : "there is no equation, and no definition of energy");
    if (equations == names.size()) return;
    throw source_.mistake(
        all, fmt::format("{} equation{} for {} unknown{} ({}); a constant has a definition (a = 3) or a "
                         "--set, and an unknown on the left of = a start value{}",
                         equations, equations == 1 ? "" : "s", names.size(), names.size() == 1 ? "" : "s",
                         joined(names),
                         std::ranges::count(names, "e") > 0 ? "; exp(x) is the exponential function" : ""));
  }
  [[nodiscard]] static std::vector<NodeId> unit(Graph& graph, std::size_t i) {
    std::vector<NodeId> direction(static_cast<std::size_t>(graph.size()), graph.number(0));
    direction[i] = graph.number(1);
    return direction;
  }

  void compile(Graph& graph, const std::vector<NodeId>& f) {
    made_.columns_ = graph.size();
    made_.values_ = Program(graph, f);
    std::vector<NodeId> outputs = f;
    for (int j = 0; j < graph.size(); ++j) {
      const std::vector<NodeId> column = rates(graph, f, unit(graph, static_cast<std::size_t>(j)));
      for (std::size_t i = 0; i < column.size(); ++i) {
        if (graph.is_number(column[i], 0)) continue;
        made_.entries_.emplace_back(static_cast<int>(i), j);
        outputs.push_back(column[i]);
      }
    }
    add_guards(graph, f, outputs);
    made_.all_ = Program(graph, outputs);
  }
  void add_guards(Graph& graph, const std::vector<NodeId>& f, std::vector<NodeId>& outputs) {
    const std::vector<bool> needed = parts_of(graph, f);
    for (NodeId id = 0; id < static_cast<NodeId>(needed.size()); ++id) {
      if (!needed[index(id)]) continue;
      const Node node = graph[id];
      const bool is_choice = node.operation == Operation::choice,
                 is_angle = node.operation == Operation::atan2,
                 is_log = node.operation == Operation::function && node.function == Function::log;
      std::optional<NodeId> operand = is_log ? node.a : needs_positive(graph, node);
      if (is_choice) operand = node.decides;
      // ceil, round, frac and mod are made of floor.
      if (is_angle || node.operation == Operation::floor) operand = node.a;
      if (!operand) continue;
      made_.guards_.push_back({node.operation, outputs.size()});
      made_.has_choices_ = made_.has_choices_ || is_choice;
      outputs.push_back(*operand);
      if (is_angle) outputs.push_back(node.b);
    }
  }

  void take_starts(Meaning& meaning) {
    for (const InitialValue& given : tree_.initial_values) {
      if (meaning.number(given.time, "the number of an iterate") != 0 || given.primes > 0)
        throw source_.mistake(given.place, "a start value is written x(0) = 1");
      if (!symbols_.numbers.contains(given.name))
        throw source_.mistake(given.place, fmt::format("no unknown; these are {}", joined(made_.names_)));
      if (!made_.starts_.emplace(given.name, meaning.number(given.value, "a start value")).second)
        throw source_.mistake(given.place, "given twice");
    }
  }
  void take_conditions(const SourceText& source, const SyntaxTree& tree, Meaning& meaning) {
    for (const Condition& c : tree.conditions) {
      const Syntax& left = tree.nodes[c.left];
      const auto found = std::ranges::find(made_.names_, left.name);
      if (left.kind != SyntaxKind::name || found == made_.names_.end())
        throw source.mistake(left.place,
                             fmt::format("a bound must begin with an unknown: {}", joined(made_.names_)));
      const auto i = static_cast<Eigen::Index>(found - made_.names_.begin());
      const bool is_upper = c.relation == TokenKind::at_most || c.relation == TokenKind::below;
      double bound = meaning.number(c.right, "a bound");
      if (c.relation == TokenKind::below) bound = std::nextafter(bound, -HUGE_VAL);
      if (c.relation == TokenKind::above) bound = std::nextafter(bound, HUGE_VAL);
      (is_upper ? made_.upper_ : made_.lower_)[i] = bound;
      if (!(made_.lower_[i] <= made_.upper_[i]))
        throw source.mistake(c.place, "the lower bound is above the upper bound");
    }
  }

  TypedSystem& made_;
  const SystemInput& input_;
  const SourceText& source_;
  SyntaxTree tree_;
  Names symbols_;
  std::map<std::string, std::size_t> definitions_;
};

TypedSystem::TypedSystem(SourceText source, const SystemInput& input) : source_(std::move(source)) {
  SystemReader(*this, input).read();
}

void TypedSystem::add_bounds(const std::string& option, const std::string& text) {
  SystemReader(*this, {}).read_bounds(option, text);
}

Eigen::VectorXd TypedSystem::start(const std::string& option, const std::string& text) const {
  const SourceText source(option, text);
  const SyntaxTree tree = parse(source, Separator::comma);
  Graph graph(0);
  Names names;
  Meaning meaning(graph, names, source, tree);
  std::map<std::string, double> given = starts_;
  std::set<std::string> typed;
  for (const Statement& statement : tree.statements) {
    const Syntax& left = tree.nodes[statement.left];
    if (left.kind != SyntaxKind::name || std::ranges::find(names_, left.name) == names_.end())
      throw source.mistake(left.place, fmt::format("no unknown; these are {}", joined(names_)));
    if (!typed.insert(left.name).second) throw source.mistake(left.place, "given twice");
    given[left.name] = meaning.number(statement.right, "a start value");
  }
  Eigen::VectorXd x(size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    const std::string& name = names_[static_cast<std::size_t>(i)];
    if (!given.contains(name))
      throw input_error("{0}: a start value of {1} is missing; add {1}=1", option, quoted_input(name));
    x[i] = given[name];
    if (x[i] >= lower_[i] && x[i] <= upper_[i]) continue;
    throw input_error("{} {}: {} = {} is outside its bounds, {} to {}", option, quoted_input(text),
                      quoted_input(name), x[i], lower_[i], upper_[i]);
  }
  return x;
}

void TypedSystem::residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) const {
  f.resize(size());
  values_.run(0., x, 0, values_.outputs(), [&](int i, double value) { f[i] = value; });
}

void TypedSystem::derivative(const Eigen::VectorXd& x, Eigen::MatrixXd& j) const {
  j.setZero(size(), columns_);
  const std::size_t n = names_.size();
  all_.run(0., x, n, n + entries_.size(), [&](int k, double value) {
    const auto [row, column] = entries_[static_cast<std::size_t>(k)];
    j(row, column) = value;
  });
}

double TypedSystem::energy(const Eigen::VectorXd& x) const {
  double energy = 0;
  energy_.run(0., x, 0, 1, [&](int, double value) { energy = value; });
  return energy;
}

TypedSystem::Domain TypedSystem::domain_of(const Guard& guard, const Box& outputs) const {
  const Interval& a = outputs[guard.output];
  const auto decide = [&](bool is_outside, bool is_smooth) {
    // Beside a choice the operand may be one that is not chosen.
    return is_outside && !has_choices_ ? Domain::outside : is_smooth ? Domain::smooth : Domain::rough;
  };
  switch (guard.operation) {
    case Operation::choice: return decide(false, a.low > 0 || a.high < 0);
    case Operation::floor: return decide(false, std::floor(a.low) == std::floor(a.high));
    case Operation::atan2: return decide(false, !(a.has(0) && outputs[guard.output + 1].low <= 0));
    default: return decide(a.high<0, a.low> 0);
  }
}

TypedSystem::Domain TypedSystem::enclose(const Box& x, Box& f, Box& j) const {
  const std::size_t n = names_.size(), columns = static_cast<std::size_t>(columns_);
  Box out(all_.outputs());
  all_.run(Interval(0.), x, 0, all_.outputs(),
           [&](int k, const Interval& value) { out[static_cast<std::size_t>(k)] = value; });
  f.assign(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n));
  j.assign(n * columns, Interval(0.));
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const auto [row, column] = entries_[k];
    j[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] = out[n + k];
  }
  Domain least = Domain::smooth;
  for (const Guard& guard : guards_) least = std::min(least, domain_of(guard, out));
  return least;
}

}  // namespace nlmech::algebraic
