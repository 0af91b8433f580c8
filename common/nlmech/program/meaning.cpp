#include "nlmech/program/meaning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "nlmech/support/quoted_input.hpp"

namespace nlmech::program {

std::string with_primes(const std::string& name, int primes) {
  return name + std::string(static_cast<std::size_t>(primes), '\'');
}

int Names::component(const Syntax& node) const {
  const auto place = components.find({node.name, node.primes});
  return place == components.end() ? -1 : place->second;
}
std::string Names::highest() const {
  std::vector<std::string> all;
  for (const Unknown& u : unknowns) all.push_back(with_primes(u.name, u.order));
  return fmt::format("{}", fmt::join(all, ", "));
}

const LinearForm& Meaning::definition(const std::string& name, const Place& place) {
  const auto known = names_.defined.find(name);
  if (known != names_.defined.end()) return known->second;
  if (!open_.emplace(name, true).second)
    throw source_.mistake(place, fmt::format("the definition of {} depends on itself", quoted_input(name)));
  LinearForm form = form_of(definitions_.at(name));
  open_.erase(name);
  return names_.defined.emplace(name, std::move(form)).first->second;
}

NodeId Meaning::expression(std::size_t node) {
  const LinearForm form = form_of(node);
  if (form.highest.empty()) return form.rest;
  const Unknown& u = names_.unknowns[static_cast<std::size_t>(form.highest.begin()->first)];
  throw source_.mistake(tree_.nodes[node].place,
                        fmt::format("{} is not allowed here: it is not a component of the state",
                                    with_primes(u.name, u.order)));
}

double Meaning::number(std::size_t node, std::string_view what) {
  const LinearForm form = form_of(node);
  if (!form.highest.empty() || !graph_.is_number(form.rest))
    throw source_.mistake(tree_.nodes[node].place,
                          fmt::format("{} must be a number, or an expression of constants", what));
  return graph_[form.rest].c;
}

LinearForm Meaning::form_of(std::size_t index) {
  const Syntax& node = tree_.nodes[index];
  if (++depth_ > most_depth) throw source_.mistake(node.place, "definitions are nested too deeply here");
  LinearForm form = meaning(node);
  handled_ += form.highest.size();
  if (graph_.nodes() > most_operations || handled_ > most_operations)
    throw source_.mistake(node.place,
                          fmt::format("the equations have more than {} operations", most_operations));
  check_numbers(form, node);
  --depth_;
  return form;
}
// Numbers that are not finite are mistakes: 1/0, sqrt(-1), exp(1000).
void Meaning::check_numbers(const LinearForm& form, const Syntax& node) const {
  const auto check = [&](NodeId id) {
    if (!graph_.is_number(id) || std::isfinite(graph_[id].c)) return;
    throw source_.mistake(node.place,
                          std::isnan(graph_[id].c)
                              ? "the result is not a real number"
                              : "the result is infinite, or beyond the range of double precision");
  };
  check(form.rest);
  for (const auto& [unknown, coefficient] : form.highest) check(coefficient);
}

LinearForm Meaning::meaning(const Syntax& node) {
  switch (node.kind) {
    case SyntaxKind::number: return {graph_.number(node.number), {}};
    case SyntaxKind::name: return name(node);
    case SyntaxKind::negative: return scaled(form_of(node.operands[0].node), graph_.number(-1));
    case SyntaxKind::sum: return sum(node);
    case SyntaxKind::product: return product(node);
    case SyntaxKind::power: return power(node);
    default: return call(node);
  }
}

LinearForm Meaning::name(const Syntax& node) {
  const auto found = names_.numbers.find(node.name);
  if (found != names_.numbers.end()) {
    const int component = names_.component(node);
    if (component >= 0) return {Graph::state(component), {}};
    const Unknown& unknown = names_.unknowns[static_cast<std::size_t>(found->second)];
    if (node.primes == unknown.order) return {graph_.number(0), {{found->second, graph_.number(1)}}};
    throw source_.mistake(node.place,
                          fmt::format("{} is of order {} in the equations", node.name, unknown.order));
  }
  if (node.primes > 0)
    throw source_.mistake(node.place,
                          fmt::format("{} is no unknown of the equations", quoted_input(node.name)));
  if (node.name == "t") return {Graph::time(), {}};
  if (node.name == "pi") return {graph_.number(std::numbers::pi), {}};
  if (is_defined(node.name)) return definition(node.name, node.place);
  throw source_.mistake(node.place, unknown_name(node.name));
}
std::string Meaning::unknown_name(const std::string& name) const {
  const std::string shown = quoted_input(name);
  if (name == "e") return "e is not defined; write exp(1), or exp(x) for e^x";
  for (std::size_t cut = 1; cut < std::min<std::size_t>(name.size(), 60); ++cut) {
    const std::string a = name.substr(0, cut), b = name.substr(cut);
    if (is_known_name(a) && is_known_name(b))
      return fmt::format("{} is not defined; a product is written {} {}", shown, a, b);
  }
  return fmt::format("{0} is not defined: it has neither a derivative ({0}') nor a definition ({0} = ...)",
                     shown);
}
bool Meaning::is_known_name(const std::string& name) const {
  return name == "t" || name == "pi" || names_.numbers.contains(name) || is_defined(name);
}

void Meaning::add(LinearForm& to, const LinearForm& what, bool subtract) {
  Graph& g = graph_;
  to.rest = subtract ? g.difference(to.rest, what.rest) : g.sum(to.rest, what.rest);
  for (const auto& [unknown, coefficient] : what.highest) {
    const auto [entry, is_new] = to.highest.try_emplace(unknown, g.number(0));
    entry->second = subtract ? g.difference(entry->second, coefficient) : g.sum(entry->second, coefficient);
    if (g.is_number(entry->second, 0)) to.highest.erase(entry);
  }
}
LinearForm Meaning::scaled(LinearForm form, NodeId factor, bool divide) {
  const auto apply = [&](NodeId& node) {
    node = divide ? graph_.quotient(node, factor) : graph_.product(factor, node);
  };
  apply(form.rest);
  for (auto& [unknown, coefficient] : form.highest) apply(coefficient);
  std::erase_if(form.highest, [&](const auto& entry) { return graph_.is_number(entry.second, 0); });
  return form;
}
LinearForm Meaning::sum(const Syntax& node) {
  LinearForm all = form_of(node.operands[0].node);
  for (std::size_t i = 1; i < node.operands.size(); ++i)
    add(all, form_of(node.operands[i].node), node.operands[i].inverse);
  return all;
}
LinearForm Meaning::product(const Syntax& node) {
  LinearForm all = form_of(node.operands[0].node);
  for (std::size_t i = 1; i < node.operands.size(); ++i) {
    const auto [operand, divisor] = node.operands[i];
    LinearForm factor = form_of(operand);
    handled_ += all.highest.size();
    if (divisor && factor.highest.empty() && graph_.is_number(factor.rest, 0))
      throw source_.mistake(tree_.nodes[operand].place, "a division by zero");
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
LinearForm Meaning::power(const Syntax& node) {
  LinearForm base = form_of(node.operands[0].node);
  const LinearForm exponent = form_of(node.operands[1].node);
  if (!exponent.highest.empty()) throw nonlinear(node.operands[1].node, exponent, "in an exponent");
  if (base.highest.empty()) return {graph_.power(base.rest, exponent.rest), {}};
  if (graph_.is_number(exponent.rest, 1)) return base;
  throw nonlinear(node.operands[0].node, base, "in a power");
}
NodeId Meaning::argument(std::size_t node) {
  const LinearForm form = form_of(node);
  if (!form.highest.empty()) throw nonlinear(node, form, "in a function");
  return form.rest;
}
LinearForm Meaning::call(const Syntax& node) {
  if (node.function == Function::choose) return choose(node);
  if (node.function == Function::table || node.function == Function::stepped_table) return {table(node), {}};
  std::vector<NodeId> arguments;
  for (const Syntax::Operand& operand : node.operands) arguments.push_back(argument(operand.node));
  const bool is_zero = graph_.is_number(arguments.back(), 0);
  if (node.function == Function::mod && (is_zero || !graph_.is_number(arguments.back())))
    throw source_.mistake(tree_.nodes[node.operands[1].node].place,
                          "the second argument of mod must be a number other than 0");
  return {graph_.call(node.function, arguments.front(), arguments.back()), {}};
}
NodeId Meaning::table(const Syntax& node) {
  if (!names_.read_table) throw source_.mistake(node.place, "tables are not supported here");
  Table table = names_.read_table(node.name);
  table.stepped = node.function == Function::stepped_table;
  names_.earliest = std::max(names_.earliest, table.times.front());
  names_.latest = std::min(names_.latest, table.times.back());
  return graph_.table(table);
}
LinearForm Meaning::choose(const Syntax& node) {
  const NodeId yes = argument(node.operands[1].node), no = argument(node.operands[2].node);
  return {where(node.operands[0].node, yes, no), {}};
}
NodeId Meaning::where(std::size_t condition, NodeId yes, NodeId no) {
  const Syntax& node = tree_.nodes[condition];
  const std::vector<Syntax::Operand>& all = node.operands;
  if (node.kind == SyntaxKind::opposite) return where(all[0].node, no, yes);
  if (node.kind == SyntaxKind::comparison) {
    NodeId greater = argument(all[0].node), less = argument(all[1].node);
    const bool is_less = node.relation == TokenKind::below || node.relation == TokenKind::at_most;
    if (is_less) std::swap(greater, less);
    const bool strict = node.relation == TokenKind::below || node.relation == TokenKind::above;
    return graph_.where(graph_.difference(greater, less), strict, yes, no);
  }
  NodeId result = node.kind == SyntaxKind::both ? yes : no;
  for (std::size_t i = all.size(); i-- > 0;)
    result = node.kind == SyntaxKind::both ? where(all[i].node, result, no) : where(all[i].node, yes, result);
  return result;
}
InputError Meaning::nonlinear(std::size_t node, const LinearForm& form, std::string_view where) const {
  const Unknown& u = names_.unknowns[static_cast<std::size_t>(form.highest.begin()->first)];
  return source_.mistake(
      tree_.nodes[node].place,
      fmt::format("{} is {}; a highest derivative must occur linearly", with_primes(u.name, u.order), where));
}

}  // namespace nlmech::program
