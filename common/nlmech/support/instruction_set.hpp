/// @file
/// Instruction sets for which kernels are compiled, and the choice among them at run time.
#pragma once

#include <cstdint>
#include <string_view>

namespace nlmech {

/// Sets of vector instructions; each contains the previous one.
enum class InstructionSet : std::uint8_t {
  baseline,  ///< minimum of the architecture (x86-64: SSE2, two lanes, no fused multiply-add)
  avx2,      ///< AVX2 and FMA, four lanes
  avx512     ///< AVX-512 F, DQ and VL, eight lanes
};

/// Name of the enumerator.
[[nodiscard]] std::string_view to_string(InstructionSet set) noexcept;

/// The set that kernels use by default: the largest one that this processor and its operating system execute.
/// The environment variable NLMECH_INSTRUCTION_SET (baseline, avx2 or avx512) chooses a smaller one for every
/// kernel of the process; it is read once; an empty value counts as unset.
/// @throws InputError, at every call, if the variable names a set that is unknown or that the processor lacks
[[nodiscard]] InstructionSet best_instruction_set();

/// May kernels use @p set? True if it is not larger than best_instruction_set(). @throws InputError as that
/// function
[[nodiscard]] bool available(InstructionSet set);

/// @throws std::invalid_argument if @p set is not available; InputError as best_instruction_set()
void require_available(InstructionSet set);

}  // namespace nlmech
