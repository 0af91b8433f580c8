#include "nlmech/bvp/typed/typed_control.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "nlmech/bvp/typed/conditions.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {

using Eigen::VectorXd;
using program::Equations;
using program::Function;
using program::Graph;
using program::NodeId;

namespace {

std::string without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

/// Parts of a text between separators outside brackets.
std::vector<std::string> parts_between(const std::string& text, std::string_view separators) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '(') - (c == ')');
    if (depth == 0 && separators.find(c) != std::string_view::npos)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (std::string& part : parts) part = without_blanks(part);
  std::erase(parts, std::string());
  return parts;
}

/// "a <= b"
struct Relation {
  std::string text, smaller, larger;
};

/// The relations of a chain: -1 <= u <= 1 has two.
std::vector<Relation> relations_of(const char* option, const std::string& text) {
  std::vector<Relation> all;
  for (const std::string& chain : parts_between(text, ",;\n")) {
    std::string rest = chain;
    const std::size_t before = all.size();
    for (;;) {
      const std::size_t at = rest.find_first_of("<>");
      if (at == std::string::npos) break;
      const bool rises = rest[at] == '<';
      const std::size_t right = at + (rest.substr(at + 1, 1) == "=" ? 2 : 1);
      const std::string left = without_blanks(rest.substr(0, at)), more = without_blanks(rest.substr(right));
      const std::string next = without_blanks(more.substr(0, more.find_first_of("<>")));
      if (left.empty() || next.empty()) break;
      all.push_back({fmt::format("{} {} {}", left, rises ? "<=" : ">=", next), rises ? left : next,
                     rises ? next : left});
      rest = more;
    }
    if (all.size() == before)
      throw input_error("{} {}: is no bound; give one such as -1 <= u <= 1", option, quoted_input(chain));
  }
  return all;
}

/// The equations, with u' = 0 for each control, and the conditions among them.
DividedText divided_text(const ControlText& text, const std::string& end_name) {
  if (text.controls.empty()) throw InputError("--control: give the name of a control");
  std::vector<std::string> constants = text.controls;
  if (!end_name.empty()) {
    if (std::ranges::find(constants, end_name) != constants.end())
      throw input_error("--until {}: is a control; a free end needs another name", end_name);
    constants.push_back(end_name);
  }
  DividedText divided = divide(text.name, text.equations, constants);
  for (const std::string& name : constants) divided.equations += fmt::format("\n{}' = 0", name);
  return divided;
}

}  // namespace

TypedControl::TypedControl(const ControlText& text)
    : text_(text),
      end_name_(free_end_name(text.equations, text.settings, text.until)),
      equations_(equations_of(text.name, text.equations, divided_text(text, end_name_), text.settings)) {
  if (equations_.initial_time() || equations_.final_time() || !equations_.lower_bounds().empty())
    throw input_error("{}: give times and bounds by --conditions, --until, --bounds and --state-bounds",
                      text.name);
  const auto& names = equations_.state_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto component = static_cast<int>(i);
    if (names[i] == end_name_) {
      end_component_ = component;
    } else if (std::ranges::find(text.controls, names[i]) == text.controls.end()) {
      states_.push_back(component);
      state_names_.push_back(names[i]);
    }
  }
  for (const std::string& name : text.controls)
    controls_.push_back(static_cast<int>(std::ranges::find(names, name) - names.begin()));
  problem_.states = static_cast<int>(states_.size()) + (has_free_end() ? 1 : 0);
  const std::vector<NodeId> state_bounds = read_bounds();
  std::vector<ConditionText> conditions = divided_text(text, end_name_).conditions;
  for (const ConditionText& condition : conditions_of("--conditions", text.conditions))
    conditions.push_back(condition);
  const std::vector<Integral> integrals = read_ends(conditions);
  set_expressions(state_bounds, integrals);
  check_controls();
}

/// Refuses bounds on which no control acts, and controls that nothing determines.
void TypedControl::check_controls() const {
  std::optional<NecessaryConditions> necessary;
  try {
    necessary.emplace(problem_);
  } catch (const std::invalid_argument& error) {
    throw input_error("--state-bounds {}: {}", quoted_input(text_.state_bounds), error.what());
  }
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    if (necessary->linear[i] && !std::isfinite(problem_.high[i] - problem_.low[i]))
      throw input_error(
          "--control {}: equations and cost are linear in it, so it has no least cost between bounds; give "
          "both "
          "by --bounds",
          quoted_input(text_.controls[i]));
  }
}

