/// @file
/// Closed loop of spacecraft and Lyapunov controller: transfer functions, poles, stability (corrected Eqs.
/// 3.55-3.59).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/spacecraft/plant/roots.hpp"

namespace nlmech::spacecraft {

/// The control law u = -[k1 (theta - theta_f) + k2 (r S_0 - M_0) + k3 theta'] (Eq. 3.55), with the root load
/// of one appendage including its tip body. Supports of the tips are part of that load: it is s^2 B theta.
struct Gains {
  double k1 = 0;  ///< gain of the angle, lb ft/rad
  double k2 = 0;  ///< gain of the root load, -
  double k3 = 0;  ///< gain of the rate, lb ft s/rad
};

/// Gains of figures 3.13 and 3.14.
inline constexpr Gains unit_gains{1, 1, 1};
/// Gains that the source selects, figures 3.15-3.20.
inline constexpr Gains designed_gains{12, 0, 16};

/// Closed-loop transfer functions at one s.
struct LoopResponse {
  Complex theta;       ///< k1/P(s), -
  Complex deflection;  ///< g_3(x) k1/P(s), ft
  Outcome outcome;     ///< success; at_pole; non_finite
};

/// Terms of the residues at a simple pole, or on a circle around several poles. All have one common positive
/// factor.
struct LoopTerms {
  Jet characteristic;           ///< Q = D_0 P, entire; with its derivative
  Complex inertia;              ///< (I_hub + (2 + k2) B) D_0
  Complex determinant;          ///< D_0
  Complex open_loop;            ///< (I_hub + 2B) D_0
  std::vector<Complex> shapes;  ///< g_3(x) D_0/s^2, one per place
};

/// Poles of the closed loop.
struct LoopPoles {
  std::vector<Complex> s;  ///< Im s >= 0, by modulus; s = 0 is not listed
  Status status;           ///< success: no pole with a modulus up to that of the last one is missing
};

/// Order in which a list of poles is complete.
enum class PoleOrder : std::uint8_t {
  modulus,   ///< no pole with a modulus up to that of the last one is missing
  frequency  ///< the poles of `modulus`, and all others whose imaginary part is at most the largest of
             ///< theirs, however fast they decay
};

/// Closed loop of plant and controller:
///
///     theta/theta_f = k1/P(s),   y(x)/theta_f = g_3(x) k1/P(s),   P = s^2 (I_hub + (2 + k2) B) + k3 s + k1.
///
/// Stable if k1 > 0, k3 > 0 and k2 > -2, for every spacecraft without structural damping: the real part of
/// P(s)/s = s (I_hub + (2 + k2) B) + k3 + k1/s is then at least k3 for Re s >= 0. The bound k2 > -1 of the
/// source is sufficient but not necessary. At k2 = -2 the appendages do not act on the hub and vibrate
/// without damping.
///
/// Tests compare the poles with those of tools/oracles (relative 1e-12 and 5e-12) and with the zeros of the
/// exact characteristic function (2e-12). They count the poles by the argument principle, for completeness
/// and for stability.
class ClosedLoop {
 public:
  /// @throws std::invalid_argument naming a gain that is not finite or out of range (k1 >= 0, k2 > -2,
  /// k3 >= 0), or as require_physical()
  ClosedLoop(const Parameters& parameters, const Gains& gains);

  /// The open-loop spacecraft.
  [[nodiscard]] const Plant& plant() const { return plant_; }
  /// The parameters of the spacecraft.
  [[nodiscard]] const Parameters& parameters() const { return plant_.parameters(); }
  /// The gains.
  [[nodiscard]] const Gains& gains() const { return gains_; }
  /// 2 + k2: factor of one appendage's inertia B in P(s).
  [[nodiscard]] double kappa() const { return 2 + gains_.k2; }

  /// Both transfer functions at @p s; relative accuracy 1e-12 max(1, |s G'/G|).
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] LoopResponse response(Complex s, double x) const;
  /// theta/theta_f at @p s.
  [[nodiscard]] LoopResponse response(Complex s) const { return response(s, 0); }
  /// Characteristic function Q(s) = D_0(s) P(s), entire, divided by s if k1 = 0 and by s^2 if k1 = k3 = 0.
  /// Value and slope have a common positive factor.
  [[nodiscard]] Jet characteristic(Complex s) const;
  /// Terms of the residues at @p s.
  /// @param x places, 0 to L; not checked
  [[nodiscard]] LoopTerms terms(Complex s, std::span<const double> x) const;

  /// The first @p count poles by modulus, to 12 digits of the modulus (tests/spacecraft). Poles are counted
  /// in bands by the argument principle. Poles far to the left, as one near -k3/I_hub, are computed
  /// separately: there waves from the tip are negligible, and P is a polynomial. (With a clamped root and a
  /// free tip alone; with others the status is `outside_validity` if such a pole is possible.)
  /// @returns the poles; with PoleOrder::frequency more than @p count if some decay too fast to be among the
  /// first by modulus
  /// @throws std::invalid_argument if count is not 1 to 5000, or if Parameters::swings()
  [[nodiscard]] LoopPoles poles(int count, PoleOrder order = PoleOrder::modulus) const;

 private:
  [[nodiscard]] double least_real_part(double top) const;
  [[nodiscard]] std::vector<Complex> fast_poles() const;
  [[nodiscard]] Roots band(double bottom, double& top, double next, double& left) const;
  [[nodiscard]] Complex on_real_axis(Complex s) const;
  [[nodiscard]] std::vector<Complex> settled(const std::vector<Complex>& roots) const;
  Plant plant_;
  Gains gains_;
};

}  // namespace nlmech::spacecraft
