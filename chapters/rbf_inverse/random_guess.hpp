/// @file
/// Arbitrary guesses for the control problems: the same numbers on every machine.
#pragma once

#include "nlmech/bvp/solution.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Guess number @p number, from 0, for all states and co-states: even ones have independent values in (-1, 1)
/// at each of 40 nodes, odd ones a constant in (-5, 5) for each component.
[[nodiscard]] bvp::Start random_guess(int number, double final_time);

}  // namespace nlmech::chapters::rbf_inverse
