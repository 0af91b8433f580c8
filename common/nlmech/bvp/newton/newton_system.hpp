/// @file
/// Linear system of Newton's iteration for collocation on a mesh, with block elimination.
#pragma once

#include <Eigen/QR>
#include <vector>

#include "nlmech/bvp/problem.hpp"
#include "nlmech/bvp/scheme.hpp"

namespace nlmech::bvp {

/// One interval of a mesh with its unknowns. Adjacent intervals share the values at their common end.
struct Interval {
  double t0 = 0;           ///< start
  double h = 0;            ///< length
  int phase = 0;           ///< number of the phase, from 0
  Eigen::MatrixXd values;  ///< n by N: x at the nodes
  Eigen::MatrixXd slopes;  ///< n by N: f at the nodes
};

/// All unknowns, or a Newton step.
struct Unknowns {
  std::vector<Interval> intervals;  ///< phase by phase, in order of time
  Eigen::VectorXd parameters;       ///< the m unknown constants

  /// States at both ends of each phase, in the layout of Problem::conditions().
  [[nodiscard]] Eigen::MatrixXd ends(int phases) const;
};

/// Collocation equations F(y) = 0 on a mesh: residual, derivative, and solution of the linear system.
///
/// Block elimination: the interior nodes of each interval are eliminated by Householder QR, then the points
/// of the mesh in sequence, also by orthogonal transformations (S. J. Wright, Stable parallel algorithms for
/// two-point boundary value problems, SIAM J. Sci. Stat. Comput. 13 (1992) 742-764), which is stable for
/// growing and decaying solutions. The reduced system of 2 n K + m equations for the phase ends and the
/// parameters is solved by QR with column pivoting. Work: K_intervals (n N)^3. If the sizes of the states
/// differ by more than 1e3, the linear system is in units of their sizes, powers of two.
class NewtonSystem {
 public:
  /// Stores references: both arguments must outlive the system.
  NewtonSystem(const Problem& problem, const Scheme& scheme);

  /// Evaluates F at y; sets the slopes of the intervals. False if F is not finite.
  [[nodiscard]] bool residual(Unknowns& y);
  /// Factorises dF/dy at y, the argument of the last residual(). False if the matrix is not finite.
  [[nodiscard]] bool factorise(const Unknowns& y);
  /// Sets step = -(dF/dy)^-1 F with the last factorisation and the last residual. @p step must have the mesh
  /// of y.
  void solve(Unknowns& step);

  /// Ratio of the smallest to the largest pivot of the reduced system with rows and columns scaled to 1: of
  /// the order of its reciprocal condition number.
  [[nodiscard]] double pivot_ratio() const { return pivot_ratio_; }
  /// Number of linearly independent conditions: rank of their derivatives.
  [[nodiscard]] Eigen::Index independent_conditions() const { return independent_; }
  /// Part of the residual of the conditions that no change of ends and parameters can remove to first order,
  /// relative to the largest residual; 0 if the conditions are independent.
  [[nodiscard]] double contradiction() const { return contradiction_; }
  /// For each state the largest sum over the nodes of |df_i/dx_j x_j| and |df_i/dp_j p_j|: the rounding error
  /// of f_i is a small multiple of the unit roundoff times it. Of the last factorise(), as the next ones.
  [[nodiscard]] const Eigen::VectorXd& terms() const { return terms_; }
  /// The same sums for the conditions.
  [[nodiscard]] const Eigen::VectorXd& condition_terms() const { return condition_terms_; }
  /// Largest |df_i/dp_j| over the nodes, then |dr_i/dp_j| of the conditions; one column for each parameter.
  [[nodiscard]] const Eigen::MatrixXd& influence() const { return influence_; }
  /// Largest |df_i/dx_j| over the nodes.
  [[nodiscard]] const Eigen::MatrixXd& state_influence() const { return state_influence_; }
  /// Sets step to the effect of rounding errors in F at @p y, with the last factorisation; replaces F.
  void solve_rounding(const Unknowns& y, Unknowns& step);
  /// Unknown that changes most, relative to @p sizes of states and parameters, in the direction that the
  /// matrix maps closest to 0: the state, or n + the parameter.
  [[nodiscard]] Eigen::Index loosest_unknown(const Eigen::VectorXd& sizes) const;
  /// Number of evaluations of f, one per node.
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  struct Condensed {
    Eigen::HouseholderQR<Eigen::MatrixXd> inner;  // of the columns of the interior nodes
    Eigen::MatrixXd top, bottom;                  // after Q^T: columns start, end, parameters
    Eigen::VectorXd r;                            // residual of the interval's equations
    Eigen::VectorXd terms;  // largest sum of the terms of each component of f, over the nodes
    Eigen::VectorXd r_top, r_bottom;
    // Elimination of the left end of the interval, unless that is the start of a phase.
    Eigen::HouseholderQR<Eigen::MatrixXd> left;
    Eigen::MatrixXd left_top;  // columns start of phase, right end, parameters
    Eigen::VectorXd r_left;
    bool has_inner = false, has_left = false;
  };
  // Time at which f is evaluated. With several phases f may jump between them, and rhs() is then the limit
  // from the right; so at the end of an interval f is evaluated at the previous double.
  [[nodiscard]] double node_time(const Interval& interval, Eigen::Index node) const;
  void set_units(const Unknowns& y);
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
  Eigen::VectorXd parameters_, terms_, condition_terms_, units_;  // units_: of the states
  Eigen::MatrixXd influence_, state_influence_;
  // Of one interval: columns of its start, end and the parameters; of its interior nodes; residual; one
  // state.
  Eigen::MatrixXd edges_, between_, change_, by_state_, by_parameter_;
  Eigen::VectorXd r_, x_;
  Eigen::RowVectorXd workspace_;
};

}  // namespace nlmech::bvp
