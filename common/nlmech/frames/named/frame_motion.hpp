/// @file
/// Motion of a frame in time: equations of motion for integrators, load histories and energies.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::frames {

/// Load factor as a function of time, from 0 on.
struct LoadHistory {
  /// Form of the load history.
  enum class Kind : std::uint8_t {
    step,  ///< constant
    ramp,  ///< grows linearly during the duration, then constant
    pulse  ///< constant during the duration, then zero
  };
  Kind kind = Kind::step;  ///< form
  double factor = 1;       ///< greatest load factor, finite
  double duration = 0;     ///< duration of ramp or pulse, positive

  /// Load factor at time t; at a jump the value after it.
  [[nodiscard]] double at(double t) const;
};

/// The equations of motion M x'' + C x' + dU/dx = W(t) q + q0 of a frame with lumped masses and Rayleigh's
/// damping: a problem for ivp::System with the state (displacements, velocities). Where the frame has no
/// valid forces, accelerations are NaN, which integrators report.
///
/// Tests compare frequencies with those of the Euler-Bernoulli beam (error m^-2 for m elements with lumped
/// masses), and the Jacobian with differences.
class FrameMotion {
 public:
  static constexpr int dimension = Eigen::Dynamic;  ///< size of the state

  /// @param frame must outlive this object
  /// @param history load history
  /// @param start displacements at the start, such as those of start_of(); empty: 0
  /// @throws ModelError if an unknown has no mass (names a member), or if displacements are prescribed
  /// @throws std::invalid_argument if the load history is not finite, or a ramp or pulse has no positive
  /// duration
  FrameMotion(const NamedFrame& frame, const LoadHistory& history, Eigen::VectorXd start = {});

  /// Number of components of the state.
  [[nodiscard]] int size() const { return 2 * static_cast<int>(frame_->frame.size()); }
  /// State at rest, in the displacements of the start.
  [[nodiscard]] Eigen::VectorXd rest() const {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(size());
    if (start_.size() > 0) state.head(start_.size()) = start_;
    return state;
  }
  /// Derivative of the state.
  void operator()(const double& t, const Eigen::VectorXd& x, Eigen::VectorXd& dxdt) const;
  /// Accelerations x'' for displacements q and velocities v.
  void acceleration(const double& t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    Eigen::VectorXd& a) const;
  /// Jacobian of the derivative of the state.
  void jacobian(double t, const Eigen::VectorXd& x, Eigen::MatrixXd& j) const;
  /// Times between t0 and t1 at which the load history or its slope jumps.
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const;

  /// The frame.
  [[nodiscard]] const NamedFrame& frame() const { return *frame_; }
  /// The load history.
  [[nodiscard]] const LoadHistory& history() const { return history_; }
  /// Damping matrix C, with the stiffness at rest.
  [[nodiscard]] const Eigen::SparseMatrix<double>& damping() const { return damping_; }
  /// Greatest angular frequency of small motions about rest, rad per time; explicit integrators need step
  /// sizes of about 2 over it. By power iteration, from below, within a tenth.
  [[nodiscard]] double highest_frequency() const;

 private:
  const NamedFrame* frame_;
  LoadHistory history_;
  Eigen::VectorXd start_;
  Eigen::SparseMatrix<double> damping_, stiffness_;
};

/// Energy balance of a motion, accumulated over the steps.
class FrameEnergies {
 public:
  /// @param motion must outlive this object
  explicit FrameEnergies(const FrameMotion& motion);

  /// Adds one step. The load factor is linear in time within a step, so the work needs the integral of the
  /// displacements; the dissipation needs that of the squared velocities. Both by three-point Gauss
  /// quadrature on the dense output of the step.
  /// @tparam Step of an observer of integrators
  template <class Step>
  void take(const Step& step) {
    const double middle = (step.t0 + step.t1) / 2, half = (step.t1 - step.t0) / 2;
    double moved = 0, lost = 0;
    for (const auto& [place, weight] : gauss) {
      const Eigen::VectorXd x = step.at(middle + place * half);
      moved += weight * half * along_load(x);
      lost += weight * half * damping_power(x);
    }
    add(step.t0, step.t1, moved, lost, step.x0, step.x1);
  }

  double kinetic = 0;     ///< kinetic energy
  double strain = 0;      ///< strain energy
  double work = 0;        ///< work of the loads since the start
  double dissipated = 0;  ///< energy dissipated by damping
  double greatest = 0;    ///< maximum of kinetic plus strain energy so far
  /// Maximum error so far of the energy balance |kinetic + strain - strain at rest + dissipated - work|; 0
  /// for an exact motion.
  double imbalance = 0;

 private:
  static constexpr std::array<std::array<double, 2>, 3> gauss = {
      {{-0.7745966692414834, 5. / 9}, {0, 8. / 9}, {0.7745966692414834, 5. / 9}}};
  [[nodiscard]] double along_load(const Eigen::VectorXd& x) const;
  [[nodiscard]] double damping_power(const Eigen::VectorXd& x) const;
  void add(double t0, double t1, double moved, double lost, const Eigen::VectorXd& x0,
           const Eigen::VectorXd& x1);

  const FrameMotion* motion_;
  double at_rest_;  ///< strain energy
};

}  // namespace nlmech::frames
