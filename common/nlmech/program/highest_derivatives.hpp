/// @file
/// Equations that are linear in the highest derivatives of the unknowns, solved for these.
#pragma once

#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::program {

/// rest + sum of coefficients times highest derivatives = 0.
struct LinearEquation {
  NodeId rest;                    ///< of time and state
  std::map<int, NodeId> highest;  ///< coefficient for each unknown that has one; none of them the number 0
};

/// A system of such equations. It is solved in blocks: what can be worked out one by one is, and only what
/// hangs together (accelerations under a mass matrix) by elimination.
class HighestDerivatives {
 public:
  /// How many may hang together by coefficients that depend on time or state.
  static constexpr int most_coupled = 12;
  /// How many may hang together by numbers alone.
  static constexpr int most_coupled_by_numbers = 64;
  /// To throw: a sentence about the highest derivative of an unknown.
  using Mistake = std::function<InputError(int unknown, std::string_view sentence)>;

  /// @param graph takes the new nodes
  HighestDerivatives(Graph& graph, int unknowns) : graph_(graph), unknowns_(unknowns) {}
  /// One more equation.
  void add(LinearEquation equation) { equations_.push_back(std::move(equation)); }
  /// The highest derivative of each unknown. @throws what @p mistake makes where they are not determined
  [[nodiscard]] std::vector<NodeId> solve(const Mistake& mistake);

 private:
  Graph& graph_;
  int unknowns_;
  std::vector<LinearEquation> equations_;
};

}  // namespace nlmech::program
