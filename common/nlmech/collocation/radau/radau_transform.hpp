/// @file
/// Radau IIA in coordinates that decouple its stages, and an error estimate of a step from its defect at two
/// times.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "nlmech/collocation/radau/radau.hpp"

namespace nlmech::collocation {

/// T^-1 A^-1 T = Lambda for the matrix A of s Radau nodes, s odd: one real eigenvalue and pairs of complex
/// ones. In w = T^-1 z the linear equations of all stages decouple into one real system and (s - 1)/2 complex
/// systems of the size of the state (E. Hairer and G. Wanner, Solving Ordinary Differential Equations II,
/// section IV.8). A pair of rows of T^-1 z contains the real and the imaginary part of one complex component.
template <int s>
struct RadauTransform {
  static_assert(s % 2 == 1, "an even number of stages has no real eigenvalue");
  static constexpr int pairs = (s - 1) / 2;  ///< number of pairs of complex eigenvalues

  double real;                                      ///< the real eigenvalue of A^-1
  std::array<std::complex<double>, pairs> complex;  ///< one per pair, with Im > 0
  typename Radau<s>::Square to;    ///< T^-1: row 0 real; rows 2p + 1, 2p + 2: Re, Im of pair p
  typename Radau<s>::Square from;  ///< T
};

/// The tables, computed at the first call, with an error of a few ulps times the condition number of T.
/// @tparam s 3, 5 or 7
template <int s>
[[nodiscard]] const RadauTransform<s>& radau_transform();

/// @cond instances compiled in the library
extern template const RadauTransform<3>& radau_transform<3>();
extern template const RadauTransform<5>& radau_transform<5>();
extern template const RadauTransform<7>& radau_transform<7>();
/// @endcond

/// Error estimate from the defect. The collocation polynomial u of a step has the defect r = f(t, u) - u',
/// which is 0 at the nodes. To first order the error e of u satisfies e' = J e + r, e = 0 at the start, so
///
///     e(h) = h int_0^1 exp((1 - c) h J) r(c) dc.
///
/// The defect r is approximated by the node polynomial M(c) times a linear function, determined by the values
/// of r at the start and at one inner time. The coefficient of each value, a function of z = h J, is replaced
/// by N(z)/Q(z): Q(z) is the denominator of the stability function, N has degree s - 1 and makes the powers
/// of z up to s - 1 agree (the integral is O(z^(s-2)), since M is orthogonal to the degrees below s - 1). The
/// partial fractions contain the matrices eigenvalue/h - J of the linear equations of the method:
///
///     e(h) = sum over all eigenvalues of (eigenvalue/h - J)^-1 (begin r(0) + inner r(inner_time)).
///
/// For r = M and r = c M and z in the left half-plane N/Q is at least a quarter of the integral, and at most
/// 2 times the integral for |z| < 10 and |z|/5 times beyond: there N/Q decreases like 1/z, the integral like
/// 1/z or 1/z^2.
template <int s>
struct RadauDefect {
  using Column = typename Radau<s>::Column;  ///< one number per node
  using Weights =
      std::array<std::complex<double>, s / 2 + 1>;  ///< for the real eigenvalue, then one per pair, doubled

  double inner_time;   ///< the inner time, as a fraction of the step
  Column begin_slope;  ///< maps increments at the nodes to the slope of u at the start, times h
  Column inner_value;  ///< maps increments at the nodes to the increment of u at the inner time
  Column inner_slope;  ///< maps increments at the nodes to the slope of u at the inner time, times h
  Weights begin;       ///< weights of r at the start
  Weights inner;       ///< weights of r at the inner time
};

/// The tables, computed at the first call. @tparam s 3, 5 or 7
template <int s>
[[nodiscard]] const RadauDefect<s>& radau_defect();

/// @cond instances compiled in the library
extern template const RadauDefect<3>& radau_defect<3>();
extern template const RadauDefect<5>& radau_defect<5>();
extern template const RadauDefect<7>& radau_defect<7>();
/// @endcond

}  // namespace nlmech::collocation
