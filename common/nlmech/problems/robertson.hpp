/// @file
/// Robertson's chemical kinetics: three species whose rates differ by nine orders of magnitude.
#pragma once

#include <array>
#include <string_view>

#include "nlmech/problems/concentrations.hpp"
#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// y1' = -k1 y1 + k2 y2 y3, y2' = k1 y1 - k2 y2 y3 - k3 y2^2, y3' = k3 y2^2 (H. H. Robertson, The solution of
/// a set of reaction rate equations, in: Numerical Analysis, an Introduction, Academic Press 1966, 178-182).
///
/// The sum of the species stays 1. After 1e11 seconds y2 is 8e-14: with errors that let it become negative
/// the solution runs away.
struct Robertson {
  static constexpr int dimension = 3;                    ///< concentrations
  using compiled_once = Robertson;                       ///< its System is compiled in the library
  static constexpr std::string_view name = "robertson";  ///< on command lines and in tables
  static constexpr double initial_time = 0;              ///< t_0
  static constexpr double final_time = 1e11;             ///< of the test set
  double k1 = 0.04;                                      ///< slow reaction, 1/s
  double k2 = 1e4;                                       ///< fast reaction, 1/s
  double k3 = 3e7;                                       ///< very fast reaction, 1/s

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "y1' = -k1 y1 + k2 y2 y3, y2' = k1 y1 - k2 y2 y3 - k3 y2^2, y3' = k3 y2^2";

  /// By name.
  static constexpr std::array parameters = {Parameter<Robertson>{"k1", &Robertson::k1, Range::not_negative},
                                            Parameter<Robertson>{"k2", &Robertson::k2, Range::not_negative},
                                            Parameter<Robertson>{"k3", &Robertson::k3, Range::not_negative}};

  /// Concentrations are not negative, if the rates are not.
  [[nodiscard]] Vector<double, 3> lower_bounds() const {
    return concentrations_lower_bounds<3>(k1 >= 0 && k2 >= 0 && k3 >= 0);
  }

  /// The sum of the species.
  template <class T>
  [[nodiscard]] Vector<T, 1> invariants(const T& /*t*/, const Vector<T, 3>& y) const {
    return Vector<T, 1>(T(y[0] + y[1] + y[2]));
  }

  /// All of the first species.
  [[nodiscard]] static Vector<double, 3> initial_state() { return {1, 0, 0}; }

  /// dy/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 3>& y, Vector<T, 3>& dydt) const {
    const T back = k2 * (y[1] * y[2]), fast = k3 * (y[1] * y[1]);
    dydt[0] = back - k1 * y[0];
    dydt[2] = fast;
    dydt[1] = k1 * y[0] - back - fast;
  }
};

}  // namespace nlmech::problems
