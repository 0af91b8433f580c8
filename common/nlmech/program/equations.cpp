#include "nlmech/program/equations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nlmech/program/highest_derivatives.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech::program {

/// Makes Equations from a syntax tree.
class EquationReader {
 public:
  explicit EquationReader(Equations& made)
      : made_(made),
        names_(made.names_),
        source_(made.source_),
        tree_(made.tree_),
        meaning_(made.graph_, made.names_, made.source_, made.tree_) {}

  // Finds the unknowns: names that occur with a prime, in the order of their first occurrence with or without
  // one, including initial values.
  void find_unknowns() {
    std::map<std::string, std::size_t> first;
    for (const Syntax& node : tree_.nodes) {
      if (node.kind != SyntaxKind::name) continue;
      const auto entry = first.try_emplace(node.name, node.place.begin).first;
      entry->second = std::min(entry->second, node.place.begin);
      if (node.primes > 0) take_derivative(node);
    }
    for (const InitialValue& given : tree_.initial_values) {
      const auto entry = first.find(given.name);
      if (entry != first.end()) entry->second = std::min(entry->second, given.place.begin);
    }
    std::sort(names_.unknowns.begin(), names_.unknowns.end(),
              [&](const Unknown& a, const Unknown& b) { return first[a.name] < first[b.name]; });
    for (std::size_t i = 0; i < names_.unknowns.size(); ++i)
      names_.numbers[names_.unknowns[i].name] = static_cast<int>(i);
    if (names_.unknowns.empty())
      throw source_.mistake({0, source_.text().size()},
                            "there is no unknown: a derivative is written x' or x''");
    if (names_.unknowns.size() > most_unknowns)
      throw source_.mistake(names_.unknowns[most_unknowns].place,
                            fmt::format("more than {} unknowns", most_unknowns));
  }

  // All unknowns, then their first derivatives, and so on.
  void name_components() {
    for (int primes = 0; primes < highest_order; ++primes) {
      for (const Unknown& u : names_.unknowns) {
        if (primes >= u.order) continue;
        names_.components[{u.name, primes}] = static_cast<int>(made_.state_names_.size());
        made_.state_names_.push_back(with_primes(u.name, primes));
      }
    }
    const std::size_t size = made_.state_names_.size();
    made_.graph_ = Graph(static_cast<int>(size + made_.variables_.size()));
    made_.initial_.resize(size);
    made_.layout_ = {static_cast<int>(size), 0, made_.second_order()};
  }

  // `name = ...` is a definition unless the name is an unknown; other statements are equations.
  void define(const Settings& settings) {
    std::map<std::string, Place> definitions;
    for (const Statement& statement : tree_.statements) {
      const Syntax& left = tree_.nodes[statement.left];
      if (!defines(left)) {
        equations_.push_back(statement);
        continue;
      }
      check_name(left.name, left.place);
      if (!definitions.emplace(left.name, left.place).second)
        throw source_.mistake(left.place, fmt::format("{} is defined twice", quoted_input(left.name)));
      meaning_.define(left.name, statement.right);
    }
    for (const auto& [name, value] : settings) {
      if (!definitions.contains(name) && !used(name)) throw InputError(unknown_setting(name, definitions));
      if (!std::isfinite(value))
        throw InputError(fmt::format("--set {}: must be a finite number, not {}", quoted_input(name), value));
      names_.defined[name] = {made_.graph_.number(value), {}};
    }
    for (std::size_t i = 0; i < made_.variables_.size(); ++i)
      names_.defined[made_.variables_[i]] = {Graph::state(made_.layout_.size + static_cast<int>(i)), {}};
    if (made_.variables_.empty()) check_definitions(settings);
    for (const Statement& statement : tree_.statements) {
      const Syntax& left = tree_.nodes[statement.left];
      if (defines(left)) add_parameter(left.name, meaning_.definition(left.name, left.place));
    }
    for (const auto& [name, value] : settings) {
      if (!definitions.contains(name)) add_parameter(name, names_.defined.at(name));
    }
  }

