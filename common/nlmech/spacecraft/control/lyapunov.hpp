/// @file
/// A discretised spacecraft under the controller, in time, and Lyapunov functions along its motion (Eqs.
/// 3.52-3.54, printed and corrected).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::spacecraft {

/// The step response of a discrete model by its matrix exponential. The controller acts on the hub's balance
/// as if the appendages weighed kappa/2 of what they do,
///
///     M x'' + C x' + K (x - x_f) = 0,  M = diag(I_hub, 0) + kappa/2 M_appendages,  C = diag(k3, 0),
///     K = diag(k1, 0) + kappa/2 K_appendages,
///
/// and in coordinates a, b in which V = (|a|^2 + |b|^2)/2 = x'^T M x'/2 + (x - x_f)^T K (x - x_f)/2 the
/// motion never grows, rounding included.
class DiscreteLoop {
 public:
  /// From rest, the target being @p final_angle.
  /// @param model of the spacecraft
  /// @param gains k1 > 0, k2 > -2, k3 >= 0
  /// @param step of advance(), s
  /// @throws std::invalid_argument naming what is out of range, or if a matrix is not positive definite
  DiscreteLoop(const DiscreteModel& model, const Gains& gains, double final_angle, double step);

  /// One step.
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
  /// V = I_hub theta'^2/2 + k1 (theta - theta_f)^2/2 + (1 + k2/2) times the energy of both appendages:
  /// Eq. 3.52 with w1 = 1 and two appendages, lb ft. Falls by k3 theta'^2.
  [[nodiscard]] double lyapunov() const { return state_.squaredNorm() / 2; }
  /// int (x - x_f)^T P (x - x_f) + x'^T Q x' dt from now on for ever, by the eigenvectors of the motion.
  /// @param p symmetric, as large as displacement()
  /// @param q symmetric, as large as velocity()
  [[nodiscard]] double integral(const Eigen::MatrixXd& p, const Eigen::MatrixXd& q) const;
  /// int k3 theta'^2 dt over the step that advance() would make, by Gauss's rule with 10 points.
  [[nodiscard]] double dissipation() const;

 private:
  double step_, k3_, final_angle_;
  long steps_ = 0;
  Eigen::MatrixXd displacements_;  ///< x - x_f from a
  Eigen::MatrixXd velocities_;     ///< x' from b
  Eigen::MatrixXd rate_;           ///< A of (a, b)' = A (a, b)
  Eigen::MatrixXd propagator_;     ///< exp(A step)
  Eigen::MatrixXd rates_;          ///< theta' at the points of Gauss's rule
  Eigen::VectorXd state_, next_;   ///< (a, b)
  std::function<Eigen::VectorXd(double)> shape_;
};

/// V at one time.
struct LyapunovSample {
  double time;       ///< s
  double theta;      ///< rad
  double corrected;  ///< V with both appendages, tip inertia included, lb ft
  double printed;    ///< V of Eq. 3.52: one appendage, w3 = 1 + k2, no tip inertia, lb ft
  double balance;    ///< V(0) minus what the controller has dissipated: equals `corrected`
};

/// V along a motion.
struct LyapunovHistory {
  std::vector<LyapunovSample> samples;  ///< one a step, the start included
  double corrected_rise = 0;            ///< all rises of the corrected V, over V(0)
  double printed_rise = 0;              ///< all rises of the printed V, over its V(0)
  double imbalance = 0;                 ///< largest |corrected - balance| over V(0)
};

/// The step response of assumed modes (Eq. 3.45 corrected) with both functions.
/// @param parameters the spacecraft
/// @param gains k1 > 0, k2 > -2, k3 >= 0
/// @param modes of the model
/// @param until end, s
/// @param step s
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] LyapunovHistory lyapunov_history(const Parameters& parameters, const Gains& gains, int modes,
                                               double until, double step);

}  // namespace nlmech::spacecraft
