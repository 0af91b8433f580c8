/// @file
/// The method Radau IIA in the coordinates in which its stages decouple, and the error of a step from its
/// defect at two times.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "nlmech/collocation/radau/radau.hpp"

namespace nlmech::collocation {

/// T^-1 A^-1 T = Lambda for the A of s Radau nodes, s odd: one real eigenvalue and pairs of complex ones. In
/// w = T^-1 z the linear equations of all stages fall apart into one real system and (s - 1)/2 complex ones
/// of the size of the state (E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, section
/// IV.8). A pair of rows of T^-1 z is the real and the imaginary part of one complex component.
template <int s>
struct RadauTransform {
  static_assert(s % 2 == 1, "an even number of stages has no real eigenvalue");
  static constexpr int pairs = (s - 1) / 2;  ///< of complex eigenvalues

  double real;                                      ///< the real eigenvalue of A^-1
  std::array<std::complex<double>, pairs> complex;  ///< one of each pair, with positive imaginary part
  typename Radau<s>::Square to;                     ///< T^-1: row 0 real; rows 2p + 1 and 2p + 2 the parts
  typename Radau<s>::Square from;                   ///< T
};

/// The tables, made at the first call, with an error of a few ulps times the condition of T. @tparam s 3, 5
/// or 7
template <int s>
[[nodiscard]] const RadauTransform<s>& radau_transform();

/// @cond instances compiled in the library
extern template const RadauTransform<3>& radau_transform<3>();
extern template const RadauTransform<5>& radau_transform<5>();
extern template const RadauTransform<7>& radau_transform<7>();
/// @endcond

/// The polynomial u of a step of s Radau nodes fails the equation by the defect r = f(t, u) - u', which is 0
/// at the nodes. To first order the solution differs from u by e with e' = J e + r, e = 0 at the start, so
///
///     e(h) = h int_0^1 exp((1 - c) h J) r(c) dc.
///
/// Here r is the node polynomial M(c) times a linear function, which its values at the start and at one inner
/// time determine, and the function of z = h J that stands before each of the two values is replaced by
/// N(z)/Q(z): Q(z) is the common denominator of the method, N has degree s - 1 and is chosen so that the
/// powers of z up to s - 1 agree (the integral is O(z^(s-2)), since M is orthogonal to the degrees below s -
/// 1). In partial fractions these have the matrices eigenvalue/h - J of the method's own linear equations:
///
///     e(h) = sum over all eigenvalues of (eigenvalue/h - J)^-1 (begin r(0) + inner r(inner_time)).
///
/// For r = M and r = c M and z in the left half of the plane N/Q is never below a quarter of the integral,
/// nor above it by more than a factor of 2 for |z| < 10 and of |z|/5 beyond: there it falls like 1/z, the
/// integral like 1/z or 1/z^2.
template <int s>
struct RadauDefect {
  using Column = typename Radau<s>::Column;                     ///< a number for each node
  using Weights = std::array<std::complex<double>, s / 2 + 1>;  ///< a number for the real eigenvalue, for
                                                                ///< one of each pair, twice what it has there

  double inner_time;   ///< the second time, as a share of the step
  Column begin_slope;  ///< from increments at the nodes to the slope of u at the start, times h
  Column inner_value;  ///< from increments at the nodes to that of u at the inner time
  Column inner_slope;  ///< the same to the slope there, times h
  Weights begin;       ///< of r at the start
  Weights inner;       ///< of r at the inner time
};

/// The tables, made at the first call. @tparam s 3, 5 or 7
template <int s>
[[nodiscard]] const RadauDefect<s>& radau_defect();

/// @cond instances compiled in the library
extern template const RadauDefect<3>& radau_defect<3>();
extern template const RadauDefect<5>& radau_defect<5>();
extern template const RadauDefect<7>& radau_defect<7>();
/// @endcond

}  // namespace nlmech::collocation
