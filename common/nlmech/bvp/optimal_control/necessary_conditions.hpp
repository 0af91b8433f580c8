/// @file
/// Necessary conditions of an optimal control problem, derived from its expressions.
#pragma once

#include <vector>

#include "nlmech/bvp/optimal_control/expressions.hpp"
#include "nlmech/program/partials.hpp"

namespace nlmech::bvp {

/// Minimise phi(x(t_0), ..., x(t_J)) + integral of L(t, x, u) from t_0 to t_J subject to x' = f(t, x, u),
/// psi(x(t_0), ..., x(t_J)) = 0, low <= u <= high and S(t, x) <= 0, with n states x and q controls u. A free
/// final time T is a state with T' = 0, on a fixed interval of a scaled time.
struct ControlProblem {
  program::Graph graph{0};                    ///< expressions of t and of the n + q components x, u
  int states = 0;                             ///< n
  std::vector<program::NodeId> slopes;        ///< f, n nodes of graph
  program::NodeId running_cost = 0;           ///< L, node of graph
  std::vector<double> low;                    ///< lower bounds of the q controls; -infinity: none
  std::vector<double> high;                   ///< upper bounds of the q controls; infinity: none
  std::vector<program::NodeId> state_bounds;  ///< S, nodes of graph
  std::vector<double> points;                 ///< t_0 < t_1 < ... < t_J
  program::Graph ends{0};                     ///< expressions of x(t_0), x(t_1), ..., x(t_J)
  program::NodeId end_cost = 0;               ///< phi, node of ends
  std::vector<program::NodeId> conditions;    ///< psi, nodes of ends

  /// q.
  [[nodiscard]] int controls() const { return graph.size() - states; }
};

/// The value that a condition of the form x_i(t_j) = value prescribes.
struct PrescribedValue {
  std::size_t condition;  ///< its number
  int point;              ///< j
  int component;          ///< i
  double value;           ///< the value
};

/// The conditions of @p problem that prescribe one component at one point.
[[nodiscard]] std::vector<PrescribedValue> prescribed_values(const ControlProblem& problem);

/// Pontryagin's conditions as expressions of t and of the components x, lambda, u, mu.
///
/// H = L + lambda f + sum of mu_k S_k^(r) with the first time derivative of each bound S_k on which the
/// control acts (A. E. Bryson, Y.-C. Ho, Applied Optimal Control, 1975, sections 3.8 to 3.11).
struct NecessaryConditions {
  /// @throws std::invalid_argument with a sentence for a bound on which no control acts within four
  /// derivatives, or that contains a control
  explicit NecessaryConditions(const ControlProblem& problem);

  int n;                                               ///< states
  int q;                                               ///< controls
  int bounds;                                          ///< bounds on states
  std::vector<double> low;                             ///< lower bounds of the controls
  std::vector<double> high;                            ///< upper bounds of the controls
  std::vector<double> points;                          ///< t_0 < ... < t_J
  program::Graph graph;                                ///< expressions of t, x, lambda, u, mu
  std::vector<program::NodeId> flow;                   ///< f, then -dH/dx
  std::vector<program::NodeId> by_control;             ///< dH/du
  program::NodeId hamiltonian = 0;                     ///< H
  program::NodeId running_cost = 0;                    ///< L
  std::vector<std::vector<program::NodeId>> tangency;  ///< for each bound S, S', ... without a control
  std::vector<program::NodeId> path;                   ///< for each bound its first derivative with a control
  std::vector<bool> linear;                            ///< is H linear in the control?
  bool quadratic = true;                               ///< is H at most quadratic in the controls?
  /// For one control in which H is linear: dH/du, its first, and its second time derivative, which is linear
  /// in u along singular arcs; otherwise empty.
  std::vector<program::NodeId> switching;
  program::Graph ends;                          ///< expressions of x(t_0), ..., x(t_J), nu
  std::vector<program::NodeId> end_conditions;  ///< psi, then the gradient of phi + nu psi by the x(t_j)
  program::NodeId end_cost = 0;                 ///< phi
  std::size_t multipliers;                      ///< number of conditions psi, and of nu

  /// Does @p node of graph depend on a control?
  [[nodiscard]] bool has_control(program::NodeId node) const;

 private:
  void derive_bounds(const std::vector<program::NodeId>& state_bounds);
  void derive_switching(const ControlProblem& problem);
  void derive_ends(const ControlProblem& problem);
};

}  // namespace nlmech::bvp
