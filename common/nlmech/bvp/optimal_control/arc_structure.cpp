#include "nlmech/bvp/optimal_control/arc_structure.hpp"

#include <algorithm>
#include <cmath>

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Equal entries @p from to @p to - 1 of a list.
struct EqualRun {
  std::size_t from, to;
};

template <class T>
std::vector<EqualRun> equal_runs(const std::vector<T>& list) {
  std::vector<EqualRun> runs;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i == 0 || list[i] != list[i - 1]) runs.push_back({i, i});
    runs.back().to = i + 1;
  }
  return runs;
}

/// Replaces runs of at most @p most entries that are @p mode by their neighbours, half by each.
void join_short_runs(std::vector<ControlMode>& modes, std::size_t most, ControlMode mode) {
  const std::vector<ControlMode> old = modes;
  for (const EqualRun& run : equal_runs(old)) {
    if (old[run.from] != mode || run.to - run.from > most) continue;
    const bool has_left = run.from > 0, has_right = run.to < old.size();
    if (!has_left && !has_right) continue;
    const std::size_t middle = !has_left ? run.from : !has_right ? run.to : (run.from + run.to + 1) / 2;
    for (std::size_t i = run.from; i < run.to; ++i) modes[i] = i < middle ? old[run.from - 1] : old[run.to];
  }
}

/// Finds the arcs in piecewise constant controls.
class StructureFinder {
 public:
  StructureFinder(const NecessaryConditions& conditions, const DirectResult& direct)
      : c_(conditions), pieces_(static_cast<std::size_t>(direct.controls.cols())) {
    for (Index i = 0; i < direct.controls.rows(); ++i) modes_.push_back(modes_of(direct.controls.row(i), i));
  }

  /// Runs of pieces beyond bound @p k on states.
  void find_bound_runs(int k, const VectorXd& values) {
    std::vector<int> beyond(pieces_);
    for (std::size_t i = 0; i < pieces_; ++i) {
      const auto j = static_cast<Index>(i);
      beyond[i] = std::max(values[j], values[j + 1]) > 0 ? 1 : 0;
    }
    std::vector<EqualRun> found;
    const std::size_t gap = pieces_ / 25;
    for (const EqualRun& run : equal_runs(beyond)) {
      if (beyond[run.from] == 0) continue;
      if (!found.empty() && run.from - found.back().to <= gap)
        found.back().to = run.to;
      else
        found.push_back(run);
    }
    for (const EqualRun& run : found) {
      const bool may_touch = c_.tangency[static_cast<std::size_t>(k)].size() > 1;
      const bool inside = run.from > 0 && run.to < pieces_;
      const std::size_t length = run.to - run.from;
      runs_.push_back({run, k, may_touch && inside, may_touch && inside && length * 4 < pieces_});
    }
  }

