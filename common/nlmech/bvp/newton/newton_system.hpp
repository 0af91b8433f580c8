/// @file
/// The linear system of Newton's iteration for collocation on a mesh, solved block by block.
#pragma once

#include <Eigen/QR>
#include <vector>

#include "nlmech/bvp/problem.hpp"
#include "nlmech/bvp/scheme.hpp"

namespace nlmech::bvp {

/// One interval of a mesh with its unknowns. Values at the ends are those of the neighbours too.
struct Interval {
  double t0 = 0;           ///< start
  double h = 0;            ///< length
  int phase = 0;           ///< from 0
  Eigen::MatrixXd values;  ///< n by N: x at the nodes
  Eigen::MatrixXd slopes;  ///< n by N: f at the nodes
};

/// All unknowns, or a change of them.
struct Unknowns {
  std::vector<Interval> intervals;  ///< phase by phase, in order of time
  Eigen::VectorXd parameters;       ///< m of them

  /// The states at both ends of each phase, as Problem::conditions() takes them.
  [[nodiscard]] Eigen::MatrixXd ends(int phases) const;
};

/// F(y) = 0 of the mesh, its derivative, and the solution of linear systems with it.
///
/// Sparse by structure: inside an interval the nodes between its ends are eliminated by Householder's QR,
/// then the points of the mesh one after the other, again by orthogonal transformations (S. J. Wright, Stable
/// parallel algorithms for two-point boundary value problems, SIAM J. Sci. Stat. Comput. 13 (1992) 742-764),
/// so that neither growing nor decaying solutions lose digits. What remains are the ends of the phases and
/// the parameters, a system of 2 n K + m equations, solved by QR with pivots. Work: K_intervals (n N)^3.
class NewtonSystem {
 public:
  /// Both outlive the system.
  NewtonSystem(const Problem& problem, const Scheme& scheme);

  /// Evaluates F at y; fills the slopes of the intervals. False if F is not finite.
  [[nodiscard]] bool residual(Unknowns& y);
  /// Factorises dF/dy at y, whose residual was evaluated last. False if the matrix is not finite.
  [[nodiscard]] bool factorise(const Unknowns& y);
  /// step = -(dF/dy)^-1 F with the factors at hand and the residual evaluated last. The mesh of @p step is
  /// that of y.
  void solve(Unknowns& step);

  /// Smallest over largest pivot of the remaining system, its rows and columns scaled to 1: of the order of
  /// the reciprocal condition.
  [[nodiscard]] double pivot_ratio() const { return pivot_ratio_; }
  /// How many of the conditions are independent of each other, by their derivatives alone.
  [[nodiscard]] Eigen::Index independent_conditions() const { return independent_; }
  /// The part of the conditions' residual that no change of ends and parameters can remove, to first order;
  /// relative to the largest of the residuals. 0 if they are independent.
  [[nodiscard]] double contradiction() const { return contradiction_; }
  /// Evaluations of f so far, one a node.
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  struct Condensed {
    Eigen::HouseholderQR<Eigen::MatrixXd> inner;  // of the columns of the nodes between
    Eigen::MatrixXd top, bottom;                  // after Q^T: columns start, end, parameters
    Eigen::VectorXd r;                            // residual of the interval's equations
    Eigen::VectorXd r_top, r_bottom;
    // Elimination of the interval's left end, unless it begins a phase.
    Eigen::HouseholderQR<Eigen::MatrixXd> left;
    Eigen::MatrixXd left_top;  // columns start of phase, right end, parameters
    Eigen::VectorXd r_left;
    bool has_inner = false, has_left = false;
  };
  // With several phases f may jump between them, and is the limit from the right there: at the end of an
  // interval it is asked for one double before.
  [[nodiscard]] double node_time(const Interval& interval, Eigen::Index node) const;
  void condense(const Interval& interval, Condensed& c);
  void chain();
  void border(const Unknowns& y);
  void right_hand_sides();
  void back_substitute(Unknowns& step);

  const Problem& problem_;
  const Scheme& scheme_;
  int n_, m_, phases_;
  std::vector<Condensed> parts_;
  std::vector<int> phase_of_;
  std::vector<Eigen::MatrixXd> phase_rows_;  // start, end, parameters: n rows for each phase
  Eigen::VectorXd conditions_, row_scale_, column_scale_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rest_;
  Eigen::VectorXd rest_r_, rest_x_;
  double pivot_ratio_ = 0, contradiction_ = 0;
  Eigen::Index independent_ = 0;
  std::int64_t evaluations_ = 0;
  Eigen::VectorXd parameters_;
};

}  // namespace nlmech::bvp
