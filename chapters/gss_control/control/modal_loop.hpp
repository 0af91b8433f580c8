/// @file
/// Closed loop of a truncated, diagonalised model as a system of ordinary differential equations.
#pragma once

#include <Eigen/Core>

#include "nlmech/ivp/system.hpp"
#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::chapters::gss_control {

/// eta_i'' + omega_i^2 eta_i = b_i u, theta = theta_0 + sum b_i eta_i, J theta_0'' = u, and the controller
/// (3.55) with the root load (u - I_hub theta'')/2. State: theta_0, eta, and their rates; 0 at rest.
struct ModalLoop {
  static constexpr int dimension = Eigen::Dynamic;
  double hub_inertia, rigid;    ///< I_hub; 1/J
  Eigen::VectorXd omega, gain;  ///< omega_i; b_i
  spacecraft::Gains gains;
  double target;  ///< theta_f

  ModalLoop(const spacecraft::ModalModel& model, const spacecraft::Gains& k, double final_angle)
      : hub_inertia(model.hub_inertia),
        rigid(1 / model.total_inertia),
        omega(model.omega),
        gain(model.participation),
        gains(k),
        target(final_angle) {}

  [[nodiscard]] int size() const { return 2 * static_cast<int>(omega.size() + 1); }

  template <class T>
  void operator()(const T&, const Vector<T, dimension>& x, Vector<T, dimension>& dxdt) const {
    const Eigen::Index n = omega.size() + 1;
    T angle = x[0], rate = x[n], load(0.);
    double mobility = rigid;  // theta'' per torque at fixed eta
    for (Eigen::Index i = 1; i < n; ++i) {
      const double b = gain[i - 1], w = omega[i - 1];
      angle = angle + b * x[i];
      rate = rate + b * x[n + i];
      load = load + (b * w * w) * x[i];
      mobility += b * b;
    }
    // The control law with theta'' = mobility u - load, solved for u.
    const T u = -(gains.k1 * (angle - target) + gains.k3 * rate + (gains.k2 / 2 * hub_inertia) * load) /
                (1 + gains.k2 / 2 - gains.k2 / 2 * hub_inertia * mobility);
    dxdt[0] = x[n];
    dxdt[n] = rigid * u;
    for (Eigen::Index i = 1; i < n; ++i) {
      dxdt[i] = x[n + i];
      dxdt[n + i] = gain[i - 1] * u - (omega[i - 1] * omega[i - 1]) * x[i];
    }
  }

  /// Hub angle of a state.
  [[nodiscard]] double angle(const Eigen::VectorXd& x) const {
    return x[0] + gain.dot(x.segment(1, gain.size()));
  }
};

}  // namespace nlmech::chapters::gss_control