  void solve() {
    HighestDerivatives system(made_.graph_, static_cast<int>(names_.unknowns.size()));
    for (const Statement& statement : equations_) {
      LinearForm form = meaning_.form_of(statement.right);
      meaning_.subtract(form, meaning_.form_of(statement.left));
      if (form.highest.empty())
        throw source_.mistake(statement.place,
                              "this equation has no highest derivative of an unknown; it needs one of " +
                                  quoted_input(names_.highest(), 200));
      system.add({form.rest, std::move(form.highest)});
    }
    if (equations_.size() > names_.unknowns.size())
      throw source_.mistake(
          equations_[names_.unknowns.size()].place,
          fmt::format("there are more equations than unknowns ({})", quoted_input(names_.highest(), 200)));
    const std::vector<NodeId> solved = system.solve([this](int unknown, std::string_view sentence) {
      const Unknown& u = names_.unknowns[static_cast<std::size_t>(unknown)];
      return source_.mistake(u.place, fmt::format("{}: {}", with_primes(u.name, u.order), sentence));
    });
    for (int primes = 1; primes <= highest_order; ++primes) {
      for (std::size_t i = 0; i < names_.unknowns.size(); ++i) {
        const Unknown& u = names_.unknowns[i];
        if (primes < u.order) made_.slopes_.push_back(Graph::state(names_.components.at({u.name, primes})));
        if (primes == u.order) made_.slopes_.push_back(solved[i]);
      }
    }
  }

  void take_initial_values() {
    for (const InitialValue& given : tree_.initial_values) {
      const double time = meaning_.number(given.time, "the time of an initial value");
      const auto component = names_.components.find({given.name, given.primes});
      if (component == names_.components.end()) throw source_.mistake(given.place, no_component(made_));
      if (made_.initial_time_.value_or(time) != time)
        throw source_.mistake(given.place,
                              fmt::format("another initial value is given at time {}", *made_.initial_time_));
      made_.initial_time_ = time;
      std::optional<NodeId>& value = made_.initial_[static_cast<std::size_t>(component->second)];
      if (value) throw source_.mistake(given.place, "given twice");
      value = initial_value(made_, meaning_, given.value);
    }
  }

  void take_conserved() {
    for (const std::size_t root : tree_.conserved) made_.conserved_.push_back(meaning_.expression(root));
  }

  void take_conditions() {
    for (const Condition& c : tree_.conditions) {
      const Syntax& left = tree_.nodes[c.left];
      const int component = names_.component(left);
      if (is_time(left)) {
        take_end(c, meaning_.number(c.right, "a bound"));
      } else if (component >= 0) {
        take_bound(c, static_cast<std::size_t>(component), meaning_.number(c.right, "a bound"));
      }
    }
  }

  // Sets the summary: equations, and definitions that are not numbers, without comments, with single blanks.
  void summarise() {
    for (const Statement& statement : tree_.statements) {
      const Syntax& left = tree_.nodes[statement.left];
      if (defines(left) && is_number(names_.defined.at(left.name))) continue;
      if (!made_.summary_.empty()) made_.summary_ += ", ";
      bool comment = false;
      for (const char c : source_.at(statement.place)) {
        comment = c == '#' || (comment && c != '\n');
        const bool blank = comment || c == ' ' || c == '\n' || c == '\t' || c == '\r';
        if (!blank || made_.summary_.back() != ' ') made_.summary_ += blank ? ' ' : c;
      }
    }
  }

  static std::string no_component(const Equations& equations) {
    return fmt::format("no component of the state; these are {}",
                       quoted_input(fmt::format("{}", fmt::join(equations.component_names(), ", ")), 200));
  }
  // A number, unless parameters are variables.
  static NodeId initial_value(Equations& equations, Meaning& meaning, std::size_t root) {
    if (!equations.variables_.empty()) return meaning.expression(root);
    return equations.graph_.number(meaning.number(root, "an initial value"));
  }

