/// @file
/// The method as the dissertation prints it: one set of nodes, one matrix D, rows replaced by end conditions.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/bvp/optimal_control/extremal.hpp"
#include "nlmech/bvp/solution.hpp"

namespace nlmech::bvp {

/// How D = Phi' Phi^-1 is made on the nodes of the whole interval.
enum class DerivativeMatrix : std::uint8_t {
  gaussian,         ///< by the factors of Phi, as in Eq. 5.15
  stable_gaussian,  ///< to all digits
  polynomial        ///< the limit of a vanishing shape
};

/// The end condition that stands in the row of one component's equation at the first or the last node.
struct ReplacedRow {
  int condition = 0;    ///< number of the condition, in the order of Problem::conditions()
  int component = 0;    ///< whose equation is left out
  bool at_end = false;  ///< at the last node, else at the first
};

/// An equation x_k' = a x_m with a constant a, by which x_m is known where x_k is.
struct LinearEquation {
  int equation = 0;  ///< k
  int unknown = 0;   ///< m
};

/// N nodes, D and the placement of conditions.
struct GlobalMethod {
  int nodes = 40;                                            ///< N of section 5.3.5, LGL, ends included
  double relative_shape = 39.0 / 4;                          ///< c T; printed: (N - 1)/4
  DerivativeMatrix derivative = DerivativeMatrix::gaussian;  ///< D
  std::vector<ReplacedRow> rows = {};                        ///< one for each condition
  std::vector<LinearEquation> condensed = {};  ///< solve_global eliminates by these, see CondensedCollocation
};

/// The n N equations D x = f at N nodes with rows replaced (Eqs 5.25, 5.28), for the solvers of algebraic/.
/// Unknown k N + j is component k at node j, equation k N + j its row. One phase, no parameters.
class GlobalCollocation final : public algebraic::Equations {
 public:
  /// @param problem outlives the equations
  /// @throws std::invalid_argument for several phases, parameters, rows that do not fit or numbers out of
  /// range
  GlobalCollocation(const Problem& problem, GlobalMethod method);

  /// Success, or why D cannot be had: it is not finite.
  [[nodiscard]] Status status() const override { return status_; }
  /// Times of the nodes.
  [[nodiscard]] const Eigen::VectorXd& times() const { return times_; }
  /// D, 1/time.
  [[nodiscard]] const Eigen::MatrixXd& derivative() const { return d_; }
  /// The start at the nodes, as unknowns.
  [[nodiscard]] Eigen::VectorXd unknowns(const Start& start) const;
  /// The states of unknowns, one node a column.
  [[nodiscard]] Eigen::MatrixXd states(const Eigen::VectorXd& unknowns) const;
  /// Does an end condition stand in this equation's place?
  [[nodiscard]] bool is_replaced(Eigen::Index row) const;
  /// Residuals of the end conditions in their order: what Table 5.3 prints.
  [[nodiscard]] Eigen::VectorXd condition_residuals(const Eigen::VectorXd& unknowns) const;

  [[nodiscard]] Eigen::Index size() const override { return n_ * nodes_; }
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override;
  void linearise(const Eigen::VectorXd& x) override;
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override { out = matrix_ * v; }
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    out = matrix_.transpose() * v;
  }
  void matrix(Eigen::MatrixXd& b) const override { b = matrix_; }

 private:
  [[nodiscard]] Eigen::MatrixXd ends(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::Index row_of(const ReplacedRow& row) const;

  const Problem& problem_;
  GlobalMethod method_;
  Eigen::Index n_, nodes_;
  Status status_;
  Eigen::VectorXd times_;
  Eigen::MatrixXd d_, matrix_;
};

/// The equations of a GlobalCollocation after elimination of x_m = (D x_k)/a at every node at which the row
/// of x_k is not replaced. All equations in which x_m is left are linear in it, so that Newton's iteration
/// takes the same steps in the other unknowns, and they do not depend on the start's x_m. For the Duffing
/// cases, x1' = x2 and lambda2' = -lambda1, half of the unknowns go, and a step costs a sixth.
class CondensedCollocation final : public algebraic::Equations {
 public:
  /// @param problem that of the equations
  /// @param equations outlive the condensed ones, and are used by them
  /// @param linear at most one equation for each unknown
  /// @throws std::invalid_argument if an equation is not of that form, judged at three states
  CondensedCollocation(const Problem& problem, GlobalCollocation& equations,
                       const std::vector<LinearEquation>& linear);

  /// The unknowns that remain, out of all.
  [[nodiscard]] Eigen::VectorXd reduced(const Eigen::VectorXd& all) const { return all(kept_); }
  /// All unknowns, the eliminated ones from the others.
  [[nodiscard]] Eigen::VectorXd expanded(const Eigen::VectorXd& some) const;

  [[nodiscard]] Eigen::Index size() const override { return static_cast<Eigen::Index>(kept_.size()); }
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override;
  void linearise(const Eigen::VectorXd& x) override;
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override { out = matrix_ * v; }
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    out = matrix_.transpose() * v;
  }
  void matrix(Eigen::MatrixXd& b) const override { b = matrix_; }
  [[nodiscard]] Status status() const override { return equations_.status(); }

 private:
  GlobalCollocation& equations_;
  std::vector<Eigen::Index> kept_, gone_;        // unknowns
  std::vector<Eigen::Index> rows_, eliminated_;  // equations
  Eigen::MatrixXd by_kept_;                      // eliminated unknowns by the others
  Eigen::MatrixXd through_gone_;                 // what elimination adds to the matrix
  Eigen::MatrixXd matrix_;
};

/// A root of the global equations, and what an integrator thinks of it.
struct GlobalResult {
  Extremal extremal;           ///< solution on one interval through the nodes; its status tells all
  algebraic::Report report;    ///< of the solver
  Eigen::VectorXd conditions;  ///< residuals of the end conditions
  /// States integrated from the own initial values, at the nodes (Eq. "Delta x"); fewer columns if the
  /// integration was off before the end.
  Eigen::MatrixXd integrated;
};

/// The rows in which the end conditions of an extremal problem of two states stand:
///  - whole begin, free end: those of x at the first node, of lambda at the last (Eq. 5.25);
///  - whole begin and end: x2 and lambda1 at both (Eq. 5.28);
///  - the partial cases, which the text calls similar: conditions on x1 or x2 and on lambda2 or lambda1 at
///    each end in the rows of the readings of the chapter's page.
/// @throws std::invalid_argument unless the model has two states
[[nodiscard]] std::vector<ReplacedRow> printed_rows(const ExtremalProblem& problem);

/// Newton's iteration as in the dissertation, plain or damped, then verification by integration. A root whose
/// integrated trajectory is more than @p verification_tolerance off (relative, at the nodes) is
/// spurious_root.
///
/// Tests hold its errors to recorded ones for the printed shapes (20 %), spurious
/// roots to a refusal, and the polynomial limit to 5e-12.
[[nodiscard]] GlobalResult solve_global(const ExtremalProblem& problem, const GlobalMethod& method,
                                        const Start& start, double verification_tolerance = 0.1,
                                        bool damped = false, int iterations = 60);

}  // namespace nlmech::bvp
