// Equations with the derivatives of their solution by initial values and parameters.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "nlmech/program/equations.hpp"
#include "nlmech/program/partials.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech::program {

struct Equations::Sensitivities {
  std::vector<int> components;      // of each column: the component by whose initial value; -1: a parameter
  std::vector<std::string> names;   // of the parameters, in the order of their columns
  std::vector<double> values;       // their values
  std::optional<Equations> varied;  // the equations with these parameters as variables after the state
  double scale = 1;                 // factor on all columns

  // Adds the component or parameter that is named.
  void add(const Equations& equations, const std::string& option, const std::string& name) {
    const auto component = std::ranges::find(equations.state_names(), name);
    if (component != equations.state_names().end()) {
      components.push_back(static_cast<int>(component - equations.state_names().begin()));
      return;
    }
    const auto known =
        std::ranges::find(equations.parameters(), name, &std::pair<std::string, double>::first);
    if (known == equations.parameters().end()) throw InputError(unknown(equations, option, name));
    components.push_back(-1);
    names.push_back(name);
    values.push_back(known->second);
  }
  static std::string unknown(const Equations& equations, const std::string& option, const std::string& name) {
    std::vector<std::string> all = equations.state_names();
    for (const auto& [parameter, value] : equations.parameters()) all.push_back(parameter);
    return fmt::format("{} {}: neither an initial value nor a parameter; choose from {}", option,
                       quoted_input(name), quoted_input(fmt::format("{}", fmt::join(all, ",")), 200));
  }

  // The variable of the parameter of a column; -1 for an initial value.
  [[nodiscard]] int variable(int column) const {
    if (components[index(column - 1)] >= 0) return -1;
    const auto end = components.begin() + column - 1;
    return varied->layout().size + static_cast<int>(std::count(components.begin(), end, -1));
  }
  // The derivatives of expressions of a copy of `varied` by the parameter of a column, times the scale, in
  // another graph with numbers for the parameters. @param variables of that graph: time and components
  [[nodiscard]] std::vector<NodeId> by_parameter(Graph from, const std::vector<NodeId>& ids, int column,
                                                 Graph& to, std::vector<NodeId> variables) const {
    std::vector<NodeId> made(ids.size(), to.number(0));
    if (variable(column) < 0) return made;
    for (const double value : values) variables.push_back(to.number(value));
    std::vector<NodeId> derivatives;
    for (const NodeId id : ids) derivatives.push_back(partials(from, id, variable(column), 1).front());
    made = substituted(from, derivatives, to, variables);
    for (NodeId& id : made) id = to.product(to.number(scale), id);
    return made;
  }

  // A switch whose place depends on a parameter would need the saltation by that parameter.
  void refuse_moving_switches(const std::string& option) const {
    const Graph& graph = varied->graph();
    const std::vector<bool> part = parts_of(graph, varied->slopes());
    for (NodeId i = 0; i < graph.nodes(); ++i) {
      if (!part[index(i)]) continue;
      const Node& n = graph[i];
      if (n.operation != Operation::choice && n.operation != Operation::floor) continue;
      const std::vector<bool> needed = parts_of(graph, {n.operation == Operation::choice ? n.decides : n.a});
      for (std::size_t j = 0; j < names.size(); ++j) {
        const std::size_t variable = index(Graph::state(varied->layout().size)) + j;
        if (variable < needed.size() && needed[variable])
          throw InputError(fmt::format(
              "{0} {1}: the equations switch where {1} decides, which is not supported for a parameter; make "
              "it a component, {1}' = 0 with {1}(0) = {2}, and ask for its initial value",
              option, quoted_input(names[j]), values[j]));
      }
    }
  }
};

std::vector<std::string> Equations::component_names() const {
  std::vector<std::string> names;
  for (int i = 0; i < layout_.size; ++i) names.push_back(state_names_[index(layout_.place(i))]);
  return names;
}

Equations Equations::with_sensitivities(const std::string& name, const std::vector<std::string>& of,
                                        double scale) const {
  auto all = std::make_shared<Sensitivities>();
  all->scale = scale;
  for (const std::string& column : of) {
    if (std::ranges::count(of, column) > 1)
      throw InputError(fmt::format("{}: {} is given twice", name, quoted_input(column)));
    all->add(*this, name, column);
  }
  if (!all->names.empty()) {
    all->varied = Equations(*this, all->names);
    all->refuse_moving_switches(name);
  }

  Equations made = *this;
  const VariationalLayout layout{layout_.size, static_cast<int>(of.size()), second_order()};
  made.layout_ = layout;
  std::vector<std::vector<NodeId>> forcing;
  Graph base = graph_;
  const VariationalLayout alone{layout_.size, 0, layout.second_order};
  for (int k = 1; k <= layout.columns; ++k) {
    const bool is_parameter = all->variable(k) >= 0;
    forcing.push_back(is_parameter ? all->by_parameter(all->varied->graph_, all->varied->slopes_, k, base,
                                                       alone.variables())
                                   : std::vector<NodeId>());
  }
  VariationalEquations variational = variational_equations(base, slopes_, layout, forcing);
  made.graph_ = std::move(variational.graph);
  made.slopes_ = std::move(variational.slopes);

  const std::vector<NodeId> variables = layout.variables();
  made.conserved_ = substituted(graph_, conserved_, made.graph_, variables);
  const auto move = [&](NodeId& id) { id = substituted(graph_, {id}, made.graph_, variables).front(); };
  for (auto& [defined, form] : made.names_.defined) {
    move(form.rest);
    for (auto& [unknown, coefficient] : form.highest) move(coefficient);
  }
  for (auto& [key, component] : made.names_.components) component = layout.place(component);

  const auto count = index(layout.all());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  made.state_names_.assign(count, "");
  made.initial_.assign(count, std::nullopt);
  if (!lower_.empty()) made.lower_.assign(count, -infinity);
  if (!upper_.empty()) made.upper_.assign(count, infinity);
  for (int i = 0; i < layout.size; ++i) {
    const std::size_t from = index(i), to = index(layout.place(i));
    if (initial_[from]) made.initial_[to] = made.graph_.number(graph_[*initial_[from]].c);
    if (!lower_.empty()) made.lower_[to] = lower_[from];
    if (!upper_.empty()) made.upper_[to] = upper_[from];
    for (int k = 0; k <= layout.columns; ++k) {
      std::string& column = made.state_names_[index(layout.place(i, k))];
      column = k == 0 ? state_names_[from] : fmt::format("d{}/d{}", state_names_[from], of[index(k - 1)]);
    }
  }
  made.sensitivities_ = std::move(all);
  return made;
}

