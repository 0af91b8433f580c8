/// @file
/// An example by which methods are judged: equations, initial state, times, and the solution to more digits
/// than double holds.
#pragma once

#include <functional>
#include <string>

#include "nlmech/ivp/system.hpp"

namespace nlmech::comparison {

/// What is integrated, how long, and what should come out.
struct Example {
  std::string name;      ///< begins the names of its runs: "duffing", "lorenz"
  ivp::System system;    ///< with the parameters of the publication
  ivp::State x0;         ///< initial state
  double t0;             ///< begin
  double t1;             ///< end
  ivp::State amplitude;  ///< greatest |x_i| of the response, the scale of errors where x_i is near zero
  /// The solution at a time from t0 to t1, to some 18 digits.
  std::function<ivp::LongState(double t)> reference;
  /// How wrong a state is; empty: relative_error() with `amplitude`.
  std::function<double(const ivp::State& found, const ivp::LongState& exact)> error = {};
};

}  // namespace nlmech::comparison
