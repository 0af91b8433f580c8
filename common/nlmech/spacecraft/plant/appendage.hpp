/// @file
/// Appendage with prescribed root motion: exact solution of Eqs. 3.15-3.16 at any complex s, without
/// truncation, overflow or cancellation for small and large s.
///
/// With w = y + (r + x) theta, sigma^4 = -beta = -s^2 rho/EI and theta = 1 the field equation is w'''' =
/// sigma^4 w with w(0) = r, w'(0) = 1, EI w''(L) = -s^2 I_tip w'(L), EI w'''(L) = s^2 m w(L). All results are
/// quotients with the denominator D_0, an entire function of s^2 that vanishes at the resonances of the
/// hub-locked appendage: D_0 = f^2 + f' f'''/beta at L without tip (Eq. 3.37). Numerators and denominator are
/// stored separately to avoid loss of digits at a resonance, and share a factor exp(-exponent) to avoid
/// overflow.
///
/// Dimensionless form: w'''' = -b w on 0 to 1 with w(0) = eta, w'(0) = 1 and a tip body, w'' = -b j w' and
/// w''' = b mu w at 1, solved by series in b and by decaying waves.
///
/// Other ends replace single conditions: a root of stiffness kappa = k L/EI has w''(0) = kappa (w'(0) - 1) in
/// place of w'(0) = 1; a guided tip has w'(1) = 1 in place of the condition of w''(1), a pinned one w(1) =
/// eta
/// + 1 in place of that of w'''(1). The supports of the tips belong to the hub, so that B counts their
/// reactions: s^2 B theta is the whole load of one appendage on the hub, and B(0) its rigid inertia. With a
/// pinned root and a free tip D_0 vanishes at s = 0, where the appendage swings freely.
#pragma once

#include <cstdint>

#include "nlmech/spacecraft/parameters.hpp"
#include "nlmech/spacecraft/plant/jet.hpp"

namespace nlmech::spacecraft {

/// Dimensionless parameters of the appendage.
struct Ratios {
  double hub;              ///< eta = r/L
  double mass;             ///< mu = m/(rho L)
  double inertia;          ///< j = I_tip/(rho L^3)
  bool tip;                ///< whether there is a tip body; without one its terms are not evaluated
  double root_slope = 1;   ///< kappa/(1 + kappa), kappa = k L/EI: root_slope (w'(0) - 1) = root_moment w''(0)
  double root_moment = 0;  ///< 1/(1 + kappa)
  bool tip_stays = false;  ///< w(1) = eta + 1
  bool tip_keeps_slope = false;  ///< w'(1) = 1

  /// Clamped root and free tip.
  [[nodiscard]] bool is_cantilever() const { return root_moment == 0 && !tip_stays && !tip_keeps_slope; }
};

/// What moves the appendage.
enum class Drive : std::uint8_t {
  hub,        ///< theta = 1
  tip_torque  ///< the torque b EI/L at the tip, with the hub at rest: results over b are those of EI/L
};

/// Motion of the appendage, by default for theta = 1. Members marked "times D_0 exp(-exponent)" contain this
/// factor.
/// @tparam T double for s = j omega, where b < 0 and all members are real; else Complex, Jet or a wider type
template <class T>
struct Motion {
  T b;                     ///< beta L^4 = s^2 rho L^4/EI
  T determinant;           ///< D_0 exp(-exponent): D_0 is an entire function of b with D_0(0) = 1
  T inertia;               ///< B/(rho L^3), times D_0 exp(-exponent): entire
  T curvature;             ///< w''(0)/b, times D_0 exp(-exponent): entire
  T jerk;                  ///< w'''(0)/b, times D_0 exp(-exponent): entire
  T tilt{};                ///< (w'(0) - theta)/b, times D_0 exp(-exponent): entire; 0 for a clamped root
  double theta = 1;        ///< 1, or 0 for Drive::tip_torque
  double exponent = 0;     ///< real; 0 for the series
  double wave_number = 0;  ///< |b|^(1/4)

