/// @file
/// Programs and tapes as functions in machine code, made at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "nlmech/program/program.hpp"
#include "nlmech/program/tape_program.hpp"
#include "nlmech/support/instruction_set.hpp"

/// Machine code for x86-64 with AVX2 or AVX-512. It has the operations of the interpreters in their order,
/// and calls the same functions of the C library, so its results have the same bits; only the signs and
/// payloads of NaN may differ. The memory of a function is writable while it is made, executable afterwards,
/// and never both. Where there is no machine code the functions below return a null pointer: on other
/// processors, with NLMECH_INSTRUCTION_SET=baseline, in a build without Xbyak, and where the system refuses
/// executable memory.
namespace nlmech::machine_code {

/// Computes outputs of a program.
/// @param t time
/// @param x the state
/// @param out one value for each output; must not overlap @p x
using Values = void(double t, const double* x, double* out);

/// The outputs @p first to @p last - 1 of @p program, whose tables the function uses.
[[nodiscard]] std::shared_ptr<Values> values(const program::Program& program, std::size_t first,
                                             std::size_t last);

/// Computes the coefficients of a tape for one solution or one solution per lane.
/// @param memory as for tape::Replay
/// @param constants as for tape::Replay; not used for one solution
/// @param scale unit of time, one per lane
using Coefficients = void(double* memory, const double* constants, const double* scale);

/// The coefficients of one solution with the bits of TapeExpansion by AVX2, all sums unrolled, from the
/// coefficient 0 of time and state and 1 of time. Null also for many products, whose code would be slower or
/// take long to make.
/// @param program need not outlive the function
/// @param stride between series, in doubles
/// @param order of the series, 1 or more
[[nodiscard]] std::shared_ptr<Coefficients> coefficients(const tape::Program& program, std::int64_t stride,
                                                         int order);

/// The coefficients of one solution per lane with the bits of TapeLanes; as coefficients(), for less
/// products. Numbers of 1 and -1 in @p program must be so in all lanes; products with them are omitted.
/// @param set avx2 or avx512; otherwise there is no function
[[nodiscard]] std::shared_ptr<Coefficients> lane_coefficients(const tape::Program& program,
                                                              std::int64_t stride, int order,
                                                              InstructionSet set);

}  // namespace nlmech::machine_code
