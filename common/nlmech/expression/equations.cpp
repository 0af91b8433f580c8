#include "nlmech/expression/equations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/expression/highest_derivatives.hpp"
#include "nlmech/support/echo.hpp"

namespace nlmech::expression {
namespace {

std::string with_primes(const std::string& name, int primes) {
  return name + std::string(static_cast<std::size_t>(primes), '\'');
}

}  // namespace

/// Gives the names of a tree their meaning.
class Resolver {
 public:
  Resolver(Equations& made, const SourceText& source, const SyntaxTree& tree)
      : made_(made), source_(source), tree_(tree) {}

  void find_unknowns() {
    std::map<std::string, std::size_t> known;
    for (const Syntax& node : tree_.nodes) {
      if (node.kind != SyntaxKind::name || node.primes == 0) continue;
      hold_name(node.name, node.place);
      const auto [entry, is_new] = known.try_emplace(node.name, made_.unknowns_.size());
      if (is_new) made_.unknowns_.push_back({node.name, 0, node.place});
      Unknown& unknown = made_.unknowns_[entry->second];
      if (node.primes > highest_order)
        throw source_.mistake(node.place, fmt::format("derivatives go up to order {}", highest_order));
      if (node.primes > unknown.order) {
        unknown.order = node.primes;
        unknown.place = node.place;
      }
    }
    sort_as_named();
    if (made_.unknowns_.empty())
      throw source_.mistake({0, source_.text().size()},
                            "there is no unknown: a derivative is written x' or x''");
    if (made_.unknowns_.size() > most_unknowns)
      throw source_.mistake(made_.unknowns_[most_unknowns].place,
                            fmt::format("more than {} unknowns", most_unknowns));
    for (int primes = 0; primes < highest_order; ++primes) {
      for (std::size_t i = 0; i < made_.unknowns_.size(); ++i) {
        if (primes < made_.unknowns_[i].order) {
          components_[{made_.unknowns_[i].name, primes}] = static_cast<int>(made_.state_names_.size());
          made_.state_names_.push_back(with_primes(made_.unknowns_[i].name, primes));
        }
      }
    }
    made_.graph_ = Graph(static_cast<int>(made_.state_names_.size()));
    made_.initial_.resize(made_.state_names_.size());
    number_unknowns();
  }

  void define(const Settings& settings) {
    std::vector<Statement> equations;
    for (const Statement& statement : tree_.statements) {
      const Syntax& left = tree_.nodes[statement.left];
      const bool name = left.kind == SyntaxKind::name && left.primes == 0 && !numbers_.contains(left.name);
      if (!name) {
        equations.push_back(statement);
        continue;
      }
      hold_name(left.name, left.place);
      if (!definitions_.try_emplace(left.name, statement.right).second)
        throw source_.mistake(left.place, fmt::format("{} is defined a second time", echoed(left.name)));
    }
    for (const auto& [name, value] : settings) {
      const auto place = definitions_.find(name);
      if (place != definitions_.end()) {
        definitions_.erase(place);
      } else if (!used(name)) {
        throw nlmech::InputError(unknown_setting(name));
      }
      set_[name] = value;
    }
    for (const Statement& statement : tree_.statements) define_parameter(statement);
    for (const auto& [name, value] : settings) {
      made_.defined_[name] = made_.graph_.number(value);
      if (!is_parameter(name)) made_.parameters_.emplace_back(name, value);
    }
    equations_ = std::move(equations);
  }

