/// @file
/// A solution that becomes infinite at a finite time.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// y' = s y^3, whose solution y0/sqrt(1 - 2 s y0^2 t) from y(0) = y0 ends at t = 1/(2 s y0^2) for s > 0. An
/// integrator has to notice. State (y).
struct BlowUp {
  static constexpr int dimension = 1;                  ///< y alone
  using compiled_once = BlowUp;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "blow-up";  ///< on command lines and in tables
  static constexpr double initial_time = 0;            ///< t_0
  static constexpr double final_time = 1;              ///< twice the life of the solution
  double strength = 1;                                 ///< s

  /// The equation as one types it.
  static constexpr std::string_view equation = "y' = s y^3; s strength";

  /// By name.
  static constexpr std::array parameters = {Parameter<BlowUp>{"strength", &BlowUp::strength}};

  /// y(0) = 1: the end is at t = 1/2.
  [[nodiscard]] static Vector<double, 1> initial_state() { return Vector<double, 1>(1.0); }

  /// dy/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 1>& y, Vector<T, 1>& dydt) const {
    dydt[0] = strength * (y[0] * y[0] * y[0]);
  }

  /// The solution at time @p t from @p y0 at time 0; NaN beyond its end.
  template <class T>
  [[nodiscard]] T exact(const T& t, const T& y0) const {
    using std::sqrt;
    return y0 / sqrt(1 - 2 * strength * y0 * y0 * t);
  }

  /// The time at which the solution from @p y0 at time 0 ends; infinity if it never does.
  [[nodiscard]] double end_time(double y0) const {
    const double rate = 2 * strength * y0 * y0;
    return rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity();
  }
};

}  // namespace nlmech::problems
