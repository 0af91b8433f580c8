/// @file
/// HIRES: high irradiance responses of plants to light, eight species, moderately stiff.
#pragma once

#include <array>
#include <string_view>

#include "nlmech/problems/concentrations.hpp"
#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// The chain of reactions by which phytochrome steers growth (E. Schaefer, A new approach to explain the high
/// irradiance responses of photomorphogenesis on the basis of phytochrome, J. Math. Biology 2 (1975) 41-56;
/// E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, section IV.10).
struct Hires {
  static constexpr int dimension = 8;                ///< concentrations
  using compiled_once = Hires;                       ///< its System is compiled in the library
  static constexpr std::string_view name = "hires";  ///< on command lines and in tables
  static constexpr double initial_time = 0;          ///< t_0
  static constexpr double final_time = 321.8122;     ///< of the test set
  double k_plus = 280;                               ///< rate of the only nonlinear reaction

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "y1' = -1.71 y1 + 0.43 y2 + 8.32 y3 + 0.0007, y2' = 1.71 y1 - 8.75 y2, y3' = "
      "-10.03 y3 + 0.43 y4 + 0.035 y5, y4' = 8.32 y2 + 1.71 y3 - 1.12 y4, y5' = -1.745 "
      "y5 + 0.43 (y6 + y7), y6' = -K y6 y8 + 0.69 y4 + 1.71 y5 - 0.43 y6 + 0.69 y7, y7' "
      "= K y6 y8 - 1.81 y7, y8' = -y7'; K k-plus";

  /// By name.
  static constexpr std::array parameters = {Parameter<Hires>{"k-plus", &Hires::k_plus, Range::not_negative}};

  /// Concentrations are not negative, if the rate is not.
  [[nodiscard]] Vector<double, 8> lower_bounds() const { return concentrations_lower_bounds<8>(k_plus >= 0); }

  /// The sum of the last two, which only turn into each other.
  template <class T>
  [[nodiscard]] Vector<T, 1> invariants(const T& /*t*/, const Vector<T, 8>& y) const {
    return Vector<T, 1>(T(y[6] + y[7]));
  }

  /// Of the test set.
  [[nodiscard]] static Vector<double, 8> initial_state() {
    Vector<double, 8> y = Vector<double, 8>::Zero();
    y[0] = 1;
    y[7] = 0.0057;
    return y;
  }

  /// dy/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 8>& y, Vector<T, 8>& dydt) const {
    const T complex = k_plus * (y[5] * y[7]);
    dydt[0] = 0.43 * y[1] + 8.32 * y[2] - 1.71 * y[0] + 0.0007;
    dydt[1] = 1.71 * y[0] - 8.75 * y[1];
    dydt[2] = 0.43 * y[3] + 0.035 * y[4] - 10.03 * y[2];
    dydt[3] = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3];
    dydt[4] = 0.43 * y[5] + 0.43 * y[6] - 1.745 * y[4];
    dydt[5] = 0.69 * y[3] + 1.71 * y[4] + 0.69 * y[6] - 0.43 * y[5] - complex;
    dydt[6] = complex - 1.81 * y[6];
    dydt[7] = 1.81 * y[6] - complex;
  }
};

}  // namespace nlmech::problems