/// Sets f, L and S in the variables of the problem: with a free end, time and slopes are scaled.
void TypedControl::set_expressions(const std::vector<NodeId>& state_bounds,
                                   const std::vector<Integral>& integrals) {
  problem_.graph = Graph(problem_.states + static_cast<int>(controls_.size()));
  Graph& graph = problem_.graph;
  NodeId rate = graph.number(1);
  std::vector<NodeId> variables(equations_.state_names().size() + 1, Graph::time());
  if (has_free_end()) {
    const NodeId log_length = Graph::state(problem_.states - 1), from = graph.number(from_);
    rate = graph.call(Function::exp, log_length, log_length);
    variables[0] = graph.sum(from, graph.product(rate, Graph::time()));
    variables[program::index(end_component_ + 1)] = graph.sum(from, rate);
  }
  for (std::size_t i = 0; i < states_.size(); ++i)
    variables[program::index(states_[i] + 1)] = Graph::state(static_cast<int>(i));
  for (std::size_t i = 0; i < controls_.size(); ++i)
    variables[program::index(controls_[i] + 1)] = Graph::state(problem_.states + static_cast<int>(i));
  std::vector<NodeId> ids;
  for (const int i : states_) ids.push_back(equations_.slopes()[program::index(i)]);
  for (const Integral& integral : integrals) ids.push_back(integral.integrand);
  ids.insert(ids.end(), state_bounds.begin(), state_bounds.end());
  refuse_switches(ids);
  const std::vector<NodeId> made = substituted(equations_.graph(), ids, graph, variables);
  auto next = made.begin();
  for (std::size_t i = 0; i < states_.size(); ++i) problem_.slopes.push_back(graph.product(rate, *next++));
  if (has_free_end()) problem_.slopes.push_back(graph.number(0));
  NodeId cost = graph.number(0);
  for (const Integral& integral : integrals)
    cost = graph.sum(cost, graph.product(graph.number(integral.factor), *next++));
  problem_.running_cost = graph.product(rate, cost);
  for (; next != made.end(); next += 2) problem_.state_bounds.push_back(graph.difference(next[0], next[1]));
}

void TypedControl::refuse_switches(const std::vector<NodeId>& ids) const {
  const std::vector<bool> part = parts_of(equations_.graph(), ids);
  for (NodeId i = 0; i < equations_.graph().nodes(); ++i) {
    const program::Operation operation = equations_.graph()[i].operation;
    if (part[program::index(i)] &&
        (operation == program::Operation::choice || operation == program::Operation::floor))
      throw input_error(
          "{}: abs, sign, min, max, if and floor have no derivative where they switch; write abs(u) as the "
          "sum "
          "of two controls, each at least 0, a bound by --bounds or --state-bounds",
          text_.name);
  }
}

/// Sets the bounds of controls. @return both sides of each bound on states, the smaller one first
std::vector<NodeId> TypedControl::read_bounds() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  problem_.low.assign(text_.controls.size(), -infinity);
  problem_.high.assign(text_.controls.size(), infinity);
  for (const Relation& relation : relations_of("--bounds", text_.bounds)) {
    const auto larger = std::ranges::find(text_.controls, relation.larger);
    const auto smaller = std::ranges::find(text_.controls, relation.smaller);
    if ((larger == text_.controls.end()) == (smaller == text_.controls.end()))
      throw input_error(
          "--bounds {}: must bound one control ({}) by a number; bounds on states are --state-bounds",
          quoted_input(relation.text), quoted_input(fmt::format("{}", fmt::join(text_.controls, ", "))));
    if (larger != text_.controls.end()) {
      double& low = problem_.low[static_cast<std::size_t>(larger - text_.controls.begin())];
      low = std::max(low, equations_.number("--bounds", relation.smaller));
    } else {
      double& high = problem_.high[static_cast<std::size_t>(smaller - text_.controls.begin())];
      high = std::min(high, equations_.number("--bounds", relation.larger));
    }
  }
  for (std::size_t i = 0; i < text_.controls.size(); ++i) {
    if (!(problem_.low[i] < problem_.high[i]))
      throw input_error("--bounds: the lower bound {:.6g} of {} is not below the upper bound {:.6g}",
                        problem_.low[i], text_.controls[i], problem_.high[i]);
  }
  std::vector<NodeId> state_bounds;
  for (const Relation& relation : relations_of("--state-bounds", text_.state_bounds)) {
    state_bounds.push_back(equations_.expression("--state-bounds", relation.smaller));
    state_bounds.push_back(equations_.expression("--state-bounds", relation.larger));
    bound_texts_.push_back(relation.text);
  }
  return state_bounds;
}

