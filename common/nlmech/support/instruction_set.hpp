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

/// Whether this processor (and operating system) can execute @p set and this library was built with it.
[[nodiscard]] bool available(InstructionSet set) noexcept;

/// The largest set that is available.
[[nodiscard]] InstructionSet best_instruction_set() noexcept;

}  // namespace nlmech