  /// The likeliest structure, then those with one run, then with all runs changed between arc and contact.
  std::vector<ArcStructure> all() const {
    std::vector<bool> contact;
    for (const BoundRun& run : runs_) contact.push_back(run.is_contact);
    std::vector<std::vector<bool>> variants{contact};
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!runs_[i].may_touch) continue;
      variants.push_back(contact);
      variants.back()[i] = !contact[i];
    }
    if (variants.size() > 2) {
      variants.push_back(contact);
      for (std::size_t i = 0; i < runs_.size(); ++i) variants.back()[i] = runs_[i].may_touch != contact[i];
    }
    std::vector<ArcStructure> structures;
    for (const std::vector<bool>& variant : variants) structures.push_back(structure(variant));
    return structures;
  }

 private:
  /// Pieces beyond a bound on states.
  struct BoundRun {
    EqualRun pieces;
    int bound;
    bool may_touch, is_contact;
  };

  [[nodiscard]] std::vector<ControlMode> modes_of(const VectorXd& u, Index i) const {
    const auto k = static_cast<std::size_t>(i);
    const double low = c_.low[k], high = c_.high[k];
    // A small quadratic cost turns jumps between the bounds into short slopes.
    const double margin = c_.linear[k] ? 0.1 * (high - low) : 0;
    std::vector<ControlMode> modes(pieces_, ControlMode::interior);
    for (std::size_t j = 0; j < pieces_; ++j) {
      const double value = u[static_cast<Index>(j)];
      if (value <= low + margin) modes[j] = ControlMode::low;
      if (value >= high - margin) modes[j] = ControlMode::high;
    }
    if (!c_.linear[k]) return modes;
    const std::size_t most = std::max<std::size_t>(3, pieces_ / 20);
    join_short_runs(modes, most, ControlMode::interior);
    for (const ControlMode mode : {ControlMode::low, ControlMode::high}) join_short_runs(modes, 2, mode);
    if (!c_.switching.empty()) std::ranges::replace(modes, ControlMode::interior, ControlMode::singular);
    return modes;
  }

  /// Modes on piece @p i.
  [[nodiscard]] Arc arc_at(std::size_t i, const std::vector<bool>& contact) const {
    Arc arc{{}, std::vector<bool>(static_cast<std::size_t>(c_.bounds))};
    for (const auto& modes : modes_) arc.controls.push_back(modes[i]);
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (contact[k] || i < runs_[k].pieces.from || i >= runs_[k].pieces.to) continue;
      const auto bound = static_cast<std::size_t>(runs_[k].bound);
      arc.on_bound[bound] = true;
      for (std::size_t j = 0; j < modes_.size(); ++j) {
        if (acts_on(j, bound)) arc.controls[j] = ControlMode::interior;
      }
    }
    return arc;
  }

  [[nodiscard]] bool acts_on(std::size_t control, std::size_t bound) const {
    const program::NodeId u = program::Graph::state(2 * c_.n + static_cast<int>(control));
    return parts_of(c_.graph, {c_.path[bound]})[program::index(u)];
  }

  [[nodiscard]] double time(double piece) const {
    const double t0 = c_.points.front();
    return t0 + (c_.points.back() - t0) * piece / static_cast<double>(pieces_);
  }

  /// A junction and the arc after it.
  struct Change {
    Junction junction;
    Arc next;
  };

  /// Changes of modes between pieces @p i - 1 and @p i, one at a time.
  void add_changes(std::size_t i, const std::vector<bool>& contact, std::vector<Change>& changes) const {
    Arc now = arc_at(i - 1, contact);
    const Arc next = arc_at(i, contact);
    double at = static_cast<double>(i);
    const auto add = [&](JunctionKind kind, std::size_t index) {
      changes.push_back({{kind, static_cast<int>(index), time(at)}, now});
      at += 0.05;
    };
    for (std::size_t k = 0; k < now.on_bound.size(); ++k) {
      if (now.on_bound[k] == next.on_bound[k]) continue;
      now.on_bound[k] = next.on_bound[k];
      for (std::size_t j = 0; j < now.controls.size(); ++j) {
        if (acts_on(j, k)) now.controls[j] = next.controls[j];
      }
      add(now.on_bound[k] ? JunctionKind::entry : JunctionKind::exit, k);
    }
    for (std::size_t j = 0; j < now.controls.size(); ++j) {
      if (now.controls[j] == next.controls[j]) continue;
      const bool leaves = now.controls[j] == ControlMode::singular;
      const bool enters = next.controls[j] == ControlMode::singular;
      now.controls[j] = next.controls[j];
      add(leaves   ? JunctionKind::singular_exit
          : enters ? JunctionKind::singular_entry
                   : JunctionKind::switching,
          j);
    }
  }

  [[nodiscard]] ArcStructure structure(const std::vector<bool>& contact) const {
    std::vector<Change> changes;
    for (std::size_t i = 1; i < pieces_; ++i) add_changes(i, contact, changes);
    const auto stays = [](const JunctionKind kind) {
      return kind == JunctionKind::contact || kind == JunctionKind::point;
    };
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      const EqualRun& run = runs_[k].pieces;
      if (contact[k])
        changes.push_back(
            {{JunctionKind::contact, runs_[k].bound, time(static_cast<double>(run.from + run.to) / 2)}, {}});
    }
    for (std::size_t j = 1; j + 1 < c_.points.size(); ++j)
      changes.push_back({{JunctionKind::point, static_cast<int>(j), c_.points[j]}, {}});
    std::ranges::stable_sort(changes, {}, [](const Change& c) { return c.junction.time; });
    ArcStructure result{{arc_at(0, contact)}, {}};
    for (const Change& change : changes) {
      const Arc next = stays(change.junction.kind) ? result.arcs.back() : change.next;
      result.arcs.push_back(next);
      result.junctions.push_back(change.junction);
    }
    return result;
  }

  const NecessaryConditions& c_;
  std::size_t pieces_;
  std::vector<std::vector<ControlMode>> modes_;  // for each control, for each piece
  std::vector<BoundRun> runs_;
};

}  // namespace

std::vector<ArcStructure> arc_structures(const NecessaryConditions& conditions, const DirectResult& direct) {
  StructureFinder finder(conditions, direct);
  const Index pieces = direct.controls.cols();
  const double t0 = conditions.points.front(), length = conditions.points.back() - t0;
  VectorXd z(2 * conditions.n);
  for (int k = 0; k < conditions.bounds; ++k) {
    const Expressions bound(conditions.graph, {conditions.tangency[static_cast<std::size_t>(k)].front()});
    VectorXd values(pieces + 1), wide = VectorXd::Zero(conditions.graph.size());
    for (Index i = 0; i <= pieces; ++i) {
      const double t = t0 + length * static_cast<double>(i) / static_cast<double>(pieces);
      direct.start.states(t, z);
      wide.head(z.size()) = z;
      values[i] = bound.values(t, wide)[0];
    }
    finder.find_bound_runs(k, values);
  }
  return finder.all();
}

}  // namespace nlmech::bvp
