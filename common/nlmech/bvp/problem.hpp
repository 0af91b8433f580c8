/// @file
/// A boundary value problem: x' = f(t, x, p) with conditions at both ends and at points between.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace nlmech::bvp {

/// x' = f(t, x, p) for n states x(t) and m unknown constants p, on K phases: the pieces into which the points
/// t_0 < t_1 < ... < t_K divide the time. At a point between, x may jump, so each phase has two ends of its
/// own, and n K + m conditions r(ends, p) = 0 determine the solution: prescribed values, the continuity of
/// what does not jump, and whatever else holds at the points. Sizes are run-time values.
///
/// DualProblem makes a problem of equations written once, with derivatives by dual numbers. For derivatives
/// by hand derive from this class.
class Problem {
 public:
  virtual ~Problem() = default;

  /// n >= 1.
  [[nodiscard]] virtual int states() const = 0;
  /// m >= 0: unknown constants, such as a final time or a multiplier.
  [[nodiscard]] virtual int parameters() const { return 0; }
  /// t_0 < t_1 < ... < t_K, finite; K >= 1. Between them f may jump: at such a point rhs() is the limit from
  /// the right.
  [[nodiscard]] virtual std::vector<double> points() const = 0;

  /// dxdt = f(t, x, p), which has n components already.
  virtual void rhs(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p,
                   Eigen::VectorXd& dxdt) const = 0;
  /// by_state = df/dx, n by n, and by_parameter = df/dp, n by m, which have these sizes already.
  virtual void jacobian(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& p,
                        Eigen::MatrixXd& by_state, Eigen::MatrixXd& by_parameter) const = 0;
  /// r(ends, p). Columns 2k and 2k + 1 of @p ends are x at the start and at the end of phase k.
  virtual void conditions(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p,
                          Eigen::VectorXd& r) const = 0;
  /// dr/d(ends), its columns in the order of ends.reshaped(), and dr/dp; sizes are set already.
  virtual void condition_jacobian(const Eigen::MatrixXd& ends, const Eigen::VectorXd& p,
                                  Eigen::MatrixXd& by_ends, Eigen::MatrixXd& by_parameter) const = 0;

  /// K.
  [[nodiscard]] int phases() const { return static_cast<int>(points().size()) - 1; }
  /// n K + m.
  [[nodiscard]] int condition_count() const { return states() * phases() + parameters(); }
};

/// Start of Newton's iteration: a function of time, and the unknown constants.
struct Start {
  std::function<void(double t, Eigen::VectorXd& x)> states;  ///< writes x(t); x has n components already
  Eigen::VectorXd parameters = {};                           ///< m of them
  std::vector<double> mesh = {};  ///< first mesh: ascending times, both ends and all points among them;
                                  ///< empty: equal intervals
};

/// The same state at all times: constant_start(VectorXd::Zero(n)), or Ones.
[[nodiscard]] Start constant_start(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters = {});

/// A cubic in time for each state, with coefficients in Chebyshev polynomials of [t0, t1] equally distributed
/// in +-amplitude_i: smooth random starts, the same for the same seed on every machine.
/// @throws std::invalid_argument unless t0 < t1
[[nodiscard]] Start random_start(const Eigen::VectorXd& amplitudes, double t0, double t1, unsigned seed,
                                 const Eigen::VectorXd& parameters = {});

/// @throws std::invalid_argument naming what is wrong with the sizes or points of a problem
void check_problem(const Problem& problem);

}  // namespace nlmech::bvp