  void solve() {
    HighestDerivatives system(made_.graph_, static_cast<int>(made_.unknowns_.size()));
    for (const Statement& statement : equations_) {
      LinearForm form = form_of(statement.right);
      add(form, form_of(statement.left), true);
      if (form.highest.empty())
        throw source_.mistake(statement.place,
                              "no highest derivative of an unknown stands here; there are " + highest());
      system.add({form.rest, std::move(form.highest)});
    }
    if (equations_.size() > made_.unknowns_.size())
      throw source_.mistake(equations_[made_.unknowns_.size()].place,
                            fmt::format("there are more equations than unknowns ({})", highest()));
    const std::vector<NodeId> solved = system.solve([this](int unknown, std::string_view sentence) {
      const Unknown& u = made_.unknowns_[static_cast<std::size_t>(unknown)];
      return source_.mistake(u.place, fmt::format("{}: {}", with_primes(u.name, u.order), sentence));
    });
    for (int primes = 1; primes <= highest_order; ++primes) {
      for (std::size_t i = 0; i < made_.unknowns_.size(); ++i) {
        const Unknown& u = made_.unknowns_[i];
        if (primes < u.order) made_.slopes_.push_back(Graph::state(components_.at({u.name, primes})));
        if (primes == u.order) made_.slopes_.push_back(solved[i]);
      }
    }
  }

  void take_initial_values() {
    for (const InitialValue& given : tree_.initial_values) {
      const auto component = components_.find({given.name, given.primes});
      if (component == components_.end())
        throw source_.mistake(given.place, fmt::format("no component of the state; these are {}",
                                                       fmt::join(made_.state_names_, ", ")));
      const double time = number(given.time, "the time of an initial value");
      if (made_.initial_time_.value_or(time) != time)
        throw source_.mistake(given.place,
                              fmt::format("another initial value is at the time {}", *made_.initial_time_));
      made_.initial_time_ = time;
      std::optional<double>& value = made_.initial_[static_cast<std::size_t>(component->second)];
      if (value) throw source_.mistake(given.place, "given a second time");
      value = number(given.value, "an initial value");
    }
  }

  // The meaning that names have already, for a text that comes later.
  void take_names() {
    number_unknowns();
    for (std::size_t i = 0; i < made_.state_names_.size(); ++i) {
      const std::string& full = made_.state_names_[i];
      const std::size_t primes = full.size() - full.find_last_not_of('\'') - 1;
      components_[{full.substr(0, full.size() - primes), static_cast<int>(primes)}] = static_cast<int>(i);
    }
  }

  // A number that does not change with time and state.
  double number(std::size_t node, std::string_view what) {
    const LinearForm form = form_of(node);
    const Place place = tree_.nodes[node].place;
    if (!form.highest.empty() || !made_.graph_.is_number(form.rest))
      throw source_.mistake(place,
                            fmt::format("{} is a number, or an expression of definitions that are", what));
    const double value = made_.graph_[form.rest].c;
    if (!std::isfinite(value))
      throw source_.mistake(place, fmt::format("{} is finite, and this is {}", what, value));
    return value;
  }

  NodeId expression(std::size_t node) {
    const LinearForm form = form_of(node);
    if (!form.highest.empty())
      throw source_.mistake(tree_.nodes[node].place,
                            "highest derivatives may not stand here; components of the state are " +
                                fmt::format("{}", fmt::join(made_.state_names_, ", ")));
    return form.rest;
  }

  int component(const Syntax& node) const {
    const auto place = components_.find({node.name, node.primes});
    return place == components_.end() ? -1 : place->second;
  }

 private:
  /// An expression that is linear in the highest derivatives: rest + sum of coefficients times these.
  struct LinearForm {
    NodeId rest;
    std::map<int, NodeId> highest;  ///< coefficient of the highest derivative of each unknown
  };

  static constexpr std::size_t most_unknowns = 2000;
  static constexpr int most_depth = 2000;  // of definitions and brackets together

