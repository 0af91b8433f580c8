/// @file
/// A problem for which a method is to be chosen.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "nlmech/ivp/system.hpp"

namespace nlmech::comparison {

/// What is asked, and of which.
struct Among {
  std::vector<std::string> methods = {};  ///< the only ones that may be chosen; empty: all
  /// May it be chosen?
  [[nodiscard]] bool has(const std::string& method) const;
};

/// What is asked.
struct Question {
  ivp::System system;                                             ///< equations
  ivp::State x0;                                                  ///< state at t0
  double t0;                                                      ///< begin
  double t1;                                                      ///< end
  double level = 9;                                               ///< digits to hold on the way
  double absolute = 1;                                            ///< absolute over relative tolerance
  Among among = {};                                               ///< which methods may be chosen
  bool timed = false;                                             ///< repeat short runs for their times
  double largest_step = std::numeric_limits<double>::infinity();  ///< that methods are held to
};

}  // namespace nlmech::comparison
