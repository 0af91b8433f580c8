/// @file
/// Boundary value problem: x' = f(t, x, p) with conditions at both ends and at interior points.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace nlmech::bvp {

/// x' = f(t, x, p) for n states x(t) and m unknown constants p, on K phases between the points t_0 < t_1 <
/// ... < t_K. At an interior point x may jump, so each phase has its own two ends. The n K + m conditions
/// r(ends, p) = 0 determine the solution: prescribed values, continuity of the components that do not jump,
/// and other conditions at the points. Sizes are run-time values.
///
/// DualProblem creates a problem from templates, with derivatives by dual numbers. For derivatives by hand
/// derive from this class.
class Problem {
 public:
  virtual ~Problem() = default;

  /// n >= 1.
  [[nodiscard]] virtual int states() const = 0;
  /// m >= 0: unknown constants, such as a final time or a multiplier.
  [[nodiscard]] virtual int parameters() const { return 0; }
  /// t_0 < t_1 < ... < t_K, finite; K >= 1. At an interior point f may jump; rhs() is then the limit from the
  /// right.
  [[nodiscard]] virtual std::vector<double> points() const = 0;

  /// Is f not finite at an end of the interval, although the solution is? Then it is not evaluated there. A
  /// singular coefficient as in x'' + 2 x'/t needs the condition that makes the solution regular, x'(0) = 0.
  [[nodiscard]] virtual bool is_singular_at_ends() const { return false; }

  /// Sets dxdt = f(t, x, p); dxdt has size n.
  virtual void rhs(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p,
                   Eigen::VectorXd& dxdt) const = 0;
  /// Sets by_state = df/dx, n by n, and by_parameter = df/dp, n by m; both have these sizes.
  virtual void jacobian(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p,
                        Eigen::MatrixXd& by_state, Eigen::MatrixXd& by_parameter) const = 0;
  /// Sets r(ends, p). Columns 2k and 2k + 1 of @p ends are x at the start and at the end of phase k.
  virtual void conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p,
                          Eigen::VectorXd& r) const = 0;
  /// Sets dr/d(ends), with columns in the order of ends.reshaped(), and dr/dp; sizes are set by the caller.
  virtual void condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p,
                                  Eigen::MatrixXd& by_ends, Eigen::MatrixXd& by_parameter) const = 0;

  /// Name in messages of state i or, for i >= n, of parameter i - n.
  [[nodiscard]] virtual std::string unknown_name(int i) const;

  /// Sizes of the n states and m parameters against which errors are measured where the solution is smaller,
  /// as a co-state that is zero. Empty: the sizes of the solution alone.
  [[nodiscard]] virtual Eigen::VectorXd least_sizes() const { return {}; }

  /// K.
  [[nodiscard]] int phases() const { return static_cast<int>(points().size()) - 1; }
  /// n K + m.
  [[nodiscard]] int condition_count() const { return states() * phases() + parameters(); }
};

/// Initial guess for Newton's iteration: states as a function of time, and the unknown constants.
struct Start {
  std::function<void(double t, Eigen::VectorXd& x)> states;  ///< sets x(t); x has size n
  Eigen::VectorXd parameters = {};                           ///< initial guess of the m unknown constants
  std::vector<double> mesh =
      {};  ///< first mesh: ascending times, including both ends and all points; empty: equal intervals
};

/// Constant initial guess, for example constant_start(VectorXd::Zero(n)).
[[nodiscard]] Start constant_start(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters = {});

/// Random smooth initial guess: for each state a cubic in time on [t0, t1], with Chebyshev coefficients
/// uniformly distributed in +-amplitude_i. Equal seeds give equal results on every machine.
/// @throws std::invalid_argument unless t0 < t1
[[nodiscard]] Start random_start(const Eigen::VectorXd& amplitudes, double t0, double t1, unsigned seed,
                                 const Eigen::VectorXd& parameters = {});

/// @throws std::invalid_argument naming the invalid size or point of a problem
void check_problem(const Problem& problem);

}  // namespace nlmech::bvp
