/// @file
/// Time response by exact residues: closed loop to a step of the target angle, open loop to a step of torque.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/residues.hpp"

namespace nlmech::spacecraft {

/// Truncation of the sum of residues.
struct ResidueOptions {
  int pairs = 0;            ///< number of poles with Im >= 0; 0: as many as the tolerance needs
  double tolerance = 1e-9;  ///< with pairs = 0: bound of the truncation error of theta and y, relative to the
                            ///< largest residue of each
  int most = 800;           ///< with pairs = 0: largest number of poles; 1 to 5000
};

/// Bounds of the truncation error: twice the integral of a power law fitted to the decay of the last quarter
/// of the moduli. Larger than the exact remainder (tests/spacecraft, against 8 times the pairs).
struct ResidueBounds {
  double theta = 0;                    ///< rad
  double theta_dot = 0;                ///< rad/s
  std::vector<double> deflection;      ///< ft, one per place
  std::vector<double> deflection_dot;  ///< ft/s
  double torque = 0;                   ///< lb ft
};

/// Time response from rest. All sums have the same poles.
struct TimeResponse {
  ExponentialSum theta;                        ///< rad
  ExponentialSum theta_dot;                    ///< rad/s
  std::vector<double> places;                  ///< x, ft
  std::vector<ExponentialSum> deflection;      ///< y(x), ft, one per place
  std::vector<ExponentialSum> deflection_dot;  ///< dy(x)/dt, ft/s
  ExponentialSum torque;                       ///< u, lb ft; closed loop only
  ResidueBounds bounds;                        ///< of the truncation error
  Status status;                               ///< success, or why the sums are not reliable
};

/// Closed-loop response from rest to a step of the target angle to theta_f = @p final_angle at t = 0.
///
/// The terms fall like n^-6 for theta, n^-5 for y, n^-4 for theta', n^-3 for y', and for u like n^-4 if k2 =
/// 0 and else n^-2 (u converges slowly, and not near t = 0). Coincident and nearly coincident poles, as at
/// critical damping, are summed together (loop_residues()), which avoids cancellation. Fast poles are
/// included, however large their decay. With k1 = 0 the response is 0.
///
/// The status is `not_converged` if theta, theta', a y or a y' differs from 0 at t = 0 by more than its
/// bound, because a pole is missing or counted twice. It is also `not_converged` if the tolerance chooses the
/// number of pairs and the largest number truncates more than 1e-6 of theta or a y, or a hundredth of theta'
/// or a y' at t = 0.
///
/// Rounding errors are relative to the largest terms: an angle far below theta_f has an error of eps theta_f.
///
/// Tests compare it with an independent sum of 25 pairs of poles (1e-9), with a numerical inverse of the
/// exact transform (2e-9; also for double and triple poles), and with finite elements for gains over ten
/// decades.
/// @throws std::invalid_argument if a place is outside 0 to L, the angle is not finite, or an option is out
/// of range
[[nodiscard]] TimeResponse step_response(const ClosedLoop& loop, double final_angle,
                                         std::span<const double> places, const ResidueOptions& options = {});

/// Where a torque acts.
enum class Input : std::uint8_t {
  hub,  ///< on the hub
  tips  ///< on each of the two tips
};

/// Open-loop response from rest to the constant torque u = @p torque from t = 0 on: theta = u [t^2/(2J) + c +
/// sum], with c from the static strain energy of the appendages; with Input::tips to that torque on each tip.
///
/// The terms of a torque on free tips without inertia fall like n^-3 for y and n^-1 for y', and the status is
/// `not_converged` where a place is given; with tip_inertia they fall faster.
///
/// Tests compare both inputs with finite elements.
/// @throws std::invalid_argument as step_response(), or if Parameters::swings(): nothing limits y
[[nodiscard]] TimeResponse torque_response(const Plant& plant, double torque, std::span<const double> places,
                                           const ResidueOptions& options = {}, Input input = Input::hub);

/// Whether the sums are accurate at @p time. Returns `non_finite` if a sum is not finite, and
/// `outside_validity`, naming the signal, if rounding of the poles can change it by more than a thousandth of
/// its largest term, as for the phase of an undamped oscillation after some 1e12 radians.
/// @throws std::invalid_argument if the time is negative or not finite
[[nodiscard]] Status certain_at(const TimeResponse& response, double time);

/// Static coefficients of one appendage on a locked hub, in closed form.
struct Statics {
  double strain;  ///< int M(x)^2/EI dx for theta'' = 1: B(s) = B(0) - strain s^2 + ..., slug ft^2 s^2
  double green;   ///< G(x, x) = x^3/(3 EI): deflection at x under a unit force at x, ft/lb
  double square;  ///< C(x) = [rho int G(x, xi)^2 dxi + m G(x, L)^2 + I_tip (dG/dxi(x, L))^2]/2, ft^2 s^2/lb
};

/// Statics at @p x.
/// @throws std::invalid_argument if x is outside 0 to L, or as require_physical() and require_cantilever()
[[nodiscard]] Statics statics(const Parameters& parameters, double x);

}  // namespace nlmech::spacecraft
