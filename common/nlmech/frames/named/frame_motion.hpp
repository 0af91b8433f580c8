/// @file
/// The motion of a frame in time: its equations for integrators, its energies, and the loads that cannot make
/// it buckle.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::frames {

/// A load factor over time, from 0 on.
struct LoadHistory {
  /// Its form.
  enum class Kind : std::uint8_t {
    step,  ///< all of it, for ever
    ramp,  ///< grows evenly for the duration, and stays
    pulse  ///< all of it for the duration, and then nothing
  };
  Kind kind = Kind::step;  ///< which
  double factor = 1;       ///< the greatest, finite
  double duration = 0;     ///< of ramp or pulse, positive

  /// At a time; where it jumps, what comes after.
  [[nodiscard]] double at(double t) const;
};

/// The equations of motion M x'' + C x' + dU/dx = W(t) q of a frame with lumped masses and Rayleigh's
/// damping: a problem for ivp::System, whose state is displacements and then velocities. Where the frame has
/// no force, accelerations are NaN, which integrators report.
///
/// Tests hold frequencies to those of Euler-Bernoulli's beam, which lumped masses approach like m^-2, and the
/// Jacobian to differences.
class FrameMotion {
 public:
  static constexpr int dimension = Eigen::Dynamic;  ///< of the state

  /// @param frame must outlive this object
  /// @param history of its loads
  /// @throws ModelError if an unknown has no mass, blaming a member, or if displacements are given
  /// @throws std::invalid_argument for a history that is not finite, or without a duration that it needs
  FrameMotion(const NamedFrame& frame, const LoadHistory& history);

  /// Number of components of the state.
  [[nodiscard]] int size() const { return 2 * static_cast<int>(frame_->frame.size()); }
  /// At rest.
  [[nodiscard]] Eigen::VectorXd rest() const { return Eigen::VectorXd::Zero(size()); }
  /// The state's derivative.
  void operator()(const double& t, const Eigen::VectorXd& x, Eigen::VectorXd& dxdt) const;
  /// x'' of displacements and velocities.
  void acceleration(const double& t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    Eigen::VectorXd& a) const;
  /// Of the state's derivative by the state.
  void jacobian(double t, const Eigen::VectorXd& x, Eigen::MatrixXd& j) const;
  /// Where the load jumps or bends.
  [[nodiscard]] std::vector<double> discontinuities(double t0, double t1) const;

  /// The frame.
  [[nodiscard]] const NamedFrame& frame() const { return *frame_; }
  /// Its load.
  [[nodiscard]] const LoadHistory& history() const { return history_; }
  /// C, with the stiffness at rest.
  [[nodiscard]] const Eigen::SparseMatrix<double>& damping() const { return damping_; }
  /// The greatest frequency of small motions about rest, rad over time: explicit integrators need steps of
  /// some 2 over it. By power iteration, from below, within a tenth.
  [[nodiscard]] double highest_frequency() const;

 private:
  const NamedFrame* frame_;
  LoadHistory history_;
  Eigen::SparseMatrix<double> damping_, stiffness_;
};

/// Where the energy of a motion is, added up from step to step.
class FrameEnergies {
 public:
  /// @param motion must outlive this object
  explicit FrameEnergies(const FrameMotion& motion);

  /// Goes on to the end of a step from the end of the last one. Work of a load factor that is linear in time,
  /// as it is within a step, needs the integral of displacements, dissipation that of velocities squared: by
  /// Gauss' rule of three points on the step's dense output.
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

  double kinetic = 0;     ///< of the masses
  double strain = 0;      ///< of the members
  double work = 0;        ///< that the loads have done
  double dissipated = 0;  ///< by the damping
  double greatest = 0;    ///< kinetic energy and strain energy together, at most so far
  /// Of all energy the part that is too much or missing: 0 of an exact motion; at most so far.
  double imbalance = 0;

 private:
  static constexpr std::array<std::array<double, 2>, 3> gauss = {
      {{-0.7745966692414834, 5. / 9}, {0, 8. / 9}, {0.7745966692414834, 5. / 9}}};
  [[nodiscard]] double along_load(const Eigen::VectorXd& x) const;
  [[nodiscard]] double damping_power(const Eigen::VectorXd& x) const;
  void add(double t0, double t1, double moved, double lost, const Eigen::VectorXd& x0,
           const Eigen::VectorXd& x1);

  const FrameMotion* motion_;
};

}  // namespace nlmech::frames
