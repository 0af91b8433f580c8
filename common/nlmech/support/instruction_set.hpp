/// @file
/// Instruction sets for which kernels are compiled, and the choice among them at run time.
#pragma once

#include <cstdint>
#include <string_view>

namespace nlmech {

/// Sets of vector instructions, each containing the one before.
enum class InstructionSet : std::uint8_t {
  baseline,  ///< what every processor of the architecture has (x86-64: SSE2, two lanes, no fused
             ///< multiply-add)
  avx2,      ///< AVX2 and FMA, four lanes
  avx512     ///< AVX-512 F, DQ and VL, eight lanes
};

/// The enumerator's own spelling.
[[nodiscard]] std::string_view to_string(InstructionSet set) noexcept;

/// The set that kernels use by default: the largest one that this processor and its operating system execute.
/// The environment variable NLMECH_INSTRUCTION_SET (baseline, avx2 or avx512) chooses a smaller one for every
/// kernel of the process; it is read once, and an empty one is as none.
/// @throws InputError, at every call, if the variable names a set that is unknown or that the processor lacks
[[nodiscard]] InstructionSet best_instruction_set();

/// Whether kernels may use @p set: it is not larger than best_instruction_set(). @throws InputError as there
[[nodiscard]] bool available(InstructionSet set);

/// @throws std::invalid_argument if @p set is not available; InputError as best_instruction_set()
void require_available(InstructionSet set);

}  // namespace nlmech