  void hold_name(const std::string& name, const Place& place) const {
    if (name == "t") throw source_.mistake(place, "t is the time");
    if (name == "pi") throw source_.mistake(place, "pi is 3.14159...");
    if (function_by_name(name)) throw source_.mistake(place, fmt::format("{} is a function", name));
  }
  // Nodes are made from left to right but for brackets: the places say what the text names first.
  void sort_as_named() {
    std::map<std::string, std::size_t> first;
    for (const Syntax& node : tree_.nodes) {
      if (node.kind != SyntaxKind::name) continue;
      const auto [entry, is_new] = first.try_emplace(node.name, node.place.begin);
      if (!is_new) entry->second = std::min(entry->second, node.place.begin);
    }
    std::sort(made_.unknowns_.begin(), made_.unknowns_.end(),
              [&](const Unknown& a, const Unknown& b) { return first[a.name] < first[b.name]; });
  }
  void number_unknowns() {
    for (std::size_t i = 0; i < made_.unknowns_.size(); ++i)
      numbers_[made_.unknowns_[i].name] = static_cast<int>(i);
  }
  [[nodiscard]] bool used(const std::string& name) const {
    return std::any_of(tree_.nodes.begin(), tree_.nodes.end(), [&](const Syntax& node) {
      return node.kind == SyntaxKind::name && node.name == name && node.primes == 0 &&
             !numbers_.contains(name) && name != "t" && name != "pi";
    });
  }
  [[nodiscard]] std::string unknown_setting(const std::string& name) const {
    std::vector<std::string> known;
    for (const auto& [defined, node] : definitions_) known.push_back(defined);
    return fmt::format("--set {}: the equation has no such definition{}{}", echoed(name),
                       known.empty() ? "" : "; there is ", fmt::join(known, ", "));
  }
  [[nodiscard]] bool is_parameter(const std::string& name) const {
    return std::any_of(made_.parameters_.begin(), made_.parameters_.end(),
                       [&](const auto& p) { return p.first == name; });
  }
  void define_parameter(const Statement& statement) {
    const Syntax& left = tree_.nodes[statement.left];
    if (left.kind != SyntaxKind::name || left.primes > 0 || numbers_.contains(left.name)) return;
    const auto set = set_.find(left.name);
    const NodeId value =
        set != set_.end() ? made_.graph_.number(set->second) : definition(left.name, left.place);
    if (made_.graph_.is_number(value)) made_.parameters_.emplace_back(left.name, made_.graph_[value].c);
  }