std::vector<double> Equations::with_initial_sensitivities(const std::vector<double>& x) const {
  std::vector<double> all(index(layout_.all()));
  for (int i = 0; i < layout_.size; ++i) {
    all[index(layout_.place(i))] = x[index(i)];
    for (int k = 1; k <= layout_.columns; ++k) {
      if (sensitivities_->components[index(k - 1)] == i)
        all[index(layout_.place(i, k))] = sensitivities_->scale;
    }
  }
  return all;
}

// The same with values that depend on parameters by the text, or by `text` of initial_state().
std::vector<double> Equations::with_sensitivities_of(const std::vector<double>& x, const std::string& name,
                                                     const std::string& text) const {
  std::vector<double> all = with_initial_sensitivities(x);
  if (!sensitivities_ || !sensitivities_->varied) return all;
  Equations varied = *sensitivities_->varied;
  std::vector<NodeId> given;
  for (const std::optional<NodeId>& node : varied.initial_nodes(name, text)) given.push_back(node.value());
  Graph numbers(0);
  const std::vector<NodeId> none(index(layout_.size + 1), numbers.number(0));  // neither time nor state
  for (int k = 1; k <= layout_.columns; ++k) {
    const std::vector<NodeId> derivatives =
        sensitivities_->by_parameter(varied.graph_, given, k, numbers, none);
    for (int i = 0; i < layout_.size; ++i)
      all[index(layout_.place(i, k))] += numbers[derivatives[index(i)]].c;
  }
  return all;
}

Program Equations::change_at(const std::string& name, const std::string& event,
                             const std::vector<std::pair<int, std::string>>& changes) const {
  Equations here = *this;
  Graph& g = here.graph_;
  const VariationalLayout& layout = layout_;
  const std::vector<NodeId> variables = layout.variables();
  // g, then the components after the change; in the equations with varied parameters too.
  const auto expressions = [&](Equations& in, const VariationalLayout& places) {
    std::vector<NodeId> ids = {in.expression(name, event)};
    for (int i = 0; i < layout.size; ++i) {
      const auto changed = std::ranges::find(changes, layout.place(i), &std::pair<int, std::string>::first);
      ids.push_back(changed == changes.end() ? Graph::state(places.place(i))
                                             : in.expression(name, changed->second));
    }
    return ids;
  };
  const std::vector<NodeId> ids = expressions(here, layout), before = rates(g, ids, slopes_);
  std::vector<NodeId> all = variables, f, outputs(index(layout.all()));
  all.assign(index(layout.all() + 1), Graph::time());
  for (int i = 0; i < layout.size; ++i) {
    f.push_back(slopes_[index(layout.place(i))]);
    all[index(Graph::state(layout.place(i)))] = ids[index(i + 1)];
    outputs[index(layout.place(i))] = ids[index(i + 1)];
  }
  const std::vector<NodeId> after = substituted(g, f, g, all);
  std::optional<Equations> varied = sensitivities_ ? sensitivities_->varied : std::nullopt;
  std::vector<NodeId> varied_ids;
  if (varied) varied_ids = expressions(*varied, varied->layout_);
  const std::vector<std::vector<NodeId>> along = along_columns(g, ids, layout);
  for (int k = 1; k <= layout.columns; ++k) {
    std::vector<NodeId> d = along[index(k - 1)];
    if (varied) {
      const std::vector<NodeId> more =
          sensitivities_->by_parameter(varied->graph_, varied_ids, k, g, variables);
      for (std::size_t i = 0; i < d.size(); ++i) d[i] = g.sum(d[i], more[i]);
    }
    const NodeId earlier = g.quotient(d.front(), before.front());  // minus the change of the event's time
    for (int i = 0; i < layout.size; ++i) {
      const NodeId jump = g.difference(after[index(i)], before[index(i + 1)]);
      outputs[index(layout.place(i, k))] = g.sum(d[index(i + 1)], g.product(jump, earlier));
    }
  }
  return {g, outputs};
}

}  // namespace nlmech::program
