/// @file
/// Solutions that end at a finite value, where the equation does.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// y' = -s/(2 y), whose solution sqrt(y0^2 - s t) from y(0) = y0 > 0 ends at t = y0^2/s for s > 0, where its
/// slope is infinite. There is none beyond, but a step may jump across. State (y).
struct DeadEnd {
  static constexpr int dimension = 1;                   ///< y alone
  using compiled_once = DeadEnd;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "dead-end";  ///< on command lines and in tables
  static constexpr double initial_time = 0;             ///< t_0
  static constexpr double final_time = 2;               ///< twice the life of the solution
  double strength = 1;                                  ///< s

  /// The equation as one types it.
  static constexpr std::string_view equation = "y' = -s/(2 y); s strength";

  /// By name.
  static constexpr std::array parameters = {Parameter<DeadEnd>{"strength", &DeadEnd::strength}};

  /// y(0) = 1: the end is at t = 1.
  [[nodiscard]] static Vector<double, 1> initial_state() { return Vector<double, 1>(1.0); }

  /// dy/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 1>& y, Vector<T, 1>& dydt) const {
    dydt[0] = -strength / (2 * y[0]);
  }

  /// The solution at time @p t from @p y0 > 0 at time 0; NaN beyond its end.
  template <class T>
  [[nodiscard]] T exact(const T& t, const T& y0) const {
    using std::sqrt;
    return sqrt(y0 * y0 - strength * t);
  }
};

/// y' = -y + sqrt(s - t), an equation that has no meaning for t > s: its right-hand side is not a number
/// there. State (y).
struct LostDomain {
  static constexpr int dimension = 1;                      ///< y alone
  using compiled_once = LostDomain;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "lost-domain";  ///< on command lines and in tables
  static constexpr double initial_time = 0;                ///< t_0
  static constexpr double final_time = 2;                  ///< twice the life of the equation
  double last = 1;                                         ///< s, the last time that has a slope

  /// The equation as one types it.
  static constexpr std::string_view equation = "y' = -y + sqrt(s - t); s last";

  /// By name.
  static constexpr std::array parameters = {Parameter<LostDomain>{"last", &LostDomain::last}};

  /// y(0) = 1.
  [[nodiscard]] static Vector<double, 1> initial_state() { return Vector<double, 1>(1.0); }

  /// dy/dt.
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& y, Vector<T, 1>& dydt) const {
    using std::sqrt;
    dydt[0] = sqrt(last - t) - y[0];
  }
};

}  // namespace nlmech::problems
