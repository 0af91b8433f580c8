/// @file
/// Closed-form solution of the free Duffing oscillator, duffing.ode (Elgohary 2015, Eq. 4.22).
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "nlmech/problems/texts.hpp"

namespace nlmech::problems {

/// Duffing oscillator x'' + w^2 x + eta x^3 = 0. From x(0) = X at rest the solution is X cn(omega t | m) with
/// the Jacobi elliptic function of the modulus sqrt(m). Its constants are argument_frequency(),
/// elliptic_parameter() and period(); they hold for w^2 + eta X^2 > 0.
struct Duffing {
  double natural_frequency = 1;  ///< w, frequency of the linear oscillator, rad/time
  double hardening = 1;          ///< eta, cubic stiffness; negative: softening

  /// The problem with these parameters, from x(0) = 1 at rest.
  [[nodiscard]] TextProblem text() const {
    return TextProblem("duffing", {{"natural_frequency", natural_frequency}, {"hardening", hardening}});
  }

  /// The energy v^2/2 + w^2 x^2/2 + eta x^4/4 of a state (x, v).
  template <class State>
  [[nodiscard]] auto energy(const State& x) const {
    using T = std::remove_cvref_t<decltype(x[0])>;
    const T linear = natural_frequency * x[0], square = x[0] * x[0];
    return T((x[1] * x[1] + linear * linear) / 2 + hardening / 4 * (square * square));
  }

  /// Greatest |x| of the closed orbit through @p x; NaN if the orbit is not closed (softening only).
  template <class State>
  [[nodiscard]] auto amplitude(const State& x) const {
    using std::sqrt;
    using T = std::remove_cvref_t<decltype(x[0])>;
    const T w2 = T(natural_frequency) * natural_frequency, e = energy(x);
    // The root X of eta X^4/4 + w^2 X^2/2 = E, in the form without cancellation for eta > 0.
    return T(sqrt(4 * e / (w2 + sqrt(w2 * w2 + 4 * hardening * e))));
  }

  /// omega = sqrt(w^2 + eta X^2), the factor of t in X cn(omega t | m) for the amplitude X.
  template <class T>
  [[nodiscard]] T argument_frequency(const T& amplitude) const {
    using std::sqrt;
    return sqrt(T(natural_frequency) * natural_frequency + hardening * (amplitude * amplitude));
  }

  /// m = eta X^2 / (2 (w^2 + eta X^2)), the squared modulus, for the amplitude X.
  template <class T>
  [[nodiscard]] T elliptic_parameter(const T& amplitude) const {
    const T cubic = hardening * (amplitude * amplitude);
    return cubic / (2 * (T(natural_frequency) * natural_frequency + cubic));
  }

  /// The period 4 K(m)/omega = 2 pi / agm(omega, sqrt(w^2 + eta X^2 / 2)) for the amplitude X, to 4 units in
  /// the last place of T (double, long double or a multiprecision type); NaN unless w^2 + eta X^2 > 0.
  template <class T>
  [[nodiscard]] T period(const T& amplitude) const {
    using std::acos;
    using std::sqrt;
    const T w2 = T(natural_frequency) * natural_frequency, cubic = hardening * (amplitude * amplitude);
    if (!(w2 + cubic > 0)) return std::numeric_limits<T>::quiet_NaN();
    T a = sqrt(w2 + cubic), b = sqrt(w2 + cubic / 2);
    // The arithmetic-geometric mean converges quadratically. The means may remain one unit apart, hence the
    // limit of the iterations.
    for (int turn = 0; turn < 64 && a != b; ++turn) {
      const T mean = (a + b) / 2;
      b = sqrt(a * b);
      if (mean == a) break;
      a = mean;
    }
    return 2 * acos(T(-1)) / a;
  }
};

}  // namespace nlmech::problems