 private:
  void check_name(const std::string& name, const Place& place) const {
    if (name == "t") throw source_.mistake(place, "t is reserved for the time");
    if (name == "pi") throw source_.mistake(place, "pi is reserved for 3.14159...");
  }
  void take_derivative(const Syntax& node) {
    check_name(node.name, node.place);
    if (node.primes > highest_order)
      throw source_.mistake(node.place, fmt::format("derivatives go up to order {}", highest_order));
    const auto [entry, is_new] =
        names_.numbers.try_emplace(node.name, static_cast<int>(names_.unknowns.size()));
    if (is_new) names_.unknowns.push_back({node.name, 0, node.place});
    Unknown& unknown = names_.unknowns[static_cast<std::size_t>(entry->second)];
    if (node.primes <= unknown.order) return;
    unknown.order = node.primes;
    unknown.place = node.place;
  }
  [[nodiscard]] bool defines(const Syntax& left) const {
    return left.kind == SyntaxKind::name && left.primes == 0 && !names_.numbers.contains(left.name);
  }
  [[nodiscard]] bool used(const std::string& name) const {
    return name != "t" && name != "pi" && !names_.numbers.contains(name) &&
           std::any_of(tree_.nodes.begin(), tree_.nodes.end(), [&](const Syntax& node) {
             return node.kind == SyntaxKind::name && node.name == name;
           });
  }
  static std::string unknown_setting(const std::string& name,
                                     const std::map<std::string, Place>& definitions) {
    std::vector<std::string> known;
    for (const auto& [defined, place] : definitions) known.push_back(defined);
    return fmt::format("--set {}: the equation has no such definition{}{}", quoted_input(name),
                       known.empty() ? "" : "; choose one of ",
                       quoted_input(fmt::format("{}", fmt::join(known, ", ")), 200));
  }
  [[nodiscard]] bool is_number(const LinearForm& form) const {
    return form.highest.empty() && made_.graph_.is_number(form.rest);
  }
  void add_parameter(const std::string& name, const LinearForm& form) {
    if (is_number(form)) made_.parameters_.emplace_back(name, made_.graph_[form.rest].c);
  }

  static bool is_time(const Syntax& node) { return node.name == "t" && node.primes == 0; }
  // Checks the conditions of definitions before these are used.
  void check_definitions(const Settings& settings) {
    for (const Condition& c : tree_.conditions) {
      const Syntax& left = tree_.nodes[c.left];
      if (left.kind != SyntaxKind::name)
        throw source_.mistake(left.place, "a condition must start with t, a component or a definition");
      if (is_time(left) || names_.component(left) >= 0) continue;
      const double value = meaning_.number(c.left, "the left side of a condition");
      check_condition(c, left.name, value, meaning_.number(c.right, "a bound"), settings);
    }
  }
  static bool is_upper(const Condition& c) {
    return c.relation == TokenKind::at_most || c.relation == TokenKind::below;
  }
  void take_end(const Condition& c, double end) {
    if (!is_upper(c))
      throw source_.mistake(c.place, "a condition on t must be an upper bound, the end: t <= 10");
    if (made_.final_time_) throw source_.mistake(c.place, "given twice");
    made_.final_time_ = end;
  }
  void take_bound(const Condition& c, std::size_t component, double bound) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (made_.lower_.empty()) {
      made_.lower_.assign(made_.state_names_.size(), -infinity);
      made_.upper_.assign(made_.state_names_.size(), infinity);
    }
    double& place = (is_upper(c) ? made_.upper_ : made_.lower_)[component];
    if (std::isfinite(place)) throw source_.mistake(c.place, "given twice");
    place = bound;
    if (!(made_.lower_[component] <= made_.upper_[component]))
      throw source_.mistake(c.place, "the lower bound is above the upper bound");
  }
  void check_condition(const Condition& c, const std::string& name, double value, double bound,
                       const Settings& settings) const {
    const bool holds = c.relation == TokenKind::at_least  ? value >= bound
                       : c.relation == TokenKind::at_most ? value <= bound
                       : c.relation == TokenKind::above   ? value > bound
                                                          : value < bound;
    if (holds) return;
    if (settings.contains(name))
      throw InputError(fmt::format("--set {}={:.6g}: the equations require {}", quoted_input(name), value,
                                   quoted_input(source_.at(c.place))));
    throw source_.mistake(c.place, fmt::format("this does not hold: {} is {:.6g}{}", quoted_input(name),
                                               value, settings.empty() ? "" : " with the values of --set"));
  }

  Equations& made_;
  Names& names_;
  const SourceText& source_;
  const SyntaxTree& tree_;
  Meaning meaning_;
  std::vector<Statement> equations_;
};

