/// @file
/// Equations with abs, sign, min and max: smooth on both sides of the surfaces on which these change.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "nlmech/expression/graph.hpp"
#include "nlmech/expression/program.hpp"

namespace nlmech::expression {

/// On which side of each surface: 1 where its function is positive, -1 where it is negative, 0 for a motion
/// that stays on the surface because both sides lead back to it.
using Mode = std::vector<std::int8_t>;

/// The functions whose signs decide, and the smooth equations for each choice of signs.
///
/// A motion on a surface g = 0 follows Filippov: of all mixtures of the slopes of both sides that along which
/// g stays zero (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988, section 4). On
/// several surfaces at once that is done for one after another.
class Switches {
 public:
  /// What the slopes @p slopes of a state depend on by choices. @param graph is copied
  Switches(const Graph& graph, const std::vector<NodeId>& slopes);

  /// How many functions decide.
  [[nodiscard]] int count() const { return static_cast<int>(deciding_.size()); }
  /// The equations of a mode. Outputs: the slopes, then the functions that decide, then the derivatives of
  /// these along the slopes. Made when first asked for; may be called by several threads.
  [[nodiscard]] std::shared_ptr<const Program> in_mode(const Mode& mode) const;

 private:
  [[nodiscard]] NodeId resolved(NodeId id, const Mode& mode) const;
  [[nodiscard]] NodeId rate(NodeId g, const std::vector<NodeId>& slopes) const;
  [[nodiscard]] std::vector<NodeId> slopes(const Mode& mode) const;
  [[nodiscard]] std::vector<NodeId> sliding(const Mode& mode, std::size_t on) const;

  mutable Graph graph_;
  std::vector<NodeId> slopes_, deciding_;
  mutable std::mutex mutex_;
  mutable std::map<Mode, std::shared_ptr<const Program>> known_;
};

}  // namespace nlmech::expression
