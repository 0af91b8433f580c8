/// @file
/// Optimal control as a boundary value problem: Euler-Lagrange equations with end conditions.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "nlmech/bvp/optimal_control/control_model.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::bvp {

/// Prescribed state at an interior time, where its co-state may jump.
struct Waypoint {
  double t = 0;       ///< strictly between the ends
  int component = 0;  ///< number of the state, from 0
  double value = 0;   ///< of the state
};

/// Optimal control task: interval, end conditions and constraints for a control model.
struct ControlTask {
  double begin_time = 0;                     ///< t_0
  double final_time = 1;                     ///< t_F, or its initial guess
  std::vector<std::optional<double>> begin;  ///< x(t_0) where prescribed; n
  std::vector<std::optional<double>> end;    ///< x(t_F) where prescribed; n
  std::vector<Waypoint> waypoints = {};      ///< interior conditions, in any order
  bool free_final_time = false;              ///< t_F is unknown, with the condition H + dphi/dt_F = 0
  double mu = 0;                             ///< parameter of the ControlModel
  Constraints constraints = {};              ///< bounds of controls and states
};

/// Boundary value problem of the extremals of a control task: z = (x, lambda) with dz/dt of Eq. 5.7. At each
/// end x_i is prescribed, or else -lambda_i(t_0) = dphi/dx_i, lambda_i(t_F) = dphi/dx_i (Table 5.1). At a
/// waypoint the state is prescribed on both sides; all other states and their co-states are continuous.
///
/// The time of the problem is the true time. If t_F is free, it is scaled linearly to the interval from t_0
/// to the initial guess of t_F (waypoints are scaled with it), and t_F is the only parameter.
class ExtremalProblem final : public Problem {
 public:
  /// @throws std::invalid_argument for inconsistent sizes, times or components, and for a weight, limit or
  /// smoothing out of range
  ExtremalProblem(std::shared_ptr<const ControlModel> model, ControlTask task);

  /// The model.
  [[nodiscard]] const ControlModel& model() const { return *model_; }
  /// The model, with shared ownership.
  [[nodiscard]] const std::shared_ptr<const ControlModel>& shared_model() const { return model_; }
  /// The control task.
  [[nodiscard]] const ControlTask& task() const { return task_; }
  /// t_F for the parameters @p p.
  [[nodiscard]] double final_time(const Eigen::VectorXd& p) const;
  /// Initial guess of the parameters: the values of the task.
  [[nodiscard]] Eigen::VectorXd own_parameters() const;
  /// True time for the time @p t of the problem.
  [[nodiscard]] double true_time(double t, const Eigen::VectorXd& p) const;

  /// 2 n.
  [[nodiscard]] int states() const override { return 2 * n_; }
  [[nodiscard]] int parameters() const override { return task_.free_final_time ? 1 : 0; }
  [[nodiscard]] std::vector<double> points() const override { return points_; }
  void rhs(double t, const Eigen::VectorXd& z, const Eigen::VectorXd& p,
           Eigen::VectorXd& dzdt) const override;
  void jacobian(double t, const Eigen::VectorXd& z, const Eigen::VectorXd& p, Eigen::MatrixXd& by_state,
                Eigen::MatrixXd& by_parameter) const override;
  /// See Problem. Order: start and end by component, waypoints, t_F.
  void conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::VectorXd& r) const override;
  void condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p, Eigen::MatrixXd& by_ends,
                          Eigen::MatrixXd& by_parameter) const override;

 private:
  [[nodiscard]] std::optional<double> waypoint(std::size_t point, int component) const;

  std::shared_ptr<const ControlModel> model_;
  ControlTask task_;
  int n_;
  std::vector<double> points_;
};

/// Kind of stationary point.
enum class Kind : std::uint8_t {
  untested,   ///< not classified by second_order()
  minimum,    ///< the second variation is positive
  saddle,     ///< the second variation has negative directions
  degenerate  ///< its smallest eigenvalue is zero to the accuracy of the test
};

/// "minimum".
[[nodiscard]] std::string_view to_string(Kind kind);

/// Second variation of the cost for controls that are constant on equal pieces, reduced to variations that
/// satisfy the prescribed ends and waypoints.
struct SecondOrder {
  Kind kind = Kind::untested;  ///< classification by the eigenvalues
  int negative = 0;            ///< number of eigenvalues below -tolerance
  double least = 0;            ///< smallest eigenvalue, in units of integral |du|^2 dt
  double tolerance = 0;        ///< 1e-6 max(1, largest eigenvalue)
};