Equations::Equations(SourceText source, const Settings& settings, TableReader read_table)
    : source_(std::move(source)), tree_(parse(source_)), settings_(settings) {
  names_.read_table = std::move(read_table);
  EquationReader reader(*this);
  reader.find_unknowns();
  reader.name_components();
  reader.define(settings);
  reader.take_initial_values();
  reader.take_conditions();
  reader.solve();
  reader.take_conserved();
  reader.summarise();
}

Equations::Equations(const Equations& from, const std::vector<std::string>& variables)
    : source_(from.source_), tree_(from.tree_), settings_(from.settings_), variables_(variables) {
  names_.read_table = from.names_.read_table;
  EquationReader reader(*this);
  reader.find_unknowns();
  reader.name_components();
  reader.define(settings_);
  reader.take_initial_values();
  reader.solve();
}

bool Equations::second_order() const {
  return std::all_of(names_.unknowns.begin(), names_.unknowns.end(),
                     [](const Unknown& u) { return u.order == 2; });
}

NodeId Equations::expression(const std::string& name, const std::string& text) {
  const SourceText source(name, text);
  SyntaxTree tree;
  const bool is_equation =
      std::ranges::any_of(tokens_of(source, Separator::semicolon),
                          [](const Token& token) { return token.kind == TokenKind::equals; });
  if (!is_equation) {
    const std::size_t root = parse_expression(source, tree);
    return Meaning(graph_, names_, source, tree).expression(root);
  }
  tree = parse(source);
  if (tree.statements.size() != 1 || !tree.initial_values.empty() || !tree.conditions.empty() ||
      !tree.conserved.empty())
    throw source.mistake({0, text.size()}, "one expression, or one equation");
  Meaning meaning(graph_, names_, source, tree);
  const NodeId left = meaning.expression(tree.statements.front().left);
  return graph_.difference(left, meaning.expression(tree.statements.front().right));
}

double Equations::number(const std::string& name, const std::string& text) {
  const SourceText source(name, text);
  SyntaxTree tree;
  const std::size_t root = parse_expression(source, tree);
  return Meaning(graph_, names_, source, tree).number(root, "a time");
}

void Equations::read_columns(const std::string& name, const std::string& text, std::vector<Column>& columns) {
  const SourceText source(name, text);
  const SyntaxTree tree = parse_columns(source);
  Meaning meaning(graph_, names_, source, tree);
  for (const Statement& statement : tree.statements) {
    const Syntax& left = tree.nodes[statement.left];
    if (left.kind != SyntaxKind::name)
      throw source.mistake(left.place, "a column must be name = expression, or the name of a definition");
    if (statement.left == statement.right) continue;
    if (left.primes > 0 || left.name == "t" || left.name == "pi" || names_.numbers.contains(left.name) ||
        meaning.is_defined(left.name))
      throw source.mistake(left.place, fmt::format("{} is already defined; take another name",
                                                   with_primes(quoted_input(left.name), left.primes)));
    meaning.define(left.name, statement.right);
  }
  if (tree.statements.empty()) throw source.mistake({0, text.size()}, "no column is given");
  for (const Statement& statement : tree.statements) {
    const Syntax& left = tree.nodes[statement.left];
    const std::string column = with_primes(left.name, left.primes);
    const bool is_there = column == "t" || names_.component(left) >= 0 ||
                          std::ranges::any_of(columns, [&](const Column& c) { return c.name == column; });
    if (is_there)
      throw source.mistake(left.place, fmt::format("{} is a column already", quoted_input(column)));
    columns.push_back({column, with_highest_derivatives(meaning.form_of(statement.left))});
  }
}

