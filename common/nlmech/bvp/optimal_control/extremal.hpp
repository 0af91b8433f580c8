/// @file
/// Optimal control as a boundary value problem: the Euler-Lagrange equations with their end conditions.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "nlmech/bvp/optimal_control/control_model.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::bvp {

/// A prescribed state at a time between the ends. Its co-state may jump there.
struct Waypoint {
  double t = 0;       ///< strictly between the ends
  int component = 0;  ///< from 0
  double value = 0;   ///< of the state
};

/// What is asked of a control model.
struct ControlTask {
  double begin_time = 0;                     ///< t_0
  double final_time = 1;                     ///< t_F, or the first guess of it
  std::vector<std::optional<double>> begin;  ///< x(t_0) where prescribed; n
  std::vector<std::optional<double>> end;    ///< x(t_F) where prescribed; n
  std::vector<Waypoint> waypoints = {};      ///< between the ends, in any order
  bool free_final_time = false;              ///< t_F is unknown: H + dphi/dt_F = 0 there
  double mu = 0;                             ///< see ControlModel
  Constraints constraints = {};              ///< of control and states
};

/// The extremals of a control task: z = (x, lambda) with dz/dt of Eq. 5.7 and, at each end, x_i = its value
/// where it is prescribed and -lambda_i(t_0) = dphi/dx_i, lambda_i(t_F) = dphi/dx_i elsewhere (Table 5.1).
/// At a waypoint the state is prescribed from both sides, all others and their co-states are continuous.
///
/// The time of the problem is that of the task; if t_F is unknown it is stretched linearly, so that it runs
/// from t_0 to the first guess of t_F (waypoints stretch with it). The only parameter is t_F, if it is free.
class ExtremalProblem final : public Problem {
 public:
  /// @throws std::invalid_argument for sizes, times or components that do not fit, and for a weight, limit or
  /// smoothing out of range
  ExtremalProblem(std::shared_ptr<const ControlModel> model, ControlTask task);

  /// The model.
  [[nodiscard]] const ControlModel& model() const { return *model_; }
  /// The same, to be shared.
  [[nodiscard]] const std::shared_ptr<const ControlModel>& shared_model() const { return model_; }
  /// What is asked.
  [[nodiscard]] const ControlTask& task() const { return task_; }
  /// t_F for these parameters.
  [[nodiscard]] double final_time(const Eigen::VectorXd& p) const;
  /// Parameters that a start should have: the task's own values.
  [[nodiscard]] Eigen::VectorXd own_parameters() const;
  /// The true time of a time of the problem.
  [[nodiscard]] double true_time(double t, const Eigen::VectorXd& p) const;

