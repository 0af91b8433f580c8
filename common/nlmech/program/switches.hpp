/// @file
/// Equations with abs, sign, min, max and floor, which are smooth between switching surfaces.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/program.hpp"
#include "nlmech/program/repeated_program.hpp"

namespace nlmech::program {

/// Cell of each switching function: 1 where it is positive, -1 where it is negative. For a function that
/// switches at every integer, 2 n + 1 between n and n + 1. An even number, 0 or 2 n, is a motion that stays
/// on the surface because both sides lead to it.
using Mode = std::vector<int>;
/// Does a function with this entry of a mode stay on its surface?
[[nodiscard]] constexpr bool stays_on_surface(int cell) { return cell % 2 == 0; }

/// The switching functions, and the smooth equations of each cell.
///
/// A motion on a surface g = 0 is a sliding motion of Filippov: the convex combination of the slopes of both
/// sides along which g stays zero (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988,
/// section 4). On several surfaces at once the slopes contain a share of the jump of each surface such that
/// all functions stay zero (Utkin's equivalent control), as dry friction at several contacts requires.
///
/// Choices by time only, as in max(0, t - c) and floor(t), change at known times: steps end there, and there
/// is nothing to locate. The equations contain such choices in every mode. A function that changes at other
/// choices only, as sign(x) in max(sign(x), 0), is no switching function: it follows from these. floor(x) of
/// other expressions, and with it ceil, frac and mod, has the switching function x, which switches at every
/// integer; within a cell it is a number.
class Switches {
 public:
  /// Switches of the slopes @p slopes of a state. @param graph is copied
  /// @param further expressions of @p graph that in_mode() evaluates too
  Switches(const Graph& graph, const std::vector<NodeId>& slopes, const std::vector<NodeId>& further = {});

  /// The times between @p from and @p to > from at which the equations change by time only, ascending: the
  /// first doubles on the later side.
  /// @throws std::invalid_argument if there are more than a million
  [[nodiscard]] std::vector<double> times(double from, double to) const;
  /// Are there such times of functions other than t - c? Those of t - c are the same double in every
  /// precision.
  [[nodiscard]] bool has_rounded_times() const { return !timed_.empty(); }
  /// Number of switching functions.
  [[nodiscard]] int count() const { return static_cast<int>(deciding_.size()); }
  /// Does function @p i switch at every integer? Others switch at zero.
  [[nodiscard]] bool is_rounded(std::size_t i) const { return rounded_[i]; }
  /// The equations of a mode. Outputs: the slopes; for each function its value, or the share of the upper
  /// side if the motion stays on its surface; then the derivatives of all functions along the slopes; then
  /// the further expressions, on a surface with the same shares of the values on both sides as the slopes.
  /// Undetermined shares are NaN. Thread-safe.
  [[nodiscard]] std::shared_ptr<const RepeatedProgram> in_mode(const Mode& mode) const;

 private:
  /// A rounded expression as floor(g), or floor(-g), of a switching function g.
  struct Rounding {
    std::size_t function;
    bool is_of_opposite;
  };
  void add_rounding(NodeId node);
  [[nodiscard]] std::size_t function_of(NodeId node, bool rounded) const;
  [[nodiscard]] NodeId choice_in(const Mode& mode, const Node& n, const std::vector<NodeId>& made,
                                 Graph& graph) const;
  [[nodiscard]] std::vector<NodeId> resolved(const Mode& mode, Graph& graph) const;
  [[nodiscard]] bool is_root_of_size(const Node& n) const;
  [[nodiscard]] double step_value(std::size_t k, double t) const;
  void add_jumps(std::size_t k, double begin, double last, std::vector<double>& jumps) const;

  static constexpr std::size_t most_known = 256;  // largest number of cached modes
  Graph graph_;
  std::vector<NodeId> slopes_, further_, deciding_;
  std::vector<bool> rounded_;             // of each deciding node: does it switch at every integer?
  std::map<NodeId, Rounding> roundings_;  // by the floor node
  std::vector<double> times_;             // c of functions t - c, rows of tables, ascending
  std::vector<NodeId> timed_;  // other switching or rounded nodes of time only; operands come first
  Program timed_values_;
  mutable std::mutex mutex_;
  mutable std::map<Mode, std::shared_ptr<const RepeatedProgram>> known_;
};

}  // namespace nlmech::program