NodeId Equations::with_highest_derivatives(const LinearForm& form) {
  NodeId all = form.rest;
  for (const auto& [number, coefficient] : form.highest) {
    const Unknown& u = names_.unknowns[static_cast<std::size_t>(number)];
    const int rate_of = names_.components.at({u.name, u.order - 1});
    all = graph_.sum(all, graph_.product(coefficient, slopes_[static_cast<std::size_t>(rate_of)]));
  }
  return all;
}

std::vector<int> Equations::initial_order(const std::string& text) const {
  std::vector<int> order;
  if (text.find('=') != std::string::npos) {
    const SourceText source("--initial", text);
    const SyntaxTree tree = parse(source, Separator::comma);
    for (const Statement& statement : tree.statements)
      order.push_back(names_.component(tree.nodes[statement.left]));
  }
  const auto size = static_cast<std::size_t>(layout_.size);
  if (order.size() != size) {
    order.clear();
    for (int i = 0; i < layout_.size; ++i) order.push_back(layout_.place(i));
  }
  for (int k = 1; k <= layout_.columns; ++k) {
    for (std::size_t i = 0; i < size; ++i) order.push_back(order[i] + layout_.shift(k));
  }
  return order;
}

Equations::InitialNodes Equations::initial_nodes(const std::string& name, const std::string& text) {
  // "x=1, x'=0"
  const SourceText source(name, text);
  const SyntaxTree tree = parse(source, Separator::comma);
  Meaning meaning(graph_, names_, source, tree);
  InitialNodes given(initial_.size());
  if (!tree.initial_values.empty())
    throw source.mistake(tree.initial_values.front().place,
                         "write initial values as x=1; --from gives the time");
  if (!tree.conditions.empty())
    throw source.mistake(tree.conditions.front().place, "write an initial value as x=1");
  if (!tree.conserved.empty())
    throw source.mistake(tree.nodes[tree.conserved.front()].place, "write an initial value as x=1");
  for (const Statement& statement : tree.statements) {
    const Syntax& left = tree.nodes[statement.left];
    const int component = left.kind == SyntaxKind::name ? names_.component(left) : -1;
    if (component < 0) throw source.mistake(left.place, EquationReader::no_component(*this));
    std::optional<NodeId>& value = given[static_cast<std::size_t>(component)];
    if (value) throw source.mistake(left.place, "given twice");
    value = EquationReader::initial_value(*this, meaning, statement.right);
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i]) given[i] = initial_[i];
  }
  return given;
}

std::vector<double> Equations::initial_state(const std::string& name, const std::string& text) {
  const InitialNodes given = initial_nodes(name, text);
  std::vector<double> x;
  std::vector<std::string> missing;
  for (int i = 0; i < layout_.size; ++i) {
    const std::size_t place = index(layout_.place(i));
    x.push_back(given[place] ? graph_[*given[place]].c : 0);
    if (!given[place]) missing.push_back(state_names_[place]);
  }
  if (missing.empty()) return with_sensitivities_of(x, name, text);
  const auto needs = std::find_if(names_.unknowns.begin(), names_.unknowns.end(), [&](const Unknown& u) {
    return missing.front().substr(0, missing.front().find('\'')) == u.name;
  });
  throw source_.mistake(needs->place,
                        fmt::format("an initial value is missing: {} {}=...", name,
                                    quoted_input(fmt::format("{}", fmt::join(missing, "=..., ")), 200)));
}

}  // namespace nlmech::program
