/// @file
/// A right-hand side as a tape: the list of its operations, from which Taylor coefficients are computed.
#pragma once

#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/tape_program.hpp"

namespace nlmech {

/// The operations of a graph as the kernels of Taylor coefficients know them; see TapeExpansion.
class Tape {
 public:
  /// No equations.
  Tape() = default;
  /// Operations that no output needs are left out; sums, differences and multiples are gathered in linear
  /// combinations.
  /// @param outputs the slopes of the state of @p graph
  /// @throws std::invalid_argument if they depend on a choice
  Tape(const program::Graph& graph, const std::vector<program::NodeId>& outputs);

  /// Components of the state.
  [[nodiscard]] int size() const { return static_cast<int>(outputs_.size()); }
  /// Series that a replay keeps: the time, the state and one or two for each instruction.
  [[nodiscard]] int series() const { return series_; }
  /// Operations in one pass.
  [[nodiscard]] int instructions() const { return static_cast<int>(instructions_.size()); }
  /// Does a component depend on the time, or on one that moves at a constant rate and so stands for it?
  [[nodiscard]] bool depends_on_time() const;
  /// Does an output from number @p output on depend on a component from number @p component on?
  [[nodiscard]] bool depends(int output, int component) const;
  /// The tape as the kernels read it; valid as long as the tape lives and stays where it is.
  [[nodiscard]] tape::Program program() const;

 private:
  friend class TapeCompiler;
  std::vector<tape::Instruction> instructions_;
  std::vector<tape::Term> terms_;
  std::vector<tape::Output> outputs_;
  int series_ = 0;
};

}  // namespace nlmech
