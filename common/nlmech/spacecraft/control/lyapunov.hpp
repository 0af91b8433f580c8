/// @file
/// Time response of the discretised spacecraft with controller, and Lyapunov functions along it (Eqs.
/// 3.52-3.54, printed and corrected).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::spacecraft {

/// Step response of a discrete model by its matrix exponential. In the equation of the hub the controller
/// multiplies the inertia of the appendages by kappa/2,
///
///     M x'' + C x' + K (x - x_f) = 0,  M = diag(I_hub, 0) + kappa/2 M_appendages,  C = diag(k3, 0),
///     K = diag(k1, 0) + kappa/2 K_appendages,
///
/// with the state (a, b), in which V = (|a|^2 + |b|^2)/2 = x'^T M x'/2 + (x - x_f)^T K (x - x_f)/2 does not
/// grow, including rounding.
class DiscreteLoop {
 public:
  /// Initial state at rest, with target angle @p final_angle, rad.
  /// @param model discrete model of the spacecraft
  /// @param gains k1 > 0, k2 > -2, k3 >= 0
  /// @param step step size of advance(), s
  /// @throws std::invalid_argument naming what is out of range, or if a matrix is not positive definite
  DiscreteLoop(const DiscreteModel& model, const Gains& gains, double final_angle, double step);

  /// Advances by one step.
  void advance();
  /// Time, s.
  [[nodiscard]] double time() const { return static_cast<double>(steps_) * step_; }
  /// Displacements (theta, q).
  [[nodiscard]] Eigen::VectorXd displacement() const;
  /// Velocities (theta', q').
  [[nodiscard]] Eigen::VectorXd velocity() const;
  /// theta, rad.
  [[nodiscard]] double theta() const;
  /// theta', rad/s.
  [[nodiscard]] double theta_dot() const;
  /// y(x), ft.
  [[nodiscard]] double deflection(double x) const;
  /// dy(x)/dt, ft/s.
  [[nodiscard]] double deflection_dot(double x) const;
  /// V = I_hub theta'^2/2 + k1 (theta - theta_f)^2/2 + (1 + k2/2) times the energy of both appendages: Eq.
  /// 3.52 with w1 = 1 and two appendages, lb ft. Its rate is -k3 theta'^2.
  [[nodiscard]] double lyapunov() const { return state_.squaredNorm() / 2; }
  /// int (x - x_f)^T P (x - x_f) + x'^T Q x' dt from time() to infinity, by eigenvectors.
  /// @param p P: symmetric, of the size of displacement()
  /// @param q Q: symmetric, of the size of velocity()
  [[nodiscard]] double integral(const Eigen::MatrixXd& p, const Eigen::MatrixXd& q) const;
  /// int k3 theta'^2 dt over the next step, by Gauss quadrature with 10 points.
  [[nodiscard]] double dissipation() const;

 private:
  double step_, k3_, final_angle_;
  long steps_ = 0;
  Eigen::MatrixXd displacements_;  ///< x - x_f from a
  Eigen::MatrixXd velocities_;     ///< x' from b
  Eigen::MatrixXd rate_;           ///< A of (a, b)' = A (a, b)
  Eigen::MatrixXd propagator_;     ///< exp(A step)
  Eigen::MatrixXd rates_;          ///< theta' at the Gauss points from (a, b)
  Eigen::VectorXd state_, next_;   ///< (a, b)
  std::function<Eigen::VectorXd(double)> shape_;
};

/// V at one time.
struct LyapunovSample {
  double time;       ///< s
  double theta;      ///< rad
  double corrected;  ///< V with both appendages, tip inertia included, lb ft
  double printed;    ///< V of Eq. 3.52: one appendage, w3 = 1 + k2, no tip inertia, lb ft
  double balance;    ///< V(0) minus the energy dissipated by the controller: equals `corrected`
};

/// V along a time response.
struct LyapunovHistory {
  std::vector<LyapunovSample> samples;  ///< one per step, with the initial state
  double corrected_rise = 0;            ///< sum of all increases of the corrected V, relative to V(0)
  double printed_rise = 0;              ///< sum of all increases of the printed V, relative to its V(0)
  double imbalance = 0;                 ///< largest |corrected - balance|, relative to V(0)
};

/// Both Lyapunov functions along the unit step response of an assumed-modes model (Eq. 3.45 corrected).
/// @param parameters parameters of the spacecraft
/// @param gains k1 > 0, k2 > -2, k3 >= 0
/// @param modes number of modes
/// @param until final time, s
/// @param step step size, s
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] LyapunovHistory lyapunov_history(const Parameters& parameters, const Gains& gains, int modes,
                                               double until, double step);

}  // namespace nlmech::spacecraft
