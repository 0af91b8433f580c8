/// @file
/// The Duffing oscillator under a triangular impact force (Elgohary 2015, Eq. 4.24).
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"
#include "nlmech/program/value_of.hpp"

namespace nlmech::problems {

/// x'' + w^2 x + eta x^3 = f(t) with the force f that rises as a t on [0, t1/2), falls as a (t1 - t) on
/// [t1/2, t1) and is 0 elsewhere (Elgohary 2015, Eq. 4.24, values of Table 4.3). State (x, v).
///
/// Eq. 4.24 prints a (1 - t), which is the same for the printed t1 = 1 only, and does not say that the force
/// ends.
struct ImpactDuffing {
  static constexpr int dimension = 2;                 ///< position and velocity
  using compiled_once = ImpactDuffing;                ///< its System is compiled in the library
  static constexpr std::string_view name = "impact";  ///< on command lines and in tables
  static constexpr double initial_time = 0;           ///< t_0
  static constexpr double final_time = 500;           ///< t_F, Table 4.3
  double natural_frequency = 1;                       ///< w, of the linear oscillator, rad/time
  double hardening = 1;                               ///< eta, cubic stiffness
  double slope = 2;                                   ///< a, of the rising force; its peak is a t1/2
  double duration = 1;                                ///< t1, of the force; 0: no force

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x'' + w^2 x + eta x^3 = a t to t = t1/2, a (t1 - t) to t1, then 0; w "
      "natural-frequency, eta hardening, a slope, t1 duration";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<ImpactDuffing>{"natural-frequency", &ImpactDuffing::natural_frequency},
      Parameter<ImpactDuffing>{"hardening", &ImpactDuffing::hardening},
      Parameter<ImpactDuffing>{"slope", &ImpactDuffing::slope},
      Parameter<ImpactDuffing>{"duration", &ImpactDuffing::duration, Range::not_negative}};

  /// Table 4.3: at rest.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {0, 0}; }

  /// The force at time @p t. Where two pieces meet, that of the later time.
  template <class T>
  [[nodiscard]] T force(const T& t) const {
    const auto now = value_of(t);
    if (now < 0 || now >= duration) return T(0);
    if (now < duration / 2) return slope * t;
    return slope * (duration - t);
  }

  /// a = f(t) - w^2 q - eta q^3.
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& v, Vector<T, 1>& a) const {
    free().acceleration(t, q, v, a);
    a[0] += force(t);
  }

  /// dx/dt for the state x = (position, velocity).
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// The times 0, t1/2 and t1 at which the slope of the force jumps, as far as they lie strictly between
  /// @p from and @p to, in the direction of travel.
  [[nodiscard]] std::vector<double> discontinuities(double from, double to) const {
    std::vector<double> times;
    if (!(duration > 0)) return times;
    for (const double t : {0.0, duration / 2, duration}) {
      if (t > std::min(from, to) && t < std::max(from, to)) times.push_back(t);
    }
    if (to < from) std::reverse(times.begin(), times.end());
    return times;
  }

  /// The same oscillator without the force: what is left for t >= t1. Its energy, amplitude and period apply.
  [[nodiscard]] Duffing free() const { return {natural_frequency, hardening}; }
};

}  // namespace nlmech::problems
