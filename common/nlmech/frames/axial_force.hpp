/// @file
/// Axial force of a beam-column from its deformation: Kondoh and Atluri's Eq. 2.28 solved for n.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "nlmech/frames/stability_functions.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// Equation for the axial force n = N l^2/EI: B_n = 0 of Eq. 2.38 divided by l,
///
///     b(n) = delta/l + (g_a'(n) theta_a^2 + g_s'(n) theta_s^2)/2 - n EI/(EA l^2) = 0.
///
/// Between the poles g' decreases with n. Hence b decreases and has at most one root there.
template <class T>
struct AxialBalance {
  using Number = decltype(value_of(std::declval<T>()));  ///< floating-point type of T, without dual parts

  T strain;         ///< delta/l, shortening of the chord negative
  T antisymmetric;  ///< theta_a^2/2
  T symmetric;      ///< theta_s^2/2
  Number softness;  ///< EI/(EA l^2), positive

  /// b(n); @p g holds the stability functions at n.
  [[nodiscard]] T value(const T& n, const StabilityFunctions<T>& g) const {
    return strain + antisymmetric * g.antisymmetric.slope + symmetric * g.symmetric.slope - softness * n;
  }
  /// db/dn, negative.
  [[nodiscard]] T slope(const StabilityFunctions<T>& g) const {
    return antisymmetric * g.antisymmetric.curvature + symmetric * g.symmetric.curvature - softness;
  }
};

/// Axial force with its stability functions and outcome.
template <class T>
struct AxialForce {
  T n;                      ///< N l^2/EI, tension positive
  StabilityFunctions<T> g;  ///< stability functions at n
  /// `success`; `wrong_branch` if n is below -4 pi^2; `at_pole` if it is -4 pi^2 (g is then infinite);
  /// `non_finite`
  Outcome outcome = Outcome::success;
  int evaluations = 0;  ///< evaluations of the stability functions
};

