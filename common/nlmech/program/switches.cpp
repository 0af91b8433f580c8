#include "nlmech/program/switches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "nlmech/program/domain.hpp"
#include "nlmech/program/highest_derivatives.hpp"

namespace nlmech::program {
namespace {

/// Sliding motion on surfaces: the shares of the jumps that keep all functions zero.
class Sliding {
 public:
  /// @param values of the lower side of each surface: the slopes, then further expressions
  /// @param deciding the functions
  Sliding(Graph& graph, std::vector<NodeId> values, std::vector<NodeId> deciding)
      : graph_(graph),
        values_(std::move(values)),
        deciding_(std::move(deciding)),
        fall_(rates(graph_, deciding_, slopes_of(values_))) {}

  /// Adds a surface with the values of its upper side.
  void add(std::size_t surface, const std::vector<NodeId>& upper) {
    surfaces_.push_back(surface);
    rises_.push_back(rates(graph_, deciding_, slopes_of(upper)));
    jumps_.emplace_back();
    for (std::size_t i = 0; i < upper.size(); ++i)
      jumps_.back().push_back(graph_.difference(upper[i], values_[i]));
  }
  /// The share of each surface.
  std::vector<NodeId> shares() {
    HighestDerivatives system(graph_, static_cast<int>(surfaces_.size()));
    for (const std::size_t row : surfaces_) {
      LinearEquation equation{fall_[row], {}};
      for (std::size_t k = 0; k < surfaces_.size(); ++k) {
        const NodeId change = graph_.difference(rises_[k][row], fall_[row]);
        if (!graph_.is_number(change, 0)) equation.highest.emplace(static_cast<int>(k), change);
      }
      system.add(std::move(equation));
    }
    try {
      return system.solve([](int, std::string_view sentence) { return InputError(std::string(sentence)); });
    } catch (const InputError&) {
      return std::vector<NodeId>(surfaces_.size(), graph_.number(std::nan("")));
    }
  }
  /// The values with these shares.
  std::vector<NodeId> values(const std::vector<NodeId>& shares) {
    for (std::size_t k = 0; k < shares.size(); ++k) {
      for (std::size_t i = 0; i < values_.size(); ++i)
        values_[i] = graph_.sum(values_[i], graph_.product(shares[k], jumps_[k][i]));
    }
    return values_;
  }

 private:
  [[nodiscard]] std::vector<NodeId> slopes_of(const std::vector<NodeId>& values) const {
    return {values.begin(), values.begin() + graph_.size()};
  }

