/// @file
/// The appendage without dimensions: w'''' = -b w on 0 to 1 with w(0) = eta, w'(0) = 1 and a tip body, w'' =
/// -b j w' and w''' = b mu w at 1. Solved by series in b and by decaying waves.
#pragma once

#include "nlmech/spacecraft/plant/jet.hpp"

namespace nlmech::spacecraft {

/// The appendage's shape in ratios.
struct Ratios {
  double hub;      ///< eta = r/L
  double mass;     ///< mu = m/(rho L)
  double inertia;  ///< j = I_tip/(rho L^3)
  bool tip;        ///< is there a tip body? If not, no term of it is evaluated
};

/// The motion: every quantity below that says so is multiplied by D_0 exp(-exponent).
/// @tparam T double for s = j omega, where b < 0 and everything is real; else Complex, Jet or wider
template <class T>
struct Motion {
  T b;                     ///< beta L^4 = s^2 rho L^4/EI
  T determinant;           ///< D_0 exp(-exponent): D_0 is an entire function of b with D_0(0) = 1
  T inertia;               ///< B/(rho L^3), times D_0 exp(-exponent): entire
  T curvature;             ///< w''(0)/b, times D_0 exp(-exponent): entire
  T jerk;                  ///< w'''(0)/b, times D_0 exp(-exponent): entire
  double exponent = 0;     ///< real: 0 by series
  double wave_number = 0;  ///< |b|^(1/4)

  bool waves = false;  ///< by waves? Else by series, and what follows is not used
  T wave1{};           ///< p: b = -p^4, |arg p| <= pi/4
  T wave2{};           ///< i p or -i p, whichever does not grow from the root; for double the same as wave1
  T from_root1{};      ///< of exp(-wave1 xi), times D_0 exp(-exponent)
  T from_root2{};      ///< of exp(-wave2 xi); for double of cos(p xi)
  T from_tip1{};       ///< of exp(-wave1 (1 - xi))
  T from_tip2{};       ///< of exp(-wave2 (1 - xi)); for double of sin(p xi)
};

/// Below this |b| series are used, above it waves: |b|^(1/4) = 2.5.
inline constexpr double series_limit = 39.0625;

/// By Krylov's functions K_n = sum (-b)^k/(4k + n)!, with the factor b taken out of every difference. Cancels
/// more the larger |b|: for |b| up to series_limit 2 digits at most.
template <class T>
[[nodiscard]] Motion<T> motion_by_series(const Ratios& ratios, const T& b);

/// By waves that decay from the root and from the tip: nothing overflows. Cancels the more the smaller |b|.
/// For double b < 0.
template <class T>
[[nodiscard]] Motion<T> motion_by_waves(const Ratios& ratios, const T& b);

/// The derivative number @p order (0 to 3) by xi of (w - eta - xi)/b, times D_0 exp(-exponent): by waves, or
/// by series from the root where |b|^(1/4) xi < 2.5, whichever way the motion was found.
/// @param xi 0 to 1
template <class T>
[[nodiscard]] T relative_deflection(const Motion<T>& motion, const Ratios& ratios, double xi, int order = 0);

/// @cond instances compiled in the library
extern template Motion<double> motion_by_series(const Ratios&, const double&);
extern template Motion<Complex> motion_by_series(const Ratios&, const Complex&);
extern template Motion<Jet> motion_by_series(const Ratios&, const Jet&);
extern template Motion<Complex> motion_by_waves(const Ratios&, const Complex&);
extern template Motion<Jet> motion_by_waves(const Ratios&, const Jet&);
extern template double relative_deflection(const Motion<double>&, const Ratios&, double, int);
extern template Complex relative_deflection(const Motion<Complex>&, const Ratios&, double, int);
extern template Jet relative_deflection(const Motion<Jet>&, const Ratios&, double, int);

// In real arithmetic, by sines and cosines.
template <>
[[nodiscard]] Motion<double> motion_by_waves(const Ratios& ratios, const double& b);
/// @endcond

}  // namespace nlmech::spacecraft
