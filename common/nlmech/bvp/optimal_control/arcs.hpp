/// @file
/// Extremals of arcs: boundary value problem of a sequence of arcs on which the same bounds are active.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "nlmech/bvp/optimal_control/necessary_conditions.hpp"
#include "nlmech/bvp/problem.hpp"

namespace nlmech::bvp {

/// What determines a control on an arc.
enum class ControlMode : std::uint8_t {
  interior,  ///< dH/du = 0
  low,       ///< its lower bound
  high,      ///< its upper bound
  singular   ///< the second time derivative of dH/du is zero
};

/// Active bounds of an arc.
struct Arc {
  std::vector<ControlMode> controls;            ///< mode of each control
  std::vector<bool> on_bound;                   ///< for each bound on states: does the arc lie on it?
  bool operator==(const Arc&) const = default;  ///< are all modes equal?
};

/// What happens between two arcs.
enum class JunctionKind : std::uint8_t {
  point,           ///< a prescribed time
  switching,       ///< a control reaches or leaves a bound: dH/du = 0 there
  entry,           ///< a bound on states is reached: S and its derivatives are zero, lambda jumps
  exit,            ///< a bound on states is left: its multiplier is zero
  contact,         ///< a bound on states is touched: S = S' = 0, lambda jumps
  singular_entry,  ///< a singular arc begins: dH/du and its time derivative are zero
  singular_exit    ///< a singular arc ends
};

/// Junction of two arcs.
struct Junction {
  JunctionKind kind;  ///< its kind
  int index;          ///< number of the control or of the bound; of the interior point
  double time;        ///< its time, as initial guess unless kind is point
};

/// Evaluates the conditions of one arc: controls and multipliers (u, mu) by Newton's iteration at each time,
/// with their derivatives by the implicit function theorem.
class ArcFlow {
 public:
  /// Keeps a reference to @p conditions.
  ArcFlow(const NecessaryConditions& conditions, const Arc& arc);

  /// Sets wide = (x, lambda, u, mu) from z = (x, lambda). NaN if there are no u and mu.
  void complete(double t, const Eigen::VectorXd& z, Eigen::VectorXd& wide) const;
  /// Values of @p expressions of (x, lambda, u, mu) on this arc.
  [[nodiscard]] Eigen::VectorXd values(const Expressions& expressions, double t,
                                       const Eigen::VectorXd& z) const;
  /// As values(), with the derivatives by t (column 0) and z.
  void differentiate(const Expressions& expressions, double t, const Eigen::VectorXd& z,
                     Eigen::VectorXd& values, Eigen::MatrixXd& by) const;
  /// f and -dH/dx.
  [[nodiscard]] const Expressions& flow() const { return flow_; }
  /// The arc.
  [[nodiscard]] const Arc& arc() const { return arc_; }

 private:
  void minimise(double t, Eigen::VectorXd& wide) const;

  const NecessaryConditions& conditions_;
  Arc arc_;
  Expressions pointwise_, hamiltonian_, flow_;
  bool minimises_ = true;  // all controls minimise H between or at their bounds
};

/// Boundary value problem of a sequence of K arcs. Arc k is mapped to times from k to k + 1. Unknown
/// constants: the multipliers nu of the conditions, the unknown times of junctions, the multipliers of
/// entries and contacts. Unknown functions: z = (x, lambda).
class ArcProblem final : public Problem {
 public:
  /// @param junctions one fewer than @p arcs, in order of time
  /// @throws std::invalid_argument if the unknown constants and conditions do not match
  ArcProblem(std::shared_ptr<const NecessaryConditions> conditions, const std::vector<Arc>& arcs,
             std::vector<Junction> junctions);

  /// The conditions.
  [[nodiscard]] const NecessaryConditions& necessary() const { return *necessary_; }
  /// Arc @p k.
  [[nodiscard]] const ArcFlow& arc(int k) const { return flows_[static_cast<std::size_t>(k)]; }
  /// The junctions.
  [[nodiscard]] const std::vector<Junction>& junctions() const { return junctions_; }
  /// Times of the ends of all arcs, K + 1.
  [[nodiscard]] std::vector<double> times(const Eigen::VectorXd& p) const;
  /// True time and number of the arc at the time @p s of the problem.
  [[nodiscard]] std::pair<double, int> place(double s, const Eigen::VectorXd& p) const;
  /// Initial guess of p: the times of the junctions, and nu that fits the ends of @p z best.
  /// @param z columns x, lambda at the points of the problem
  [[nodiscard]] Eigen::VectorXd parameters_from(const Eigen::MatrixXd& z) const;
  /// The multipliers of entry or contact @p junction in @p p: of S, S', ...; empty for other junctions.
  [[nodiscard]] Eigen::VectorXd jump_multipliers(std::size_t junction, const Eigen::VectorXd& p) const;

  /// Sets least_sizes() from the sizes @p x of the states and @p lambda of the co-states. All terms lambda_i
  /// x_i are measured against the largest: a co-state may be zero.
  void set_sizes(const Eigen::VectorXd& x, const Eigen::VectorXd& lambda);

  [[nodiscard]] int states() const override { return 2 * n_; }
  [[nodiscard]] int parameters() const override { return parameters_; }
  [[nodiscard]] std::vector<double> points() const override;
  [[nodiscard]] Eigen::VectorXd least_sizes() const override { return least_sizes_; }
  void rhs(double s, const Eigen::VectorXd& z, const Eigen::VectorXd& p,
           Eigen::VectorXd& dzds) const override;
  void jacobian(double s, const Eigen::VectorXd& z, const Eigen::VectorXd& p, Eigen::MatrixXd& by_state,
                Eigen::MatrixXd& by_parameter) const override;
  void conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::VectorXd& r) const override;
  void condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::MatrixXd& by_ends,
                          Eigen::MatrixXd& by_parameter) const override;

 private:
  /// Conditions of a junction, on one side, and the gradients of the expressions whose multipliers make
  /// lambda jump.
  struct JunctionConditions {
    Expressions conditions;  // then the gradients by x, n for each multiplier
    int count = 0;           // of conditions
    int jumps = 0;           // number of multipliers
    bool before = true;      // side of the conditions
    int time = -1;           // place of the time in p, -1 if it is known
    int multipliers = 0;     // place of the multipliers in p
    int point = -1;          // number of the prescribed point, -1 if it is none
  };
  void add_junction(std::size_t j);
  [[nodiscard]] Eigen::VectorXd end_state(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p) const;
  [[nodiscard]] Eigen::Index column_of(int point) const;

  std::shared_ptr<const NecessaryConditions> necessary_;
  int n_, parameters_ = 0;
  std::vector<ArcFlow> flows_;
  std::vector<Junction> junctions_;
  std::vector<JunctionConditions> joined_;
  std::vector<Eigen::Index> point_columns_;  // column of ends of each interior point
  Expressions ends_;
  Eigen::VectorXd least_sizes_;
};

}  // namespace nlmech::bvp