/// The time and the components of the equations at a point, as nodes of problem_.ends; NaN for controls.
std::vector<NodeId> TypedControl::point_variables(int point) {
  Graph& ends = problem_.ends;
  const int n = problem_.states;
  std::vector<NodeId> variables(equations_.state_names().size() + 1, ends.number(std::nan("")));
  for (std::size_t i = 0; i < states_.size(); ++i)
    variables[program::index(states_[i] + 1)] = Graph::state(point * n + static_cast<int>(i));
  variables[0] = ends.number(problem_.points[program::index(point)]);
  if (!has_free_end()) return variables;
  const NodeId log_length = Graph::state(point * n + n - 1), from = ends.number(from_);
  const NodeId end = ends.sum(from, ends.call(Function::exp, log_length, log_length));
  variables[program::index(end_component_ + 1)] = end;
  variables[0] = point == 0 ? from : end;
  return variables;
}

/// The interval as typed, otherwise from the first to the last time of a value.
void TypedControl::set_interval(const Conditions& read) {
  from_ = std::numeric_limits<double>::infinity();
  until_ = -from_;
  for (const Conditions::Value& value : read.values()) {
    if (std::isinf(value.time)) continue;
    from_ = std::min(from_, value.time);
    until_ = std::max(until_, value.time);
  }
  if (!text_.from.empty()) from_ = equations_.number("--from", text_.from);
  if (!text_.until.empty() && !has_free_end()) until_ = equations_.number("--until", text_.until);
  if (!std::isfinite(from_)) throw InputError("--from: no condition has a time; give the start");
  if (!has_free_end() && !(from_ < until_))
    throw input_error("--until {:.6g}: must be later than the start {:.6g}", until_, from_);
}

std::vector<TypedControl::Integral> TypedControl::read_ends(const std::vector<ConditionText>& conditions) {
  std::vector<ConditionText> all = conditions;
  for (const ConditionText& condition : conditions) condition_texts_.push_back(condition.text);
  all.push_back({"--minimise", text_.minimise});
  const Conditions read(equations_, all, end_name_);
  set_interval(read);
  std::set<double> points{from_, until_};
  if (has_free_end()) points = {0, 1};
  const auto time_of = [&](double time) {
    if (std::isinf(time)) return has_free_end() ? 1 : until_;
    return has_free_end() && time == from_ ? 0 : time;
  };
  for (const Conditions::Value& value : read.values()) {
    const double time = time_of(value.time);
    const bool is_inside = !has_free_end() && time > from_ && time < until_;
    if (is_inside) points.insert(time);
    if (!is_inside && !points.contains(time))
      throw input_error("--conditions: the time {:.6g} of a value is not {}", value.time,
                        has_free_end() ? fmt::format("the start {:.6g} or the free end {}", from_, end_name_)
                                       : fmt::format("from {:.6g} to {:.6g}", from_, until_));
  }
  problem_.points.assign(points.begin(), points.end());
  problem_.ends = Graph(static_cast<int>(points.size()) * problem_.states);
  // The arguments of the conditions as expressions of the states at the points.
  std::vector<NodeId> arguments{Graph::time()};
  for (const Conditions::Value& value : read.values()) {
    const auto point = std::ranges::find(problem_.points, time_of(value.time)) - problem_.points.begin();
    const std::vector<bool> part = parts_of(equations_.graph(), {value.what});
    for (std::size_t i = 0; i < controls_.size(); ++i) {
      if (part[program::index(Graph::state(controls_[i]))])
        throw input_error("--conditions: the control {} can jump, so it cannot be prescribed at a time",
                          text_.controls[i]);
    }
    arguments.push_back(
        substituted(equations_.graph(), {value.what}, problem_.ends, point_variables(static_cast<int>(point)))
            .front());
  }
  for (std::size_t k = 0; k < read.integrands().size(); ++k) arguments.push_back(problem_.ends.number(0));
  const std::vector<NodeId> last = point_variables(static_cast<int>(points.size()) - 1);
  for (const int i : read.constants()) arguments.push_back(last[program::index(i + 1)]);
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    const NodeId node = read.residual_nodes()[k];
    const std::vector<bool> part = parts_of(read.residual_graph(), {node});
    for (std::size_t i = 0; i < read.integrands().size(); ++i) {
      if (part[read.values().size() + i + 1])
        throw input_error(
            "--conditions {}: instead of an integral give an equation y' = integrand, and y at both ends",
            quoted_input(conditions[k].text));
    }
    problem_.conditions.push_back(
        substituted(read.residual_graph(), {node}, problem_.ends, arguments).front());
  }
  return read_cost(read, arguments);
}

