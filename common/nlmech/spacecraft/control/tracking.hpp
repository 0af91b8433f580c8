/// @file
/// The closed loop that follows a smooth reference angle, exactly: with the controller of the source, and
/// with the torque of the rigid spacecraft fed forward.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::spacecraft {

/// A turn from rest to rest: r(t) = angle times the polynomial of degree 2 smoothness + 1 whose derivatives 1
/// to smoothness vanish at 0 and at the end; constant before and after.
class SmoothTurn {
 public:
  /// @param angle of the turn, rad
  /// @param duration T > 0, s
  /// @param smoothness 1 to 6
  /// @throws std::invalid_argument naming what is out of range
  SmoothTurn(double angle, double duration, int smoothness = 3);

  /// Of the turn, rad.
  [[nodiscard]] double angle() const { return angle_; }
  /// T, s.
  [[nodiscard]] double duration() const { return duration_; }
  /// Derivatives that vanish at both ends.
  [[nodiscard]] int smoothness() const { return smoothness_; }
  /// r(t), or its derivative of @p order; before and after the turn, and beyond the degree, 0 for order > 0.
  [[nodiscard]] double value(double time, int order = 0) const;

 private:
  friend class Tracking;  // and its Course
  [[nodiscard]] double polynomial(double time, int order) const;
  double angle_, duration_;
  int smoothness_;
  std::vector<double> coefficients_;  ///< of (t/T)^k
};

/// The control law.
enum class TrackingLaw : std::uint8_t {
  regulator,   ///< Eq. 3.55 with r(t) for theta_f: it lags behind by k3/k1 r'
  feedforward  ///< u = J r'' - k1 (theta - r) - k2 (r S_0 - M_0 - B_0 r'') - k3 (theta' - r')
};

/// Motion at one time.
struct TrackedMotion {
  double theta;                    ///< rad
  double theta_dot;                ///< rad/s
  double error;                    ///< theta - r, rad, to its own accuracy
  std::vector<double> deflection;  ///< y(x), ft, one a place
};

/// Motion from rest along a turn, by residues: theta - r = sum_p q_p int_0^t e^(p (t - tau)) r^(j)(tau) dtau.
/// The integrals are exact: by parts where |p| t is large, by Gauss's rule where it is small, so nothing
/// cancels, neither for slow poles nor fast ones.
///
/// With the regulator theta - r begins with -k3/k1 r'. With the torque fed forward (theta - r)/r is of order
/// s^4: theta - r is about kappa strain/k1 times r'''' for a slow turn, strain as in Statics.
///
/// Tests hold it to the numerical inverse of its transform, to 1e-7.
class Tracking {
 public:
  /// @param loop with k1 > 0
  /// @param turn the reference
  /// @param places of the deflection
  /// @throws std::invalid_argument naming what is out of range
  Tracking(const ClosedLoop& loop, const SmoothTurn& turn, TrackingLaw law, std::span<const double> places,
           const ResidueOptions& options = {});

  /// At @p time >= 0, before and after the turn's end.
  /// @throws std::invalid_argument if the time is negative or not finite
  [[nodiscard]] TrackedMotion at(double time) const;
  /// The reference.
  [[nodiscard]] const SmoothTurn& turn() const { return turn_; }
  /// success, or what the poles' was.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  /// Weights of e and of each y for one pole.
  struct Term {
    Complex pole, error;
    std::vector<Complex> deflection;
  };
  /// What the integrals of all poles want of the turn up to one time.
  struct Course;
  [[nodiscard]] Complex convolution(Complex pole, const Course& course, int order) const;

  SmoothTurn turn_;
  int error_order_, deflection_order_;  ///< the derivative of r that drives each
  std::vector<double> quasi_static_;    ///< y(x)/r'' in the limit of slow turns, where it is split off
  std::vector<Term> terms_;
  Status status_;
};

}  // namespace nlmech::spacecraft
