/// @file
/// The equations of collocation (Eq. 4.16) of one interval, or of a row of them, by solvers with and without
/// the inverse of the Jacobian matrix.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/solvers/collocation_equations.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Who solves, and which form of the equations.
enum class Solver {
  newton,                  ///< the dissertation's choice
  damped_newton,           ///< the same with steps that are shortened until |F| falls
  picard,                  ///< the equations' own fixed-point iteration
  fixed_point_printed,     ///< Eq. 2.15 on D x - g
  newton_flow_printed,     ///< Eq. 2.16 on D x - g
  fixed_point_integrated,  ///< Eq. 2.15 on x - (D_ss)^-1 (g - D_s1 x_1)
  newton_flow_integrated   ///< Eq. 2.16 on the same
};
/// All of them, in order.
inline constexpr std::array all_solvers = {
    Solver::newton,
    Solver::damped_newton,
    Solver::picard,
    Solver::fixed_point_printed,
    Solver::newton_flow_printed,
    Solver::fixed_point_integrated,
    Solver::newton_flow_integrated,
};
/// As in tables.
[[nodiscard]] std::string_view to_string(Solver solver);
/// Is it one of the four flows?
[[nodiscard]] bool is_flow(Solver solver);

/// When to stop, and how the flows step.
struct Effort {
  double reduction = 1e-10;     ///< done when |F| is this fraction of |F| at the start
  std::int64_t steps = 20'000;  ///< of the flows, at most
  double step = 1, turn = 0;    ///< see algebraic::ScalarHomotopy
};

/// What one solve took.
struct Cost {
  bool converged = false;       ///< |F| came down as asked, within the steps allowed
  bool diverged = false;        ///< grew beyond bounds or came to no finite number; else the steps ran out
  std::int64_t iterations = 0;  ///< updates of x
  std::int64_t functions = 0;   ///< evaluations of g, one a node
  std::int64_t jacobians = 0;   ///< evaluations of dg/dx, one a node
  double reduction = 1;         ///< of |F|, reached
  double seconds = 0;           ///< wall time
  std::vector<double> history;  ///< |F| by iteration, relative to the start

  /// Adds the work of another solve; converged only if both are.
  Cost& operator+=(const Cost& other);
};

/// The equations of an interval in both forms.
struct Interval {
  /// With these trial functions.
  Interval(const Case& c, const collocation::Basis& basis)
      : printed(c.system, basis, Form::printed), integrated(c.system, basis, Form::integrated) {}
  CollocationEquations printed;     ///< D x - g
  CollocationEquations integrated;  ///< x - (D_ss)^-1 (g - D_s1 x_1)

  /// See CollocationEquations.
  void begin(double t0, double h, const ivp::State& x0) {
    printed.begin(t0, h, x0);
    integrated.begin(t0, h, x0);
  }
};

/// Newton's iteration, damped or not, and the flows, until |F| is small; x holds the start, then the last
/// iterate.
[[nodiscard]] Cost solve(Solver solver, algebraic::Equations& equations, Eigen::VectorXd& x,
                         const Effort& effort);

/// One interval from the constant state; x receives the states at the nodes 2..N.
[[nodiscard]] Cost solve(Solver solver, Interval& interval, Eigen::VectorXd& x, const Effort& effort);

/// So many intervals of length h from the example's begin, each from the end of the one before. Stops at the
/// first that does not converge. @return the sum, and how many intervals converged
[[nodiscard]] std::pair<Cost, int> solve_row(Solver solver, const Case& c, const collocation::Basis& basis,
                                             double h, int count, const Effort& effort);

/// The largest error of a state component at a node, relative to its amplitude.
[[nodiscard]] double error_at_nodes(const Case& c, const CollocationEquations& equations,
                                    const Eigen::VectorXd& x);

}  // namespace nlmech::chapters::rbf_ivp
