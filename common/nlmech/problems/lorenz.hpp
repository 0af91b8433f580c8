/// @file
/// The Lorenz equations (Filipich and Rosales, Eq. 65).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// u' = sigma (v - u), v' = r u - v - u w, w' = u v - b w (Filipich and Rosales, Eq. 65, with the values of
/// section 4.3). State (u, v, w).
///
/// Neighbouring solutions part like exp(0.9 t): an end at t = 20 has lost eight digits. b = 8/3 is no double,
/// so a reference in extended precision takes Real from the type it computes with.
/// @tparam Real type of the parameters; at most as precise as the T that the equation is evaluated with
template <class Real>
struct BasicLorenz {
  static constexpr int dimension = 3;                 ///< u, v, w
  using compiled_once = BasicLorenz<double>;          ///< its System is compiled in the library
  static constexpr std::string_view name = "lorenz";  ///< on command lines and in tables
  static constexpr double initial_time = 0;           ///< t_0
  static constexpr double final_time = 20;            ///< end of Fig. 3a

  Real sigma = 10;       ///< Prandtl number
  Real r = 28;           ///< Rayleigh number over its critical value
  Real b = Real(8) / 3;  ///< shape of the rolls

  /// The equation as one types it.
  static constexpr std::string_view equation = "u' = sigma (v - u), v' = r u - v - u w, w' = u v - b w";

  /// By name.
  static constexpr std::array parameters = {Parameter<BasicLorenz, Real>{"sigma", &BasicLorenz::sigma},
                                            Parameter<BasicLorenz, Real>{"r", &BasicLorenz::r},
                                            Parameter<BasicLorenz, Real>{"b", &BasicLorenz::b}};

  /// Section 4.3: (0, 1, 0).
  [[nodiscard]] static Vector<double, 3> initial_state() { return {0, 1, 0}; }

  /// Heads of columns.
  [[nodiscard]] static std::vector<std::string> state_names() { return {"u", "v", "w"}; }

  /// dx/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 3>& x, Vector<T, 3>& dxdt) const {
    dxdt[0] = sigma * (x[1] - x[0]);
    dxdt[1] = r * x[0] - x[1] - x[0] * x[2];
    dxdt[2] = x[0] * x[1] - b * x[2];
  }
};

/// With parameters in double precision.
using Lorenz = BasicLorenz<double>;

}  // namespace nlmech::problems
