/// @file
/// What the first pass over a tape computes, and numbers that all passes take. Internal to the component.
#pragma once

#include <utility>
#include <vector>

#include "nlmech/program/tape_program.hpp"

namespace nlmech::tape {

/// Coefficient 0 of an instruction that is not linear; @p x is that of its argument, @p other of the second
/// one. The result and that of its companion.
/// @param factor its own, or that of a lane
[[nodiscard]] std::pair<double, double> first_coefficient(const Instruction& i, double factor, double x,
                                                          double other);

/// Has the instruction a second series, whose coefficient 0 is not made by the passes?
[[nodiscard]] bool has_companion(Operation operation);

/// 1/(k + 1) for k = 0, ..., @p order.
[[nodiscard]] std::vector<double> reciprocals(int order);

}  // namespace nlmech::tape
