#include "nlmech/program/time_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace nlmech::program {
namespace {

/// Bounds on a function of time and on its derivative.
struct Bounds {
  Interval value, rate;
};

/// Placeholder state for functions of time only.
struct AnyState {
  Interval operator[](int) const { return {}; }
};

Bounds bounds_of(const Program& function, const Interval& t) {
  Bounds b;
  function.run(t, AnyState{}, 0, 2, [&b](int i, const Interval& v) { (i == 0 ? b.value : b.rate) = v; });
  return b;
}

/// The range of a function to a quarter of its width, by best-first search; the whole line if it is not
/// bounded or not found.
Interval range_of(const Program& function, double t0, double t1) {
  struct Part {
    Interval t, value;
    double open;  // excess over the known range when it was added
    bool operator<(const Part& other) const { return open < other.open; }
  };
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  std::priority_queue<Part> parts;
  const auto open = [&](const Interval& v) { return std::max(v.high - greatest, least - v.low); };
  const auto add = [&](const Interval& t) {
    const Interval middle = bounds_of(function, Interval(t.low + t.width() / 2)).value;
    if (std::isfinite(middle.width())) {
      least = std::min(least, middle.low);
      greatest = std::max(greatest, middle.high);
    }
    const Interval value = bounds_of(function, t).value;
    parts.push({t, value, open(value)});
  };
  add({t0, t1});
  constexpr int most = 2000;
  for (int k = 0; k < most && !parts.empty(); ++k) {
    const Part part = parts.top();
    parts.pop();
    if (open(part.value) <= (greatest - least) / 4) {
      if (open(part.value) < part.open) continue;  // others may have a larger excess now
      return {least, greatest};
    }
    const double middle = part.t.low + part.t.width() / 2;
    add({part.t.low, middle});
    add({middle, part.t.high});
  }
  return parts.empty() ? Interval(least, greatest) : Interval();
}

/// The division of an interval into cells in which one function rests or is active.
class Cells {
 public:
  struct Cell {
    double t0, t1;
    bool rests;
  };

  Cells(const Program& function, double t0, double t1) : function_(function) {
    variation_ = range_of(function, t0, t1).width();
    least_ = std::ldexp(t1 - t0, -48);
    if (variation_ > 0 && std::isfinite(variation_)) divide(t0, t1);
    if (left_ < 0) cells_.clear();
  }
  /// The cells in the order of time.
  [[nodiscard]] const std::vector<Cell>& all() const { return cells_; }

 private:
  [[nodiscard]] bool rests(const Bounds& b, double length) const {
    return std::min(b.value.width(), b.rate.magnitude() * length) <= 1e-12 * variation_;
  }
  [[nodiscard]] bool rests(double t0, double t1) const {
    return rests(bounds_of(function_, {t0, t1}), t1 - t0);
  }

  void divide(double t0, double t1) {
    if (--left_ < 0) return;
    const Bounds b = bounds_of(function_, {t0, t1});
    const double middle = t0 + (t1 - t0) / 2;
    if (rests(b, t1 - t0)) return add({t0, t1, true});
    const bool is_short =
        b.rate.magnitude() * (t1 - t0) <= 2 * variation_ && !rests(t0, middle) && !rests(middle, t1);
    if (is_short || t1 - t0 <= least_) return add({t0, t1, false});
    divide(t0, middle);
    divide(middle, t1);
  }
  void add(const Cell& cell) {
    cells_.push_back(cell);
    without_rest_ = cell.rests ? 0 : without_rest_ + 1;
    constexpr int most_without_rest = 4000;  // limit of cells: then the function is a wave
    if (without_rest_ > most_without_rest) left_ = -1;
  }