  Graph& graph_;
  std::vector<NodeId> values_, deciding_, fall_;
  std::vector<std::size_t> surfaces_;
  std::vector<std::vector<NodeId>> rises_, jumps_;
};

/// The time c of a switching function t - c; none for other functions.
std::optional<double> time_of(const Graph& graph, NodeId decides) {
  const Node& n = graph[decides];
  if (decides == Graph::time()) return 0;
  if (n.operation == Operation::shifted && n.a == Graph::time()) return -n.c;
  return {};
}

/// Marks nodes that change at choices and at jumps of floor only, as sign(x): if one of them is a switching
/// function, the choices and jumps that it depends on are the switches.
std::vector<bool> constant_between_switches(const Graph& graph) {
  std::vector<bool> constant(static_cast<std::size_t>(graph.nodes()));
  for (NodeId i = 0; i < graph.nodes(); ++i) {
    const Node& n = graph[i];
    const bool is_variable = n.operation == Operation::variable;
    const bool is_jump = n.operation == Operation::floor && std::isnan(graph.drift(n.a));
    constant[index(i)] = n.operation == Operation::number || is_jump ||
                         (!is_variable && constant[index(n.a)] && constant[index(n.b)]);
  }
  return constant;
}

}  // namespace

Switches::Switches(const Graph& graph, const std::vector<NodeId>& slopes, const std::vector<NodeId>& further)
    : graph_(graph), slopes_(slopes), further_(further) {
  const std::vector<bool> part = parts_of(graph_, slopes_), constant = constant_between_switches(graph_);
  for (NodeId i = 0; index(i) < part.size(); ++i) {
    if (!part[index(i)]) continue;
    if (graph_[i].operation == Operation::floor) {
      const NodeId a = graph_[i].a;
      if (!std::isnan(graph_.drift(a)))
        timed_.push_back(i);
      else if (!constant[index(a)])
        add_rounding(i);
    }
    if (graph_[i].operation == Operation::table) {
      const Table& table = *graph_.tables()[static_cast<std::size_t>(graph_[i].c)];
      times_.insert(times_.end(), table.times.begin(), table.times.end());
    }
    if (graph_[i].operation != Operation::choice) continue;
    const NodeId decides = graph_[i].decides;
    if (constant[index(decides)]) continue;
    if (const std::optional<double> time = time_of(graph_, decides)) {
      times_.push_back(*time);
    } else if (!std::isnan(graph_.drift(decides))) {
      timed_.push_back(decides);
    } else if (function_of(decides, false) == deciding_.size()) {
      deciding_.push_back(decides);
      rounded_.push_back(false);
    }
  }
  const auto sort_once = [](auto& all) {
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  sort_once(times_);
  sort_once(timed_);
  timed_values_ = Program(graph_, timed_);
}

// floor(x) and floor(-x), which is in ceil(x), have one switching function.
void Switches::add_rounding(NodeId node) {
  const NodeId a = graph_[node].a, opposite = graph_.negative(a);
  const std::size_t of_opposite = function_of(opposite, true), known = function_of(a, true);
  const bool is_of_opposite = of_opposite < deciding_.size();
  if (!is_of_opposite && known == deciding_.size()) {
    deciding_.push_back(a);
    rounded_.push_back(true);
  }
  roundings_.emplace(node, Rounding{is_of_opposite ? of_opposite : known, is_of_opposite});
}
// The number of functions if there is none.
std::size_t Switches::function_of(NodeId node, bool rounded) const {
  std::size_t i = 0;
  while (i < deciding_.size() && (deciding_[i] != node || rounded_[i] != rounded)) ++i;
  return i;
}

// A value that is constant between two jumps: the rounded value, or the sign of the switching function.
double Switches::step_value(std::size_t k, double t) const {
  double value = 0;
  struct NoState {
    double operator[](int) const { return 0; }
  };
  timed_values_.run(t, NoState{}, k, k + 1, [&](int, double v) { value = v; });
  return graph_[timed_[k]].operation == Operation::floor ? value : value >= 0 ? 1 : 0;
}

std::vector<double> Switches::times(double from, double to) const {
  std::vector<double> all;
  for (const double t : times_) {
    if (t > from && t < to) all.push_back(t);
  }
  // A node is monotonic between the jumps of its operands, which precede it.
  for (std::size_t k = 0; k < timed_.size(); ++k) {
    std::vector<double> jumps;
    double begin = from;
    for (const double end : all) {
      add_jumps(k, begin, std::nextafter(end, from), jumps);
      begin = end;
    }
    add_jumps(k, begin, std::nextafter(to, from), jumps);
    all.insert(all.end(), jumps.begin(), jumps.end());
    std::sort(all.begin(), all.end());
  }
  return all;
}

void Switches::add_jumps(std::size_t k, double begin, double last, std::vector<double>& jumps) const {
  constexpr double most = 1e6;
  if (!(begin < last)) return;
  const double end_value = step_value(k, last);
  double value = step_value(k, begin);
  if (!(std::abs(end_value - value) + static_cast<double>(jumps.size()) <= most))
    throw std::invalid_argument("floor, ceil, frac or mod jump more than a million times before this time");
  while (value != end_value) {
    double before = begin, after = last;
    for (;;) {
      const double middle = before + (after - before) / 2;
      if (middle == before || middle == after) break;
      (step_value(k, middle) == value ? before : after) = middle;
    }
    jumps.push_back(after);
    begin = after;
    value = step_value(k, begin);
  }
}

// Is it a square root, or a power with a fraction, of an expression that a switch of the state keeps
// nonnegative?
bool Switches::is_root_of_size(const Node& n) const {
  const bool is_root = (n.operation == Operation::function && n.function == Function::sqrt) ||
                       (n.operation == Operation::power && n.c != std::floor(n.c));
  return is_root && is_never_negative(graph_, n.a) &&
         function_of(graph_[n.a].decides, false) < deciding_.size();
}

// A choice within a mode; one without a switching function of its own follows from numbers.
NodeId Switches::choice_in(const Mode& mode, const Node& n, const std::vector<NodeId>& made,
                           Graph& graph) const {
  const std::size_t decides = function_of(n.decides, false);
  if (decides < mode.size()) return made[index(mode[decides] < 0 ? n.b : n.a)];
  const bool is_sign = graph.is_number(n.a) && graph.is_number(n.b) && graph[n.a].c == -graph[n.b].c;
  if (is_sign && graph.is_number(made[index(n.decides)], 0)) return graph.number(0);
  return graph.choice(made[index(n.decides)], made[index(n.a)], made[index(n.b)]);
}

// The slopes, the further expressions, and then the functions, without choices and jumps, for a mode off all
// surfaces.
std::vector<NodeId> Switches::resolved(const Mode& mode, Graph& graph) const {
  std::vector<NodeId> ids = slopes_;
  ids.insert(ids.end(), further_.begin(), further_.end());
  ids.insert(ids.end(), deciding_.begin(), deciding_.end());
  const std::vector<bool> part = parts_of(graph_, ids);
  std::vector<NodeId> made(part.size());
  for (NodeId i = 0; i < graph_.nodes(); ++i) {
    if (!part[index(i)]) continue;
    const Node& n = graph_[i];
    if (i <= graph_.size() || n.operation == Operation::number) {
      made[index(i)] = i;
    } else if (n.operation == Operation::choice) {
      made[index(i)] = choice_in(mode, n, made, graph);
    } else if (const auto known = roundings_.find(i); known != roundings_.end()) {
      const auto [function, is_of_opposite] = known->second;
      const int n_below = (mode[function] - 1) / 2;
      made[index(i)] = graph.number(is_of_opposite ? -n_below - 1 : n_below);
    } else if (is_root_of_size(n)) {
      // Within a mode sqrt(abs(x)) is a root of x or -x, which is NaN for trial steps beyond the surface.
      const NodeId a = made[index(n.a)];
      const double half = n.operation == Operation::function ? 0.25 : n.c / 2;
      made[index(i)] = graph.power(graph.product(a, a), graph.number(half));
    } else {
      made[index(i)] = graph.again(n, made[index(n.a)], made[index(n.b)]);
    }
  }
  for (NodeId& id : ids) id = made[index(id)];
  return ids;
}

std::shared_ptr<const RepeatedProgram> Switches::in_mode(const Mode& mode) const {
  const std::scoped_lock lock(mutex_);
  if (known_.size() > most_known) known_.clear();
  std::shared_ptr<const RepeatedProgram>& program = known_[mode];
  if (program) return program;

  Graph graph = graph_;
  Mode below = mode;
  for (int& cell : below) cell -= stays_on_surface(cell) ? 1 : 0;
  const std::vector<NodeId> all = resolved(below, graph);
  const auto middle = all.end() - static_cast<std::ptrdiff_t>(deciding_.size());
  std::vector<NodeId> values(all.begin(), middle), deciding(middle, all.end()), watched = deciding;
  if (below != mode) {
    Sliding sliding(graph, values, deciding);
    for (std::size_t i = 0; i < mode.size(); ++i) {
      if (!stays_on_surface(mode[i])) continue;
      Mode above = below;
      above[i] = mode[i] + 1;
      std::vector<NodeId> upper = resolved(above, graph);
      upper.resize(values.size());
      sliding.add(i, upper);
    }
    const std::vector<NodeId> shares = sliding.shares();
    values = sliding.values(shares);
    for (std::size_t i = 0, k = 0; i < mode.size(); ++i) {
      if (stays_on_surface(mode[i])) watched[i] = shares[k++];
    }
  }
  const auto further = values.begin() + static_cast<std::ptrdiff_t>(slopes_.size());
  std::vector<NodeId> outputs(values.begin(), further);
  const std::vector<NodeId> along = rates(graph, deciding, outputs);
  outputs.insert(outputs.end(), watched.begin(), watched.end());
  outputs.insert(outputs.end(), along.begin(), along.end());
  outputs.insert(outputs.end(), further, values.end());
  return program = std::make_shared<const RepeatedProgram>(graph, outputs);
}

}  // namespace nlmech::program