  bool waves = false;  ///< whether computed by waves; else by series, and the members below are not used
  T wave1{};           ///< p: b = -p^4, |arg p| <= pi/4
  T wave2{};           ///< i p or -i p, the one that does not grow from the root; for double equal to wave1
  T from_root1{};      ///< amplitude of exp(-wave1 xi), times D_0 exp(-exponent); so are the next three
  T from_root2{};      ///< amplitude of exp(-wave2 xi); for double of cos(p xi)
  T from_tip1{};       ///< amplitude of exp(-wave1 (1 - xi))
  T from_tip2{};       ///< amplitude of exp(-wave2 (1 - xi)); for double of sin(p xi)
};

/// |b| below which the series is used, and above which waves: |b|^(1/4) = 2.5.
inline constexpr double series_limit = 39.0625;

/// Motion by the Krylov functions K_n = sum (-b)^k/(4k + n)!, with the factor b divided out of every
/// difference. Cancellation grows with |b|: at most 2 digits for |b| up to series_limit.
template <class T>
[[nodiscard]] Motion<T> motion_by_series(const Ratios& ratios, const T& b, Drive drive = Drive::hub);

/// Motion by waves that decay from root and tip, which cannot overflow. Cancellation grows as |b| decreases.
/// For double, b < 0.
template <class T>
[[nodiscard]] Motion<T> motion_by_waves(const Ratios& ratios, const T& b, Drive drive = Drive::hub);

/// Derivative of order @p order (0 to 3) with respect to xi of (w - (eta + xi) theta)/b, times D_0
/// exp(-exponent). Uses waves if the motion was computed by waves and |b|^(1/4) xi >= 2.5, else the series
/// from the root.
/// @param xi 0 to 1
template <class T>
[[nodiscard]] T relative_deflection(const Motion<T>& motion, const Ratios& ratios, double xi, int order = 0);

/// @cond instances compiled in the library
extern template Motion<double> motion_by_series(const Ratios&, const double&, Drive);
extern template Motion<Complex> motion_by_series(const Ratios&, const Complex&, Drive);
extern template Motion<Jet> motion_by_series(const Ratios&, const Jet&, Drive);
extern template Motion<Complex> motion_by_waves(const Ratios&, const Complex&, Drive);
extern template Motion<Jet> motion_by_waves(const Ratios&, const Jet&, Drive);
extern template double relative_deflection(const Motion<double>&, const Ratios&, double, int);
extern template Complex relative_deflection(const Motion<Complex>&, const Ratios&, double, int);
extern template Jet relative_deflection(const Motion<Jet>&, const Ratios&, double, int);

// With sine and cosine; in real arithmetic for a clamped root and a free tip.
template <>
[[nodiscard]] Motion<double> motion_by_waves(const Ratios& ratios, const double& b, Drive drive);
/// @endcond

/// Method of evaluation.
enum class Evaluation : std::uint8_t {
  automatic,  ///< krylov for |beta|^(1/4) L < 2.5, waves above
  krylov,     ///< power series in beta; no cancellation at small s
  waves       ///< exponentials that decay from root and tip; no overflow at large s
};

/// Exact solution of one appendage as an Euler-Bernoulli beam. Immutable; all functions are thread-safe.
///
/// Accuracy (tests/spacecraft, against 110 digits, with and without tip): relative errors of B(s), g_3(x) and
/// the transfer functions below 1e-14 max(1, |s G'/G|) on the imaginary axis for |s| from 1e-8 to 1e8, for
/// real s of both signs, and in the complex plane. With other ends than clamped and free: 1e-13 times the
/// condition, deflections relative to the largest along the appendage.
class Appendage {
 public:
  /// @throws std::invalid_argument as require_physical()
  explicit Appendage(const Parameters& parameters);

  /// The parameters given to the constructor.
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

  /// The motion for theta = 1 at @p s. Finite for every finite s with |s|^2 rho L^4/EI below 1e200, even on a
  /// hub-locked resonance, where its determinant is 0.
  [[nodiscard]] Motion<Complex> motion(Complex s, Evaluation evaluation = Evaluation::automatic) const;
  /// motion() with derivatives with respect to s; the common factor exp(-exponent) is held constant.
  [[nodiscard]] Motion<Jet> motion_with_slope(Complex s) const;
  /// motion() at s = j omega, in faster real arithmetic.
  [[nodiscard]] Motion<double> motion_at_frequency(double omega) const;
  /// motion() for Drive::tip_torque.
  [[nodiscard]] Motion<Complex> motion_by_tip_torque(Complex s) const;

  /// B D_0, with B = (r S_0 - M_0)/(s^2 theta) for a free tip, slug ft^2: torque of one appendage on the hub,
  /// divided by the angular acceleration. At s = 0 it is D_0 times the moment of inertia of the appendage.
  template <class T>
  [[nodiscard]] T inertia(const Motion<T>& motion) const {
    return inertia_unit_ * motion.inertia;
  }
  /// g_3(x) D_0/s^2 with g_3 = y(x)/theta (Eq. 3.35), ft s^2. Divided by s^2 because g_3 ~ s^2 at small s.
  /// @param motion of this appendage
  /// @param x 0 to L, ft; not checked
  template <class T>
  [[nodiscard]] T deflection(const Motion<T>& motion, double x) const {
    return deflection_unit_ * relative_deflection(motion, ratios_, x / parameters_.length);
  }

  /// w'(L) D_0 for theta = 1: inertial rotation of the tip, -.
  template <class T>
  [[nodiscard]] T tip_rotation(const Motion<T>& motion) const {
    return motion.determinant + motion.b * relative_deflection(motion, ratios_, 1, 1);
  }

  /// B(s), slug ft^2; infinite or very large on a hub-locked resonance.
  [[nodiscard]] Complex inertia(Complex s) const;
  /// g_3(x) = y(x)/theta, ft; infinite or very large on a hub-locked resonance.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex deflection(Complex s, double x) const;
  /// Slope y'(x)/theta (g_4 of Eq. 3.35), -; same poles.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex slope(Complex s, double x) const;
  /// Bending moment EI y''(x)/theta, lb ft; M_0 at x = 0.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex moment(Complex s, double x) const;
  /// Shear force EI y'''(x)/theta, lb; S_0 at x = 0.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex shear(Complex s, double x) const;

  /// @throws std::invalid_argument naming x, if it is outside 0 to L
  void require_place(double x) const;
  /// rho L^4/EI, s^2: beta L^4 = s^2 beta_unit().
  [[nodiscard]] double beta_unit() const { return beta_unit_; }
  /// rho L^3.
  [[nodiscard]] double inertia_unit() const { return inertia_unit_; }
  /// r/L, m/(rho L), I_tip/(rho L^3), and the conditions at the ends.
  [[nodiscard]] const Ratios& ratios() const { return ratios_; }

 private:
  Parameters parameters_;
  Ratios ratios_;
  double beta_unit_;        ///< rho L^4/EI, s^2
  double inertia_unit_;     ///< rho L^3
  double deflection_unit_;  ///< L rho L^4/EI
};

}  // namespace nlmech::spacecraft
