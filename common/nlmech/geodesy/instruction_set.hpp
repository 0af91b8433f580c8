/// @file
/// The instruction sets of the batch kernels, under the names of this component.
#pragma once

#include "nlmech/support/instruction_set.hpp"

namespace nlmech::geodesy {

using nlmech::available;
using nlmech::best_instruction_set;
using nlmech::InstructionSet;
using nlmech::require_available;
using nlmech::to_string;

}  // namespace nlmech::geodesy