/// Extremal with its cost.
struct Extremal {
  Solution solution;      ///< z = (x, lambda) in the time of the problem
  double cost = 0;        ///< J without penalties (Eq. 5.2)
  double final_time = 0;  ///< t_F
  /// Largest absolute deviation of the integrated end from the prescribed x(t_F); NaN if not integrated.
  double miss = 0;
  SecondOrder second_order;  ///< untested unless computed by multistart()
};

/// Solves the boundary value problem, verifies it by integration and evaluates the cost.
///
/// Tests compare cost and control of a mass with the exact parabola (1e-14, 1e-13), and six cases of
/// Duffing's oscillator with a computation in 36 digits (relative error of the cost 1e-10, co-states 1e-11; H
/// is constant to 1e-10).
[[nodiscard]] Extremal solve_extremal(const ExtremalProblem& problem, const Start& start,
                                      const Options& options = {});

/// Extremal::miss of a solution.
[[nodiscard]] double end_miss(const ExtremalProblem& problem, const Solution& solution);

/// J of a solution, without penalties.
[[nodiscard]] double cost_of(const ExtremalProblem& problem, const Solution& solution);

/// The control at the time @p t of the problem.
[[nodiscard]] Eigen::VectorXd control_at(const ExtremalProblem& problem, const Solution& solution, double t);

/// H at the time @p t of the problem: constant along extremals of autonomous problems without waypoints.
[[nodiscard]] double hamiltonian_at(const ExtremalProblem& problem, const Solution& solution, double t);

/// Second-order test at a fixed final time for piecewise constant controls. Clipped controls are not varied.
/// A negative direction is also one of the continuous problem; a positive result holds for controls of this
/// resolution only.
/// @param pieces number of pieces of the control, 10 to 400
[[nodiscard]] SecondOrder second_order(const ExtremalProblem& problem, const Solution& solution,
                                       int pieces = 80);

/// Homotopy of constraints: weak at s = 0, as required at s = 1.
using ConstraintPath = std::function<Constraints(double s)>;

/// Solves a control task by continuation from s = 0 to 1, with the last extremal as initial guess; a failure
/// halves the step of s.
///
/// Tests compare the cost of a bounded control with a recorded one by shooting (1e-7).
/// @param problem model and task; its constraints are ignored
/// @param start for s = 0
/// @param options options of each solve; with a penalty on states the verification `whole` becomes `pieces`,
/// because solutions grow like exp(sqrt(weight) t) along a bounded arc
/// @return the extremal at s = 1 (evaluate it with a problem with the constraints path(1)); or, if the
/// continuation fails, the last extremal with the status `infeasible`: the bounds admit no extremal nearby,
/// or none at all
[[nodiscard]] Extremal tighten(const ExtremalProblem& problem, const Start& start, const ConstraintPath& path,
                               const Options& options = {});

/// The same task with other constraints.
[[nodiscard]] ExtremalProblem with_constraints(const ExtremalProblem& problem,
                                               const Constraints& constraints);

/// Homotopy for a bounded control: first the limit decreases from 1.1 times the peak to @p limit with a wide
/// smoothing, then the smoothing decreases to @p smoothing.
/// @param peak largest |u| of the unbounded control, > 0
/// @throws std::invalid_argument unless all are positive
[[nodiscard]] ConstraintPath control_bound_path(double peak, double limit, double smoothing = 1e-4);

/// Homotopy for bounded states: the penalty weight increases from 1 to @p weight, the smoothing decreases
/// from 0.1 to 1/sqrt(weight).
[[nodiscard]] ConstraintPath state_bound_path(std::vector<StateBound> bounds, double weight = 1e4);

/// Options of multistart().
struct MultistartOptions {
  int second_order_pieces = 0;  ///< pieces of the second-order test of each distinct extremal; 0: no test
  double seconds =
      std::numeric_limits<double>::infinity();  ///< time limit after which no further start is tried, s
};

/// Extremal with the number of starts that led to it.
struct Found {
  Extremal extremal;  ///< with its second-order test, if requested
  int hits = 0;       ///< number of starts that led to it
};

/// Result of multistart().
struct Multistart {
  std::vector<Found> found;  ///< distinct extremals, in order of cost
  int good = 0;              ///< number of starts that led to a solution
  int spurious = 0;          ///< number of starts that led to a spurious root
  int failed = 0;            ///< number of all other starts tried
  Statistics statistics;     ///< sum over all starts
};

/// Calls solve_extremal() for each start. Two extremals are identical if their initial values and parameters
/// differ by at most 1e-5 (1 + |value|).
[[nodiscard]] Multistart multistart(const ExtremalProblem& problem, std::span<const Start> starts,
                                    const Options& options = {}, const MultistartOptions& many = {});

}  // namespace nlmech::bvp
