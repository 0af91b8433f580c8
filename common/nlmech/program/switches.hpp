/// @file
/// Equations with abs, sign, min and max: smooth on both sides of the surfaces on which these change.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::program {

/// On which side of each surface: 1 where its function is positive, -1 where it is negative, 0 for a motion
/// that stays on the surface because both sides lead back to it.
using Mode = std::vector<std::int8_t>;

/// The functions whose signs decide, and the smooth equations for each choice of signs.
///
/// A motion on a surface g = 0 follows Filippov: of all mixtures of the slopes of both sides that along which
/// g stays zero (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988, section 4). On
/// several surfaces at once the slopes change by a share of each surface's own jump, such that all their
/// functions stay zero (Utkin's equivalent control): what dry friction at several places asks for.
///
/// What decides by the time alone, as max(0, t - c) and floor(t), does so at known times: methods step onto
/// these, and there is nothing to locate. The equations keep such choices in every mode. Nor does a function
/// decide that changes at other choices alone, as sign(x) in max(sign(x), 0): it follows from these.
class Switches {
 public:
  /// What the slopes @p slopes of a state depend on by choices. @param graph is copied
  Switches(const Graph& graph, const std::vector<NodeId>& slopes);

  /// The times between @p from and @p to > from at which the equations change by the time alone, ascending:
  /// the first doubles at which they are those of the later side.
  /// @throws std::invalid_argument if there are more than a million
  [[nodiscard]] std::vector<double> times(double from, double to) const;
  /// Are there such times besides those of functions t - c, whose equations change at the same double in
  /// every precision?
  [[nodiscard]] bool has_rounded_times() const { return !timed_.empty(); }
  /// How many other functions decide.
  [[nodiscard]] int count() const { return static_cast<int>(deciding_.size()); }
  /// The equations of a mode. Outputs: the slopes; for each function its value, or where the motion stays on
  /// its surface the share of the upper side; then the derivatives of all functions along the slopes. Shares
  /// that no slopes give are not numbers. May be called by several threads.
  [[nodiscard]] std::shared_ptr<const Program> in_mode(const Mode& mode) const;

 private:
  [[nodiscard]] std::vector<NodeId> resolved(const Mode& mode, Graph& graph) const;
  [[nodiscard]] bool is_root_of_size(const Node& n) const;
  [[nodiscard]] double step_value(std::size_t k, double t) const;
  void add_jumps(std::size_t k, double begin, double last, std::vector<double>& jumps) const;

  static constexpr std::size_t most_known = 256;  // modes that are kept
  Graph graph_;
  std::vector<NodeId> slopes_, deciding_;
  std::vector<double> times_;  // c of functions t - c, rows of tables, ascending
  std::vector<NodeId>
      timed_;  // other nodes of the time alone that decide or are rounded, with what they need before them
  Program timed_values_;
  mutable std::mutex mutex_;
  mutable std::map<Mode, std::shared_ptr<const Program>> known_;
};

}  // namespace nlmech::program
