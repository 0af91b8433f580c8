/// @file
/// The spacecraft under the Lyapunov controller: transfer functions, all poles, stability (corrected Eqs.
/// 3.55-3.59).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/spacecraft/plant/roots.hpp"

namespace nlmech::spacecraft {

/// The control law u = -[k1 (theta - theta_f) + k2 (r S_0 - M_0) + k3 theta'] (Eq. 3.55), with the root load
/// of one appendage, its tip body included.
struct Gains {
  double k1 = 0;  ///< on the angle, lb ft/rad
  double k2 = 0;  ///< on the root load, -
  double k3 = 0;  ///< on the rate, lb ft s/rad
};

/// The gains of figures 3.13 and 3.14.
inline constexpr Gains unit_gains{1, 1, 1};
/// The gains the source settled on, figures 3.15-3.20.
inline constexpr Gains designed_gains{12, 0, 16};

/// theta/theta_f and y(x)/theta_f.
struct LoopResponse {
  Complex theta;       ///< k1/P(s), -
  Complex deflection;  ///< g_3(x) k1/P(s), ft
  Outcome outcome;     ///< success; at_pole; non_finite
};

/// What residues need at a simple pole, or on a circle round several. All share one positive factor.
struct LoopTerms {
  Jet characteristic;           ///< Q = D_0 P, entire, with its slope
  Complex inertia;              ///< (I_hub + (2 + k2) B) D_0
  Complex determinant;          ///< D_0
  Complex open_loop;            ///< (I_hub + 2B) D_0
  std::vector<Complex> shapes;  ///< g_3(x) D_0/s^2, one a place
};

/// Poles of the closed loop.
struct LoopPoles {
  std::vector<Complex> s;  ///< Im s >= 0, by modulus; s = 0 is not listed
  Status status;           ///< success: none of modulus up to the last one's is missing
};

/// Which poles make a list whole.
enum class PoleOrder : std::uint8_t {
  modulus,   ///< none is missing whose modulus is at most the last one's
  frequency  ///< as many, and all others whose imaginary part is at most their largest: however fast they
             ///< decay
};

/// Plant and controller:
///
///     theta/theta_f = k1/P(s),   y(x)/theta_f = g_3(x) k1/P(s),   P = s^2 (I_hub + (2 + k2) B) + k3 s + k1.
///
/// Stable if k1 > 0, k3 > 0 and k2 > -2, for any spacecraft without damping of its own: then P(s)/s = s
/// (I_hub
/// + (2 + k2) B) + k3 + k1/s has a real part of at least k3 wherever Re s >= 0. The bound k2 > -1 of the
/// source is sufficient only. At k2 = -2 the hub does not feel the appendages, which ring on undamped.
///
/// Tests hold poles to those of tools/oracles (1e-12 and 5e-12 of their size) and their distance
/// from the zeros of the exact characteristic function to 2e-12; that none is missed, and that stability
/// follows from the gains, is counted by the argument principle.
class ClosedLoop {
 public:
  /// @throws std::invalid_argument naming a gain that is not finite or out of range (k1 >= 0, k2 > -2,
  /// k3 >= 0), or as require_physical()
  ClosedLoop(const Parameters& parameters, const Gains& gains);

  /// Without the controller.
  [[nodiscard]] const Plant& plant() const { return plant_; }
  /// The spacecraft.
  [[nodiscard]] const Parameters& parameters() const { return plant_.parameters(); }
  /// The gains.
  [[nodiscard]] const Gains& gains() const { return gains_; }
  /// 2 + k2, by which the hub feels one appendage.
  [[nodiscard]] double kappa() const { return 2 + gains_.k2; }

  /// Both transfer functions at @p s; within 1e-12 max(1, |s G'/G|) of themselves, as the plant's.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] LoopResponse response(Complex s, double x) const;
  /// theta/theta_f at @p s.
  [[nodiscard]] LoopResponse response(Complex s) const { return response(s, 0); }
  /// Q(s) = D_0(s) P(s), an entire function, over s or s^2 if P has that factor (k1 = 0; k1 = k3 = 0). Shares
  /// a positive factor with its slope.
  [[nodiscard]] Jet characteristic(Complex s) const;
  /// What residues at @p s need.
  /// @param x places, 0 to L; not checked
  [[nodiscard]] LoopTerms terms(Complex s, std::span<const double> x) const;

  /// The first @p count poles by modulus, counted band by band by the argument principle; to 12 digits of
  /// their modulus (tests/spacecraft). Poles far to the left, as one near -k3/I_hub, are found by themselves:
  /// there no wave comes back from the tip, and P is a polynomial.
  /// @returns with PoleOrder::frequency more than count if some decay too fast to be among the first by
  /// modulus
  /// @throws std::invalid_argument if count is not 1 to 5000
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
