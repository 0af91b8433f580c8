/// @file
/// Solution of equations that are linear in the highest derivatives of the unknowns.
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
  NodeId rest;                    ///< expression of time and state
  std::map<int, NodeId> highest;  ///< coefficients by unknown; never the number 0
};

/// A system of linear equations for the highest derivatives. It is solved in blocks: uncoupled derivatives
/// one by one, coupled ones (accelerations with a mass matrix) together.
class HighestDerivatives {
 public:
  /// Largest block with coefficients that depend on time or state.
  static constexpr int most_coupled = 12;
  /// Largest block whose coefficients are numbers.
  static constexpr int most_coupled_by_numbers = 64;
  /// Makes the error with a message about the highest derivative of an unknown.
  using Mistake = std::function<InputError(int unknown, std::string_view sentence)>;

  /// @param graph receives the new nodes
  HighestDerivatives(Graph& graph, int unknowns) : graph_(graph), unknowns_(unknowns) {}
  /// Adds an equation.
  void add(LinearEquation equation) { equations_.push_back(std::move(equation)); }
  /// The highest derivative of each unknown. @throws the error of @p mistake if they are not determined
  [[nodiscard]] std::vector<NodeId> solve(const Mistake& mistake);

 private:
  Graph& graph_;
  int unknowns_;
  std::vector<LinearEquation> equations_;
};

}  // namespace nlmech::program
