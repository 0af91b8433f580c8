/// @file
/// Data of a tape for the kernels: plain numbers in arrays.
#pragma once

#include <cstdint>

namespace nlmech::tape {

/// Operation of an instruction on coefficients; r is the series of the result, a and b are those of the
/// operands.
enum class Operation : std::uint8_t {
  linear,              ///< factor (shift + sum of terms) / divisor
  product,             ///< a b
  product_by_line,     ///< a b, where a is linear
  square,              ///< a a
  quotient,            ///< a / b
  reciprocal,          ///< factor / b
  root,                ///< sqrt a
  slope,               ///< s a'(s), s the variable of the series
  arc_sine,            ///< asin a; extra: its slope
  arc_cosine,          ///< acos a; extra: its slope
  arc_tangent,         ///< atan a; extra: its slope
  angle,               ///< atan2(a, b); extra: its slope
  area_sine,           ///< asinh a; extra: its slope
  error_function,      ///< erf a; extra: its slope
  exponential,         ///< exp a; extra: slope of a
  circular,            ///< sin a, and cos a in r + 1; extra: slope of a
  hyperbolic,          ///< sinh a, and cosh a in r + 1; extra: slope of a
  tangent,             ///< tan a, and 1 + tan^2 in r + 1; extra: slope of a
  hyperbolic_tangent,  ///< tanh a, and 1 - tanh^2 in r + 1; extra: slope of a
  logarithm,           ///< log a, and its slope in r + 1
  power                ///< a^factor, and its slope in r + 1; extra: slope of a
};

/// An operation with its series and numbers.
struct Instruction {
  Operation operation;  ///< the operation
  bool line;            ///< is `extra` the slope of a linear series?
  int r;                ///< series of the result
  int a;                ///< series of the first operand
  int b;                ///< series of the second operand
  int extra;            ///< a further series, see Operation
  int first;            ///< first term of a linear combination
  int count;            ///< number of terms
  double factor;        ///< a number, see Operation
  double divisor;       ///< a number, see Operation
  double shift;         ///< a number, see Operation

  /// Are all members equal?
  bool operator==(const Instruction&) const = default;
};

/// A term of a linear combination.
struct Term {
  double factor;  ///< number
  int series;     ///< series that it multiplies

  /// Are all members equal?
  bool operator==(const Term&) const = default;
};

/// A component of the right-hand side.
struct Output {
  int series;       ///< series of the component; -1: a constant
  double constant;  ///< value of the constant

  /// Are all members equal?
  bool operator==(const Output&) const = default;
};

/// A tape. Series 0 is the time, 1 to size are the state, then follow the results of the instructions.
struct Program {
  const Instruction* instructions;  ///< in the order of evaluation
  int instruction_count;            ///< number of instructions
  const Term* terms;                ///< terms of all linear combinations
  int term_count;                   ///< number of terms
  const Output* outputs;            ///< one per component of the state
  int size;                         ///< components of the state
};

/// Indices of the constants of a lane if solutions have their own: three per instruction, then those of the
/// terms, then those of the outputs.
/// @{
[[nodiscard, gnu::always_inline]] constexpr int factor_of(int instruction) { return 3 * instruction; }
[[nodiscard, gnu::always_inline]] constexpr int divisor_of(int instruction) { return 3 * instruction + 1; }
[[nodiscard, gnu::always_inline]] constexpr int shift_of(int instruction) { return 3 * instruction + 2; }
[[nodiscard, gnu::always_inline]] constexpr int term_of(const Program& program, int term) {
  return 3 * program.instruction_count + term;
}
[[nodiscard, gnu::always_inline]] constexpr int output_of(const Program& program, int i) {
  return term_of(program, program.term_count) + i;
}
/// @}

/// Computes coefficients k = 1, ..., order - 1 of all series, and 2, ..., order of the state. Series i starts
/// at @p memory + i stride. Coefficient k + 1 of the state is that of the right-hand side times *@p scale /
/// (k + 1): by division for k < first_reciprocal, otherwise by the product of the scale and @p
/// reciprocals[k]. For lanes there is one coefficient, constant and scale per lane.
using Replay = void (*)(const Program& program, const double* constants, double* memory, std::int64_t stride,
                        int order, const double* scale, const double* reciprocals);

/// First k with a rounded reciprocal in place of a division; terms below it are large.
inline constexpr int first_reciprocal = 8;

extern const Replay baseline_replay;  ///< compiled for every machine
extern const Replay avx2_replay;      ///< compiled for AVX2

/// Kernel for several solutions in parallel, one per lane.
struct LaneKernel {
  int lanes;  ///< number of lanes
  Replay
      replay;  ///< replay for all lanes, with the bits of baseline_replay (in baseline_lanes) or avx2_replay
  /// SeriesTail of all components: @p tails has `last` of all lanes, then `before`, then `sum`.
  void (*measure)(const double* memory, std::int64_t stride, int size, int order, double absolute,
                  double relative, double* tails);
  /// Adds the sums of c_k s^k for k = 1, ..., order >= 2 to the components of the state by add_increment(),
  /// with @p carries[i lanes + lane] and so on.
  void (*advance)(const double* memory, std::int64_t stride, int size, int order, const double* s,
                  const double* carries, double* ends, double* end_carries);
};

extern const LaneKernel baseline_lanes;  ///< compiled for every machine
extern const LaneKernel avx2_lanes;      ///< compiled for AVX2
extern const LaneKernel avx512_lanes;    ///< compiled for AVX-512

}  // namespace nlmech::tape
