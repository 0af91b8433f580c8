/// @file
/// An initial value problem with a reference solution in extended precision, for the comparison of methods.
#pragma once

#include <functional>
#include <string>

#include "nlmech/ivp/system.hpp"

namespace nlmech::comparison {

/// An initial value problem with its reference solution.
struct Example {
  std::string name;      ///< prefix of the names of its runs: "duffing", "lorenz"
  ivp::System system;    ///< equations with the parameters of the publication
  ivp::State x0;         ///< initial state
  double t0;             ///< start
  double t1;             ///< end
  ivp::State amplitude;  ///< greatest |x_i| of the solution, the scale of errors where x_i is near zero
  /// Solution at a time from t0 to t1, to about 18 digits.
  std::function<ivp::LongState(double t)> reference;
  /// Error of a state; empty: relative_error() with `amplitude`.
  std::function<double(const ivp::State& found, const ivp::LongState& exact)> error = {};
};

}  // namespace nlmech::comparison