  /// 2 n.
  [[nodiscard]] int states() const override { return 2 * n_; }
  [[nodiscard]] int parameters() const override { return task_.free_final_time ? 1 : 0; }
  [[nodiscard]] std::vector<double> points() const override { return points_; }
  void rhs(double t, const Eigen::VectorXd& z, const Eigen::VectorXd& p,
           Eigen::VectorXd& dzdt) const override;
  void jacobian(double t, const Eigen::VectorXd& z, const Eigen::VectorXd& p, Eigen::MatrixXd& by_state,
                Eigen::MatrixXd& by_parameter) const override;
  /// See Problem. The order: start and end by component, waypoints, t_F.
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

/// What kind of stationary point an extremal is.
enum class Kind : std::uint8_t {
  untested,   ///< second_order() was not called
  minimum,    ///< the second variation is positive
  saddle,     ///< it has negative directions
  degenerate  ///< its smallest eigenvalue is zero to the accuracy of the test
};

/// "minimum".
[[nodiscard]] std::string_view to_string(Kind kind);

/// The second variation of the cost on controls that are constant on equal pieces, reduced to those that keep
/// the prescribed ends and waypoints.
struct SecondOrder {
  Kind kind = Kind::untested;  ///< by the eigenvalues
  int negative = 0;            ///< eigenvalues below -tolerance
  double least = 0;            ///< smallest eigenvalue, in units of integral |du|^2 dt
  double tolerance = 0;        ///< 1e-6 times the largest one, or 1e-6 if that is larger
};

/// An extremal with its cost.
struct Extremal {
  Solution solution;      ///< z = (x, lambda) in the time of the problem
  double cost = 0;        ///< J without penalties (Eq. 5.2)
  double final_time = 0;  ///< t_F
  /// Largest distance of the integrated end from the prescribed x(t_F), absolute; NaN if not integrated.
  double miss = 0;
  SecondOrder second_order;  ///< untested unless multistart() was asked for it
};

/// Solves the boundary value problem, verifies it by integration and evaluates the cost.
///
/// Tests compare cost and control of a mass with the known parabola (1e-14, 1e-13), and six cases of
/// Duffing's oscillator with a computation in 36 digits: costs to 1e-10 of themselves, co-states to 1e-11; H
/// is constant to 1e-10.
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

/// Second-order test at a fixed final time, on so many pieces of the control. Where the control is clipped it
/// is held. A negative direction is one of the continuous problem too; a positive result speaks for controls
/// of this resolution.
/// @param pieces 10 to 400
[[nodiscard]] SecondOrder second_order(const ExtremalProblem& problem, const Solution& solution,
                                       int pieces = 80);

/// Constraints that depend on s: from easy ones at s = 0 to those asked for at s = 1.
using ConstraintPath = std::function<Constraints(double s)>;

/// Solves a control task for s from 0 to 1, each extremal the start of the next; a failure halves the step of
/// s.
///
/// Tests compare the cost of a bounded control with a recorded one by shooting (1e-7).
/// @param problem gives model and task; its own constraints are ignored
/// @param start for s = 0
/// @param options of each solve; with a penalty on states `whole` verifications become `pieces`, because
/// solutions grow like exp(sqrt(weight) t) along a bounded arc
/// @return the extremal at s = 1 (evaluate it with a problem of constraints path(1)); or the last one with
/// the status `infeasible` if the path cannot be followed further: the bounds admit no extremal near, or none
[[nodiscard]] Extremal tighten(const ExtremalProblem& problem, const Start& start, const ConstraintPath& path,
                               const Options& options = {});

/// The same task under other constraints.
[[nodiscard]] ExtremalProblem with_constraints(const ExtremalProblem& problem,
                                               const Constraints& constraints);

/// Constraints for a bounded control: the limit goes from 1.1 times the peak down to @p limit with a wide
/// smoothing, then that goes to @p smoothing.
/// @param peak largest |u| without bound, > 0
/// @throws std::invalid_argument unless all are positive
[[nodiscard]] ConstraintPath control_bound_path(double peak, double limit, double smoothing = 1e-4);

/// Constraints for bounded states: the weight of the penalty grows from 1 to @p weight, the smoothing falls
/// from 0.1 to 1/sqrt(weight).
[[nodiscard]] ConstraintPath state_bound_path(std::vector<StateBound> bounds, double weight = 1e4);

/// Options of multistart().
struct MultistartOptions {
  int second_order_pieces = 0;  ///< of the second-order test of each extremal kept; 0: none
  double seconds = std::numeric_limits<double>::infinity();  ///< no further start after so much time
};

/// An extremal and how often it was found.
struct Found {
  Extremal extremal;  ///< with its second-order test, if that was asked
  int hits = 0;       ///< how many starts led to it
};

/// What many starts led to.
struct Multistart {
  std::vector<Found> found;  ///< distinct, cheapest first
  int good = 0;              ///< starts that led to a solution
  int spurious = 0;          ///< starts that led to a root that cannot be integrated
  int failed = 0;            ///< all other starts begun
  Statistics statistics;     ///< of all of them
};

/// Calls solve_extremal() for one start after the other. Two extremals are the same if their initial values
/// and parameters differ by at most 1e-5, relative to 1 + their size.
[[nodiscard]] Multistart multistart(const ExtremalProblem& problem, std::span<const Start> starts,
                                    const Options& options = {}, const MultistartOptions& many = {});

}  // namespace nlmech::bvp
