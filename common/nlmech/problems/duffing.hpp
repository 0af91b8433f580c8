/// @file
/// The freely vibrating Duffing oscillator (Elgohary 2015, Eq. 4.22).
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x'' + w^2 x + eta x^3 = 0 (Elgohary 2015, Eq. 4.22) with the values of Table 4.1. State (x, v).
///
/// From x(0) = X at rest the solution is X cn(omega t | m) with the Jacobi elliptic function of the modulus
/// sqrt(m); argument_frequency(), elliptic_parameter() and period() are its constants. They hold for every
/// eta for which w^2 + eta X^2 > 0.
struct Duffing {
  static constexpr int dimension = 2;                  ///< position and velocity
  using compiled_once = Duffing;                       ///< its System is compiled in the library
  static constexpr std::string_view name = "duffing";  ///< on command lines and in tables
  static constexpr double initial_time = 0;            ///< t_0
  static constexpr double final_time = 500;            ///< t_F, Table 4.1
  double natural_frequency = 1;                        ///< w, of the linear oscillator, rad/time
  double hardening = 1;                                ///< eta, cubic stiffness; negative: softening

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x'' + w^2 x + eta x^3 = 0; w natural-frequency, eta hardening";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<Duffing>{"natural-frequency", &Duffing::natural_frequency},
      Parameter<Duffing>{"hardening", &Duffing::hardening}};

  /// Table 4.1: x(0) = 1, v(0) = 0.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {1, 0}; }

  /// a = -w^2 q - eta q^3.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 1>& q, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    const T& x = q[0];
    // Products of parameters are formed in T, so that the equation is the same in every precision.
    a[0] = -(natural_frequency * (natural_frequency * x)) - hardening * (x * x * x);
  }

  /// dx/dt for the state x = (position, velocity).
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// The energy v^2/2 + w^2 x^2/2 + eta x^4/4.
  template <class T>
  [[nodiscard]] Vector<T, 1> invariants(const T& /*t*/, const Vector<T, 2>& x) const {
    const T linear = natural_frequency * x[0], square = x[0] * x[0];
    return Vector<T, 1>((x[1] * x[1] + linear * linear) / 2 + hardening / 4 * (square * square));
  }

  /// Greatest |x| of the closed orbit through @p x; NaN if the orbit is not closed (softening only).
  template <class T>
  [[nodiscard]] T amplitude(const Vector<T, 2>& x) const {
    using std::sqrt;
    const T w2 = T(natural_frequency) * natural_frequency, energy = invariants(T(0), x)[0];
    // The root X of eta X^4/4 + w^2 X^2/2 = E, in the form that has no difference for eta > 0.
    return sqrt(4 * energy / (w2 + sqrt(w2 * w2 + 4 * hardening * energy)));
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
    // The arithmetic-geometric mean: the difference is squared at every turn, so a handful suffices; the
    // means may end up one unit apart, hence the count.
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