std::vector<TypedControl::Integral> TypedControl::read_cost(const Conditions& read,
                                                            const std::vector<NodeId>& arguments) {
  Graph residuals = read.residual_graph();
  const NodeId cost = read.residual_nodes().back();
  for (std::size_t i = 0; i < read.constants().size(); ++i) {
    const bool is_control = std::ranges::find(controls_, read.constants()[i]) != controls_.end();
    const std::size_t argument = read.values().size() + read.integrands().size() + i + 1;
    for (const NodeId node : read.residual_nodes()) {
      if (is_control && parts_of(residuals, {node})[argument])
        throw input_error("{}: a control has to stand in an integral",
                          node == cost ? "--minimise" : "--conditions");
    }
  }
  std::vector<Integral> integrals;
  const std::vector<NodeId> slopes = partials(residuals, cost, static_cast<int>(read.values().size()),
                                              static_cast<int>(read.integrands().size()));
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (!residuals.is_number(slopes[i]))
      throw input_error("--minimise {}: the factor of an integral has to be a number",
                        quoted_input(text_.minimise));
    integrals.push_back({residuals[slopes[i]].c, read.integrands()[i]});
  }
  problem_.end_cost = substituted(residuals, {cost}, problem_.ends, arguments).front();
  return integrals;
}

std::pair<double, double> TypedControl::true_time(double s, const VectorXd& x) const {
  if (!has_free_end()) return {s, 1};
  const double length = std::exp(x[problem_.states - 1]);
  return {from_ + length * s, length};
}

std::vector<ControlGuess> TypedControl::guesses(const std::string& guess) const {
  VectorXd begin = VectorXd::Zero(problem_.states);
  Equations equations = equations_;
  std::map<std::size_t, Expressions> functions;
  double length = has_free_end() ? 1 : until_ - from_;
  bool gives_end = false;
  const VectorXd zero = VectorXd::Zero(equations.size());
  for (const std::string& part : parts_between(guess, ",;\n")) {
    const std::size_t equals = part.find('=');
    const std::string name = without_blanks(part.substr(0, equals));
    const auto state = std::ranges::find(state_names_, name);
    const auto control = std::ranges::find(text_.controls, name);
    if (equals == std::string::npos || (state == state_names_.end() && control == text_.controls.end() &&
                                        (name != end_name_ || !has_free_end())))
      throw input_error("--guess {}: must begin with a control, a state or the free end, and =",
                        quoted_input(part));
    const std::string value = part.substr(equals + 1);
    const NodeId node = equations.expression("--guess", value);
    const Expressions function(equations.graph(), {node});
    const double at_start = function.values(from_, zero)[0];
    if (!std::isfinite(at_start))
      throw input_error("--guess {}: must be a finite function of t", quoted_input(part));
    if (control != text_.controls.end())
      functions[static_cast<std::size_t>(control - text_.controls.begin())] = function;
    else if (state != state_names_.end())
      begin[state - state_names_.begin()] = at_start;
    else {
      length = at_start - from_;
      gives_end = true;
    }
  }
  if (!(length > 0))
    throw input_error("--guess: the end {} must be later than the start {:.6g}", end_name_, from_);
  std::vector<double> lengths{length};
  if (has_free_end() && !gives_end) lengths = {1, 3, 10, 0.3, 30};
  if (functions.empty()) {
    std::vector<ControlGuess> automatic;
    double size = 1;
    for (const PrescribedValue& value : prescribed_values(problem_))
      size = std::max(size, std::abs(value.value));
    for (const double one : lengths) {
      if (has_free_end()) begin[problem_.states - 1] = std::log(one);
      std::vector<ControlGuess> more = control_guesses(problem_, begin, size / one);
      // Several lengths with few controls, or one with many.
      if (lengths.size() > 1) more.resize(3);
      automatic.insert(automatic.end(), more.begin(), more.end());
    }
    return automatic;
  }
  if (has_free_end()) begin[problem_.states - 1] = std::log(length);
  const auto typed = [this, functions, zero, length](double s, VectorXd& u) {
    const double t = has_free_end() ? from_ + s * length : s;
    u.setZero();
    for (const auto& [i, function] : functions) u[static_cast<Eigen::Index>(i)] = function.values(t, zero)[0];
  };
  return {{begin, typed}};
}

}  // namespace nlmech::bvp