namespace detail {

/// Root of a decreasing function between two bounds: Newton's iteration from z, with bisection where it
/// leaves the interval. @p f returns value, slope, and the rounding level of the value.
template <class Number, class F>
[[nodiscard]] Number falling_root(const F& f, Number z, Number low, Number high, int& evaluations) {
  using std::abs;
  constexpr int most = 200;  // enough for bisection alone in any precision used here
  const Number eps = std::numeric_limits<Number>::epsilon();
  for (int i = 0; i < most; ++i) {
    const auto [value, slope, noise] = f(z);
    ++evaluations;
    if (abs(value) <= noise) break;
    const Number step = value / slope;
    // Convergence is quadratic: after such a short step the error is rounding.
    if (abs(step) <= 64 * eps * abs(z)) return Number(z - step);
    (value > 0 ? low : high) = z;
    z -= step;
    if (!(z > low && z < high)) z = low + (high - low) / 2;
  }
  return z;
}

/// Value, slope and rounding level of b at n, for falling_root().
template <class Number>
struct BalanceAt {
  Number value;  ///< b
  Number slope;  ///< db/dn
  Number noise;  ///< rounding level of b: eps/2 times the sum of |terms|
};

/// Evaluates b for the stability functions @p g.
template <class Number>
[[nodiscard]] BalanceAt<Number> balance_at(const AxialBalance<Number>& b, const Number& n,
                                           const StabilityFunctions<Number>& g) {
  using std::abs;
  const Number terms = abs(b.strain) + abs(Number(b.antisymmetric * g.antisymmetric.slope)) +
                       abs(Number(b.symmetric * g.symmetric.slope)) + abs(Number(b.softness * n));
  return {b.value(n, g), b.slope(g), terms * std::numeric_limits<Number>::epsilon() / 2};
}

/// Root of b, stored as n or, near the pole of g_s, as p = n + 4 pi^2.
template <class Number>
struct AxialRoot {
  Number at;
  bool above_pole;
  Outcome outcome;
};

/// Root p between the pole of g_s and n = -4.
template <class Number>
[[nodiscard]] Number root_above_pole(const AxialBalance<Number>& b, const Number& pole, int& evaluations) {
  using std::sqrt;
  const Number top = pole - 4;
  // Near the pole g_s' = 8 pole/p^2 and g_a' = 1/2.
  const Number rest = -(b.strain + b.antisymmetric / 2 + pole * b.softness);
  Number start = top;
  if (rest > 0) start = std::min(top, Number(sqrt(Number(8 * pole * b.symmetric / rest))));
  const auto f = [&](const Number& p) {
    return balance_at<Number>(b, Number(p - pole), stability_functions_above_pole<Number>(p));
  };
  return falling_root<Number>(f, start, Number(0), Number(top + 1), evaluations);
}

/// Root for theta_s = 0, where b has no pole at that of g_s; the root may lie below it.
template <class Number>
[[nodiscard]] AxialRoot<Number> root_without_symmetric(const AxialBalance<Number>& b, const Number& pole,
                                                       int& evaluations) {
  const Number there = b.strain + b.antisymmetric / 2 + pole * b.softness;  // b at the pole, g_a' = 1/2
  if (there > 0) return {root_above_pole(b, pole, evaluations), true, Outcome::success};
  if (there == 0) return {Number(0), true, Outcome::at_pole};
  if (b.antisymmetric == 0) return {Number(b.strain / b.softness), false, Outcome::wrong_branch};
  const auto f = [&](const Number& n) {
    const StabilityFunction<Number> none{Number(0), Number(0), Number(0)};
    return balance_at<Number>(b, n, {stability_functions<Number>(n).antisymmetric, none});
  };
  const Number low = antisymmetric_pole;
  const Number n = falling_root<Number>(f, Number(-pole - 1), low, Number(-pole), evaluations);
  return {n, false, Outcome::wrong_branch};
}

/// Root of b, without dual parts.
template <class Number>
[[nodiscard]] AxialRoot<Number> axial_root(const AxialBalance<Number>& b, int& evaluations) {
  using std::isfinite;
  if (!isfinite(Number(b.strain + b.antisymmetric + b.symmetric)))
    return {Number(0), false, Outcome::non_finite};
  const auto f = [&](const Number& n) { return balance_at<Number>(b, n, stability_functions<Number>(n)); };
  // n = -4 is a branch limit of stability_functions(); n = -3.99 is not.
  static const Number split = -3.99;
  static const StabilityFunctions<Number> at_split = stability_functions<Number>(split);
  if (b.value(split, at_split) < 0) {
    const Number pole = FourPiSquared<Number>{}.high;
    // A smaller theta_s makes g_s'' overflow double near the pole.
    if (b.symmetric < 1e-190) return root_without_symmetric(b, pole, evaluations);
    return {root_above_pole(b, pole, evaluations), true, Outcome::success};
  }
  // For n >= 0: g_a' <= 1/5 and g_s' <= 1/3.
  const Number bound = (b.strain + b.antisymmetric / 5 + b.symmetric / 3) / b.softness;
  const Number high = std::max(Number(1), Number(bound + 1 + bound / 1000));
  return {falling_root<Number>(f, Number(0), split, high, evaluations), false, Outcome::success};
}

}  // namespace detail

/// Solves for the axial force, to rounding. Below n = -4 the unknown is the distance from the pole of g_s, so
/// that g_s keeps full accuracy for symmetric end rotations of any size.
///
/// Special case: for theta_s = 0 (below 1e-95) b has no pole, and n may be below -4 pi^2. The member then
/// carries more than its clamped buckling load in unstable equilibrium: Pi(d, N) has no maximum over N there,
/// and the smallest theta_s moves n above the pole. The root is returned with `wrong_branch`.
///
/// Tests check that |b| at the root, evaluated in 50 digits, is at most 64 eps of its terms, and that 40
/// evaluations suffice.
/// @tparam T floating point of any width, or dual numbers, nested to a depth of three
template <class T>
[[nodiscard]] AxialForce<T> axial_force(const AxialBalance<T>& b) {
  using Number = typename AxialBalance<T>::Number;
  AxialForce<T> force{};
  const AxialBalance<Number> plain{value_of(b.strain), value_of(b.antisymmetric), value_of(b.symmetric),
                                   b.softness};
  const detail::AxialRoot<Number> root = detail::axial_root(plain, force.evaluations);
  force.outcome = root.outcome;
  const FourPiSquared<Number> pole;
  T z(root.at);
  const auto evaluate = [&] {
    force.n = root.above_pole ? T((z - pole.high) - pole.low) : z;
    force.g = root.above_pole ? stability_functions_above_pole<T>(z) : stability_functions<T>(z);
    ++force.evaluations;
  };
  evaluate();
  if constexpr (!std::same_as<T, Number>) {
    // Each Newton step at the root makes one more order of derivatives exact.
    for (int order = 0; order < 3; ++order) {
      z = z - b.value(force.n, force.g) / b.slope(force.g);
      evaluate();
    }
  }
  return force;
}

}  // namespace nlmech::frames
