/// @file
/// Coefficients of the first pass over a tape, and constants of all passes. Internal to the component.
#pragma once

#include <utility>
#include <vector>

#include "nlmech/program/tape_program.hpp"

namespace nlmech::tape {

/// Coefficient 0 of a nonlinear instruction; @p x is that of its operand, @p other that of the second one.
/// @return coefficient 0 of the result and of its companion series
/// @param factor of the instruction, or of a lane
[[nodiscard]] std::pair<double, double> first_coefficient(const Instruction& i, double factor, double x,
                                                          double other);

/// Does the instruction have a second series, whose coefficient 0 the passes do not compute?
[[nodiscard]] bool has_companion(Operation operation);

/// 1/(k + 1) for k = 0, ..., @p order.
[[nodiscard]] std::vector<double> reciprocals(int order);

}  // namespace nlmech::tape
