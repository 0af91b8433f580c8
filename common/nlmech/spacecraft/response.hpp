/// @file
/// Motion in time by exact residues: the closed loop's answer to a step of the target angle, the open loop's
/// to a step of torque.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/residues.hpp"

namespace nlmech::spacecraft {

/// How many residues are summed.
struct ResidueOptions {
  int pairs = 0;            ///< poles of Im >= 0 that are used; 0: as many as the tolerance needs
  double tolerance = 1e-9;  ///< with pairs = 0: bound of what is left out of theta and y, relative to the
                            ///< largest residue of each
  int most = 800;           ///< with pairs = 0: no more than so many; 1 to 5000
};

/// What the residues that are left out can add up to: from the decay of the last quarter's moduli, twice the
/// integral of the power law. Larger than the true remainder (tests/spacecraft, against 8 times the pairs).
struct ResidueBounds {
  double theta = 0;                    ///< rad
  double theta_dot = 0;                ///< rad/s
  std::vector<double> deflection;      ///< ft, one a place
  std::vector<double> deflection_dot;  ///< ft/s
  double torque = 0;                   ///< lb ft
};

/// Motion from rest. All sums share their poles.
struct TimeResponse {
  ExponentialSum theta;                        ///< rad
  ExponentialSum theta_dot;                    ///< rad/s
  std::vector<double> places;                  ///< x, ft
  std::vector<ExponentialSum> deflection;      ///< y(x), ft, one a place
  std::vector<ExponentialSum> deflection_dot;  ///< y'(x) by time, ft/s
  ExponentialSum torque;                       ///< u, lb ft; closed loop only
  ResidueBounds bounds;                        ///< of what is left out
  Status status;                               ///< success, or why the sums are not the motion
};

/// The closed loop from rest, the target being theta_f = @p final_angle from t = 0 on.
///
/// theta and y are sums of terms that fall like n^-6 and n^-5; theta' n^-4; y' n^-3; u n^-4 for k2 = 0 and
/// n^-2 else (slowly and not near t = 0). Poles that coincide or nearly do, as at critical damping, are taken
/// together (loop_residues()), so that nothing cancels; fast poles are among them, however far to the left.
/// With k1 = 0 nothing moves.
///
/// theta, theta' and each y and y' have to begin with 0 within their bounds: else a pole is missing or
/// counted twice, and the status is `not_converged`. So it is if pairs are chosen by the tolerance and the
/// most that are allowed leave out more than 1e-6 of theta or a y, or a hundredth of theta' or a y' at t = 0.
///
/// Rounding is that of the largest terms: an angle that is still far below theta_f is right to eps theta_f.
///
/// Tests hold it to an independent sum of 25 pairs of poles (1e-9), to a numerical inverse of the exact
/// transform (2e-9), with double and triple poles too, and to finite elements for gains of ten decades.
/// @throws std::invalid_argument if a place is outside 0 to L, the angle is not finite, or an option is out
/// of range
[[nodiscard]] TimeResponse step_response(const ClosedLoop& loop, double final_angle,
                                         std::span<const double> places, const ResidueOptions& options = {});

/// The open loop from rest, with constant torque @p torque from t = 0 on: theta = u [t^2/(2J) + c + sum], the
/// constant from the appendages' static strain energy.
/// @throws std::invalid_argument as step_response()
[[nodiscard]] TimeResponse torque_response(const Plant& plant, double torque, std::span<const double> places,
                                           const ResidueOptions& options = {});

/// May the sums be taken at @p time? Not where they are not finite, and not where rounding of the poles
/// leaves a thousandth of the largest term open, as the phase of an undamped oscillation some 1e12 radians
/// on: then the status is `outside_validity`, naming the signal.
/// @throws std::invalid_argument if the time is negative or not finite
[[nodiscard]] Status certain_at(const TimeResponse& response, double time);

/// Static data of one appendage on a locked hub, in closed form.
struct Statics {
  double strain;  ///< int M(x)^2/EI dx for theta'' = 1: B(s) = B(0) - strain s^2 + ..., slug ft^2 s^2
  double green;   ///< G(x, x) = x^3/(3 EI): deflection at x by a unit force there, ft/lb
  double square;  ///< C(x) = [rho int G(x, xi)^2 dxi + m G(x, L)^2 + I_tip (dG/dxi(x, L))^2]/2, ft^2 s^2/lb
};

/// Statics at @p x.
/// @throws std::invalid_argument if x is outside 0 to L, or as require_physical()
[[nodiscard]] Statics statics(const Parameters& parameters, double x);

}  // namespace nlmech::spacecraft