  [[nodiscard]] std::string highest() const {
    std::vector<std::string> names;
    for (const Unknown& u : made_.unknowns_) names.push_back(with_primes(u.name, u.order));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  // The node of a definition. One that holds highest derivatives is no node, and kept as a form.
  NodeId definition(const std::string& name, const Place& place) { return definition_form(name, place).rest; }
  const LinearForm& definition_form(const std::string& name, const Place& place) {
    const auto known = forms_.find(name);
    if (known != forms_.end()) return known->second;
    if (!open_.emplace(name, true).second)
      throw source_.mistake(place, fmt::format("the definition of {} leads back to itself", echoed(name)));
    LinearForm form = form_of(definitions_.at(name));
    open_.erase(name);
    if (form.highest.empty()) made_.defined_[name] = form.rest;
    return forms_.emplace(name, std::move(form)).first->second;
  }

  LinearForm form_of(std::size_t index) {
    const Syntax& node = tree_.nodes[index];
    if (++depth_ > most_depth) throw source_.mistake(node.place, "definitions are nested too deeply here");
    LinearForm form = meaning(node);
    --depth_;
    return form;
  }
  LinearForm meaning(const Syntax& node) {
    switch (node.kind) {
      case SyntaxKind::number: return {made_.graph_.number(node.number), {}};
      case SyntaxKind::name: return name(node);
      case SyntaxKind::negative: return scaled(form_of(node.operands[0].node), made_.graph_.number(-1));
      case SyntaxKind::sum: return sum(node);
      case SyntaxKind::product: return product(node);
      case SyntaxKind::power: return power(node);
      default: return call(node);
    }
  }

  LinearForm name(const Syntax& node) {
    const auto unknown = numbers_.find(node.name);
    if (unknown != numbers_.end()) {
      const int place = component(node);
      if (place >= 0) return {Graph::state(place), {}};
      if (node.primes == made_.unknowns_[static_cast<std::size_t>(unknown->second)].order)
        return {made_.graph_.number(0), {{unknown->second, made_.graph_.number(1)}}};
      throw source_.mistake(node.place,
                            fmt::format("{} is of order {} in the equations", node.name,
                                        made_.unknowns_[static_cast<std::size_t>(unknown->second)].order));
    }
    if (node.primes > 0)
      throw source_.mistake(node.place, fmt::format("{} is no unknown of the equations", node.name));
    if (node.name == "t") return {Graph::time(), {}};
    if (node.name == "pi") return {made_.graph_.number(std::numbers::pi), {}};
    if (definitions_.contains(node.name)) return definition_form(node.name, node.place);
    const auto set = set_.find(node.name);
    if (set != set_.end()) return {made_.graph_.number(set->second), {}};
    const auto defined = made_.defined_.find(node.name);
    if (defined != made_.defined_.end()) return {defined->second, {}};
    throw source_.mistake(node.place, unknown_name(node.name));
  }
  [[nodiscard]] std::string unknown_name(const std::string& name) const {
    const std::string shown = echoed(name);
    if (name == "e") return "e is not defined; write exp(1), or exp(x) for e^x";
    for (std::size_t cut = 1; cut < name.size(); ++cut) {
      const std::string a = name.substr(0, cut), b = name.substr(cut);
      if (means_something(a) && means_something(b))
        return fmt::format("{} is not defined; a product is written {} {}", shown, a, b);
    }
    return fmt::format("{0} is not defined: it has neither a derivative ({0}') nor a definition ({0} = ...)",
                       shown);
  }
  [[nodiscard]] bool means_something(const std::string& name) const {
    return name == "t" || name == "pi" || numbers_.contains(name) || definitions_.contains(name) ||
           set_.contains(name);
  }

  void add(LinearForm& to, const LinearForm& what, bool subtract) {
    Graph& g = made_.graph_;
    to.rest = subtract ? g.difference(to.rest, what.rest) : g.sum(to.rest, what.rest);
    for (const auto& [unknown, coefficient] : what.highest) {
      const auto [entry, is_new] = to.highest.try_emplace(unknown, g.number(0));
      entry->second = subtract ? g.difference(entry->second, coefficient) : g.sum(entry->second, coefficient);
      if (g.is_number(entry->second, 0)) to.highest.erase(entry);
    }
  }
  LinearForm scaled(LinearForm form, NodeId factor, bool divide = false) {
    Graph& g = made_.graph_;
    const auto apply = [&](NodeId& node) {
      node = divide ? g.quotient(node, factor) : g.product(factor, node);
    };
    apply(form.rest);
    for (auto& [unknown, coefficient] : form.highest) apply(coefficient);
    std::erase_if(form.highest, [&](const auto& entry) { return g.is_number(entry.second, 0); });
    return form;
  }
  LinearForm sum(const Syntax& node) {
    LinearForm all = form_of(node.operands[0].node);
    for (std::size_t i = 1; i < node.operands.size(); ++i)
      add(all, form_of(node.operands[i].node), node.operands[i].inverse);
    return all;
  }
  LinearForm product(const Syntax& node) {
    LinearForm all = form_of(node.operands[0].node);
    for (std::size_t i = 1; i < node.operands.size(); ++i) {
      const auto [operand, divisor] = node.operands[i];
      LinearForm factor = form_of(operand);
      if (factor.highest.empty()) {
        all = scaled(std::move(all), factor.rest, divisor);
      } else if (divisor || !all.highest.empty()) {
        throw nonlinear(operand, factor, divisor ? "in a divisor" : "in a product with another one");
      } else {
        all = scaled(std::move(factor), all.rest);
      }
    }
    return all;
  }
  LinearForm power(const Syntax& node) {
    const LinearForm base = form_of(node.operands[0].node), exponent = form_of(node.operands[1].node);
    if (!exponent.highest.empty()) throw nonlinear(node.operands[1].node, exponent, "in an exponent");
    if (base.highest.empty()) return {made_.graph_.power(base.rest, exponent.rest), {}};
    if (made_.graph_.is_number(exponent.rest, 1)) return base;
    throw nonlinear(node.operands[0].node, base, "in a power");
  }
  LinearForm call(const Syntax& node) {
    std::vector<NodeId> arguments;
    for (const Syntax::Operand& operand : node.operands) {
      const LinearForm form = form_of(operand.node);
      if (!form.highest.empty()) throw nonlinear(operand.node, form, "in a function");
      arguments.push_back(form.rest);
    }
    return {made_.graph_.call(node.function, arguments.front(), arguments.back()), {}};
  }
  [[nodiscard]] InputError nonlinear(std::size_t node, const LinearForm& form, std::string_view where) const {
    const Unknown& u = made_.unknowns_[static_cast<std::size_t>(form.highest.begin()->first)];
    return source_.mistake(tree_.nodes[node].place,
                           fmt::format("{} stands {}; a highest derivative has to stand linearly",
                                       with_primes(u.name, u.order), where));
  }

  Equations& made_;
  const SourceText& source_;
  const SyntaxTree& tree_;
  std::map<std::string, int> numbers_;                     // of the unknowns
  std::map<std::pair<std::string, int>, int> components_;  // of the state
  std::map<std::string, std::size_t> definitions_;         // and their expressions
  std::map<std::string, LinearForm> forms_;                // of definitions, as far as they were needed
  std::map<std::string, bool> open_;                       // definitions that are being worked out
  Settings set_;
  std::vector<Statement> equations_;
  int depth_ = 0;
};

Equations::Equations(SourceText source, const Settings& settings)
    : source_(std::move(source)), tree_(parse(source_)) {
  Resolver resolver(*this, source_, tree_);
  resolver.find_unknowns();
  resolver.define(settings);
  resolver.solve();
  resolver.take_initial_values();
}

bool Equations::second_order() const {
  return std::all_of(unknowns_.begin(), unknowns_.end(), [](const Unknown& u) { return u.order == 2; });
}

NodeId Equations::expression(const std::string& name, const std::string& text) {
  const SourceText source(name, text);
  SyntaxTree tree;
  if (text.find('=') == std::string::npos) {
    const std::size_t root = parse_expression(source, tree);
    Resolver resolver(*this, source, tree);
    resolver.take_names();
    return resolver.expression(root);
  }
  tree = parse(source);
  if (tree.statements.size() != 1 || !tree.initial_values.empty())
    throw source.mistake({0, text.size()}, "one expression, or one equation");
  Resolver resolver(*this, source, tree);
  resolver.take_names();
  const NodeId left = resolver.expression(tree.statements.front().left);
  return graph_.difference(left, resolver.expression(tree.statements.front().right));
}

std::vector<double> Equations::initial_state(const std::string& name, const std::string& text) {
  // "x=1, x'=0"
  const SourceText source(name, text);
  const SyntaxTree tree = parse(source, Separator::comma);
  Resolver resolver(*this, source, tree);
  resolver.take_names();
  std::vector<std::optional<double>> given(state_names_.size());
  if (!tree.initial_values.empty())
    throw source.mistake(tree.initial_values.front().place,
                         "initial values are given as x=1; --from gives the time");
  for (const Statement& statement : tree.statements) {
    const Syntax& left = tree.nodes[statement.left];
    const int component = left.kind == SyntaxKind::name ? resolver.component(left) : -1;
    if (component < 0)
      throw source.mistake(
          left.place, fmt::format("no component of the state; these are {}", fmt::join(state_names_, ", ")));
    std::optional<double>& value = given[static_cast<std::size_t>(component)];
    if (value) throw source.mistake(left.place, "given a second time");
    value = resolver.number(statement.right, "an initial value");
  }
  std::vector<double> x;
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::optional<double> value = given[i] ? given[i] : initial_[i];
    x.push_back(value.value_or(0));
    if (!value) missing.push_back(state_names_[i]);
  }
  if (missing.empty()) return x;
  const auto needs = std::find_if(unknowns_.begin(), unknowns_.end(), [&](const Unknown& u) {
    return missing.front().substr(0, missing.front().find('\'')) == u.name;
  });
  throw source_.mistake(needs->place, fmt::format("an initial value is missing: {} {}=...", name,
                                                  fmt::join(missing, "=..., ")));
}

}  // namespace nlmech::expression
