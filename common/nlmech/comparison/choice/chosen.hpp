/// @file
/// What a choice of methods comes to.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/choice/features.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// A method in the order of preference.
struct Ranked {
  std::string method;    ///< its name
  double tolerance = 0;  ///< relative; absolute in the ratio that was asked for
  double cost = 0;       ///< expected of the whole way, in units of Measured
  double seen = 0;       ///< share of the way that it ran; 0: it did not
  double seconds = 0;    ///< of that share; 0: not measured
  double behind = 1;     ///< factor behind the fastest, on problems like this one
  double short_of = 0;   ///< digits that its tightest tolerance lacks
};

/// What came of a question about digits at the end.
struct Chosen {
  Status status;                        ///< a failure: the problem, or every method on it, ends on the way
  Look look;                            ///< at the problem
  double digits = 9;                    ///< asked for
  double condition = 1;                 ///< growth_along()
  double condition_seen = 0;            ///< the share of the way that it was found on; 0: it is not known
  bool condition_is_bound = false;      ///< errors have grown to the size of the solution: it is greater
  double possible = 15;                 ///< digits that rounding leaves
  double right_hand_side = 0;           ///< s of one
  std::vector<Ranked> ranked = {};      ///< the fastest first
  std::vector<std::string> alike = {};  ///< the problems of the evidence that count most
};

}  // namespace nlmech::comparison
