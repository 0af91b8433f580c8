/// @file
/// A right-hand side as a tape: the list of its operations for Taylor coefficients.
#pragma once

#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/tape_program.hpp"

namespace nlmech {

/// The operations of a graph in the form of the kernels for Taylor coefficients; see TapeExpansion.
class Tape {
 public:
  /// No equations.
  Tape() = default;
  /// Omits operations that no output needs; merges sums, differences and multiples into linear combinations.
  /// @param outputs the slopes of the state of @p graph
  /// @throws std::invalid_argument if they depend on a choice
  Tape(const program::Graph& graph, const std::vector<program::NodeId>& outputs);

  /// Have both the same operations and numbers?
  bool operator==(const Tape&) const = default;
  /// Components of the state.
  [[nodiscard]] int size() const { return static_cast<int>(outputs_.size()); }
  /// Number of series of a replay: the time, the state, and one or two per instruction.
  [[nodiscard]] int series() const { return series_; }
  /// Number of instructions in one pass.
  [[nodiscard]] int instructions() const { return static_cast<int>(instructions_.size()); }
  /// Does a component depend on the time, or on a component of constant rate, which is equivalent to it?
  [[nodiscard]] bool depends_on_time() const;
  /// Does any output with an index >= @p output depend on a component with an index >= @p component?
  [[nodiscard]] bool depends(int output, int component) const;
  /// The tape as data for the kernels; valid as long as this object exists and is not moved.
  [[nodiscard]] tape::Program program() const;

 private:
  friend class TapeCompiler;
  std::vector<tape::Instruction> instructions_;
  std::vector<tape::Term> terms_;
  std::vector<tape::Output> outputs_;
  int series_ = 0;
};

}  // namespace nlmech
