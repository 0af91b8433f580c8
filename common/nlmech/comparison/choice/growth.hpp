/// @file
/// How a problem multiplies errors on the way, found by a few cheap runs. amplification() is the careful way,
/// from a reference.
#pragma once

#include "nlmech/comparison/choice/expectation.hpp"
#include "nlmech/comparison/choice/question.hpp"

namespace nlmech::comparison {

/// What a problem makes of errors.
struct Growth {
  double factor = 1;  ///< from one tolerance, absolute + relative, to the error by the size of a component
  double seen = 0;    ///< the share of the way that it was found on
  bool at_least = false;  ///< errors have grown to the size of the solution: the factor is a lower bound
};

/// By runs from begins that are moved by a little, at up to six places of the way: in each component by
/// itself, signs the worst, where there are eight or fewer, else with eight patterns of signs. Where errors
/// grow to the size of the solution, once more with smaller moves.
/// @param method by which it runs
[[nodiscard]] Growth growth_along(const Question& question, const Expectation& method);

}  // namespace nlmech::comparison
