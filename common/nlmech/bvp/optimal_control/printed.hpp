/// @file
/// Global collocation as printed in the dissertation: one set of nodes, one matrix D, rows replaced by end
/// conditions.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/bvp/optimal_control/extremal.hpp"
#include "nlmech/bvp/solution.hpp"

namespace nlmech::bvp {

/// Computation of D = Phi' Phi^-1 on the nodes of the interval.
enum class DerivativeMatrix : std::uint8_t {
  gaussian,         ///< by factorisation of Phi, as in Eq. 5.15
  stable_gaussian,  ///< Gaussian functions without loss of digits, by StableGaussian
  polynomial        ///< limit of vanishing shape
};

/// End condition that replaces the row of one component's equation at the first or the last node.
struct ReplacedRow {
  int condition = 0;    ///< number of the condition, in the order of Problem::conditions()
  int component = 0;    ///< component whose equation is replaced
  bool at_end = false;  ///< whether at the last node; else at the first
};

/// Linear equation x_k' = a x_m with a constant a, which determines x_m from x_k.
struct LinearEquation {
  int equation = 0;  ///< k
  int unknown = 0;   ///< m
};

/// Settings of the global method: N nodes, D and the placement of conditions.
struct GlobalMethod {
  int nodes = 40;                    ///< N of section 5.3.5; LGL nodes including both ends
  double relative_shape = 39.0 / 4;  ///< c T; printed: (N - 1)/4
  DerivativeMatrix derivative = DerivativeMatrix::gaussian;  ///< D
  std::vector<ReplacedRow> rows = {};                        ///< one per condition
  std::vector<LinearEquation> condensed =
      {};  ///< equations used by solve_global for elimination, see CondensedCollocation
};

/// The n N equations D x = f at N nodes with rows replaced (Eqs 5.25, 5.28), for the solvers in algebraic/.
/// Unknown k N + j is component k at node j, equation k N + j its row. One phase, no parameters.
class GlobalCollocation final : public algebraic::Equations {
 public:
  /// @param problem must outlive the equations
  /// @throws std::invalid_argument for several phases, parameters, inconsistent rows or numbers out of range
  GlobalCollocation(const Problem& problem, GlobalMethod method);

  /// Success, or a failure if D is not finite.
  [[nodiscard]] Status status() const override { return status_; }
  /// Times of the nodes.
  [[nodiscard]] const Eigen::VectorXd& times() const { return times_; }
  /// D, 1/time.
  [[nodiscard]] const Eigen::MatrixXd& derivative() const { return d_; }
  /// Vector of unknowns from the start at the nodes.
  [[nodiscard]] Eigen::VectorXd unknowns(const Start& start) const;
  /// States from a vector of unknowns, one column per node.
  [[nodiscard]] Eigen::MatrixXd states(const Eigen::VectorXd& unknowns) const;
  /// Whether an end condition replaces this equation.
  [[nodiscard]] bool is_replaced(Eigen::Index row) const;
  /// Residuals of the end conditions in their order, as printed in Table 5.3.
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

/// Equations of a GlobalCollocation after elimination of x_m = (D x_k)/a at every node at which the row of
/// x_k is not replaced. The eliminated equations are linear, so Newton's iteration takes the same steps in
/// the other unknowns, independently of x_m in the start. For the Duffing cases, x1' = x2 and lambda2' =
/// -lambda1, this eliminates half of the unknowns and reduces the cost of a step to a sixth.
class CondensedCollocation final : public algebraic::Equations {
 public:
  /// @param problem problem of the equations
  /// @param equations full equations; must outlive the condensed ones, which modify them
  /// @param linear equations for elimination, at most one per unknown
  /// @throws std::invalid_argument if an equation does not have that form at three test states
  CondensedCollocation(const Problem& problem, GlobalCollocation& equations,
                       const std::vector<LinearEquation>& linear);

  /// Remaining unknowns from all unknowns.
  [[nodiscard]] Eigen::VectorXd reduced(const Eigen::VectorXd& all) const { return all(kept_); }
  /// All unknowns, with the eliminated ones computed from the others.
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
  Eigen::MatrixXd by_kept_;       // derivative of the eliminated unknowns with respect to the others
  Eigen::MatrixXd through_gone_;  // contribution of the elimination to the matrix
  Eigen::MatrixXd matrix_;
};

/// Root of the global equations with its verification by integration.
struct GlobalResult {
  Extremal extremal;           ///< solution on one interval; status of solver and verification
  algebraic::Report report;    ///< report of the solver
  Eigen::VectorXd conditions;  ///< residuals of the end conditions
  /// States at the nodes, integrated from the initial values of the root (Eq. "Delta x"); fewer columns if
  /// the integration deviates before the end.
  Eigen::MatrixXd integrated;
};

/// Rows replaced by the end conditions of an extremal problem with two states:
///  - x(0) prescribed, free end: rows of x at the first node, of lambda at the last (Eq. 5.25);
///  - x(0) and x(T) prescribed: rows of x2 and lambda1 at both ends (Eq. 5.28);
///  - partial cases, which the text calls similar: conditions on x1 or x2 and on lambda2 or lambda1 at each
///  end, in the rows that the page of the chapter assumes.
/// @throws std::invalid_argument unless the model has two states
[[nodiscard]] std::vector<ReplacedRow> printed_rows(const ExtremalProblem& problem);

/// Newton's iteration as in the dissertation, plain or damped, then verification by integration. The status
/// is spurious_root if the integrated trajectory deviates by more than @p verification_tolerance (relative,
/// at the nodes).
///
/// Tests compare its errors with recorded ones for the printed shapes (20 %), check that spurious roots are
/// rejected, and the error of the polynomial limit (5e-12).
[[nodiscard]] GlobalResult solve_global(const ExtremalProblem& problem, const GlobalMethod& method,
                                        const Start& start, double verification_tolerance = 0.1,
                                        bool damped = false, int iterations = 60);

}  // namespace nlmech::bvp