  const Program& function_;
  double variation_ = 0, least_ = 0;
  int left_ = 200'000, without_rest_ = 0;
  std::vector<Cell> cells_;
};

/// Adds the times of one function.
void add_places(const Program& function, double t0, double t1, std::vector<double>& places) {
  constexpr int first_cells = 12;
  const Cells cells(function, t0, t1);
  int active = first_cells;  // cells since the last rest; many if the function does not start with a rest
  for (const Cells::Cell& cell : cells.all()) {
    active = cell.rests ? 0 : active + 1;
    if (active == 1 && cell.t0 > t0) places.push_back(cell.t0);
    if (active > 0 && active <= first_cells && cell.t1 < t1) places.push_back(cell.t1);
  }
}

/// Adds the activities of one function of a duration up to @p longest.
void add_activities(const Program& function, double t0, double t1, double longest,
                    std::vector<TimeFeatures::Activity>& all) {
  const Cells cells(function, t0, t1);
  const std::vector<Cells::Cell>& cell = cells.all();
  for (std::size_t first = 0; first < cell.size(); ++first) {
    if (cell[first].rests) continue;
    std::size_t last = first;
    while (last + 1 < cell.size() && !cell[last + 1].rests) ++last;
    if (cell[last].t1 - cell[first].t0 <= longest) all.push_back({cell[first].t0, cell[last].t1});
    first = last;
  }
}

/// Can the function rest and then change fast? Sums and products of functions that cannot do so cannot
/// either, nor can sine and cosine of a constant frequency.
bool may_rest(Graph& graph, const Node& node) {
  switch (node.operation) {
    case Operation::quotient:
    case Operation::reciprocal:
    case Operation::power:
    case Operation::any_power:
    case Operation::atan2: return true;
    case Operation::function: break;
    default: return false;
  }
  const bool is_periodic = node.function == Function::sin || node.function == Function::cos;
  return !is_periodic || !graph.is_number(rates(graph, {node.a}, {}).front());
}

}  // namespace

std::vector<bool> of_time_alone(const Graph& graph) {
  std::vector<bool> by_time(static_cast<std::size_t>(graph.nodes())), by_state(by_time.size());
  for (NodeId i = 0; i < graph.nodes(); ++i) {
    const Node& n = graph[i];
    if (n.operation == Operation::number) continue;
    if (n.operation == Operation::variable) {
      (n.a == 0 ? by_time : by_state)[index(i)] = true;
      continue;
    }
    const auto add = [&](NodeId from) {
      by_time[index(i)] = by_time[index(i)] || by_time[index(from)];
      by_state[index(i)] = by_state[index(i)] || by_state[index(from)];
    };
    add(n.a);
    if (has_two_operands(n.operation)) add(n.b);
    if (n.operation == Operation::choice) add(n.decides);
  }
  for (std::size_t i = 0; i < by_time.size(); ++i) by_time[i] = by_time[i] && !by_state[i];
  return by_time;
}

TimeFeatures::TimeFeatures(const Graph& graph, const std::vector<NodeId>& slopes) {
  const std::vector<bool> part = parts_of(graph, slopes), by_time = of_time_alone(graph);
  for (NodeId i = 0; i < graph.nodes(); ++i) {
    if (!part[index(i)] || !by_time[index(i)]) continue;
    Graph own = graph;
    if (!may_rest(own, graph[i])) continue;
    const NodeId rate = rates(own, {i}, slopes).front();
    functions_.emplace_back(own, std::vector{i, rate});
  }
}

std::vector<double> TimeFeatures::between(double t0, double t1) const {
  if (functions_.empty() || !(t0 < t1) || !std::isfinite(t1 - t0)) return {};
  const std::lock_guard guard(mutex_);
  if (!(known_.t0 <= t0 && t1 <= known_.t1 && known_.t0 < known_.t1)) {
    known_ = {t0, t1, {}};
    std::vector<double>& places = known_.places;
    for (const Program& function : functions_) {
      std::vector<double> own;
      add_places(function, t0, t1, own);
      places.insert(places.end(), own.begin(), own.end());
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    constexpr std::size_t most = 10'000;
    if (places.size() > most) places.clear();
  }
  std::vector<double> between;
  for (const double t : known_.places) {
    if (t > t0 && t < t1) between.push_back(t);
  }
  return between;
}

std::vector<TimeFeatures::Activity> TimeFeatures::short_activities(double t0, double t1,
                                                                   double longest) const {
  std::vector<Activity> all;
  if (!(t0 < t1) || !std::isfinite(t1 - t0)) return all;
  for (const Program& function : functions_) add_activities(function, t0, t1, longest, all);
  std::ranges::sort(all, {}, &Activity::t0);
  // Merges the parts of one pulse: each function that contains it has its own.
  std::vector<Activity> once;
  for (const Activity& a : all) {
    if (!once.empty() && a.t0 <= once.back().t1)
      once.back().t1 = std::max(once.back().t1, a.t1);
    else
      once.push_back(a);
  }
  return once;
}

}  // namespace nlmech::program
