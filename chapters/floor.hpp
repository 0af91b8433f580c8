/// @file
/// Lower bound of the time of a SIMD computation: its multiply-adds alone. Included by programs of
/// `make bench`.
#pragma once

#include <cstdint>

#include "nlmech/support/instruction_set.hpp"

namespace nlmech::chapters {

/// Doubles in a SIMD register of the instruction set.
[[nodiscard]] inline int register_width(InstructionSet set) {
  return set == InstructionSet::avx512 ? 8 : set == InstructionSet::avx2 ? 4 : 2;
}

namespace detail {

/// Operands that the compiler cannot fold to constants.
inline const volatile double unknown[] = {0.5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};

/// Multiply-adds of whole registers in twelve independent chains, which hide the latency. All operands stay
/// in registers.
template <class Register>
[[gnu::always_inline]] inline double multiply_adds(std::int64_t count) {
  const Register factor = Register{} + unknown[0], term = Register{} + unknown[1];
  Register a = term + unknown[2], b = term + unknown[3], c = term + unknown[4], d = term + unknown[5],
           e = term + unknown[6], f = term + unknown[7], g = term + unknown[8], h = term + unknown[9],
           i = term + unknown[10], j = term + unknown[11], k = term + unknown[12], l = term + unknown[13];
  for (std::int64_t done = 0; done < count; done += 12) {
    a = a * factor + term, b = b * factor + term, c = c * factor + term, d = d * factor + term;
    e = e * factor + term, f = f * factor + term, g = g * factor + term, h = h * factor + term;
    i = i * factor + term, j = j * factor + term, k = k * factor + term, l = l * factor + term;
  }
  const Register sum = ((a + b) + (c + d)) + ((e + f) + (g + h)) + ((i + j) + (k + l));
  return sum[0];
}

template <int n>
struct OfWidth {
  using Register [[gnu::vector_size(n * sizeof(double))]] = double;
};

#if defined(__x86_64__)
[[gnu::target("avx2,fma"), gnu::noinline]] inline double multiply_adds_avx2(std::int64_t count) {
  return multiply_adds<OfWidth<4>::Register>(count);
}
[[gnu::target("avx512f,fma"), gnu::noinline]] inline double multiply_adds_avx512(std::int64_t count) {
  return multiply_adds<OfWidth<8>::Register>(count);
}
#endif

}  // namespace detail

/// Computes @p count multiply-adds of doubles with registers of @p set. @returns one of the sums, so that
/// the compiler cannot remove the loop
[[nodiscard]] inline double multiply_adds(InstructionSet set, double count) {
  const auto registers = static_cast<std::int64_t>(count / register_width(set));
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return detail::multiply_adds_avx512(registers);
  if (set == InstructionSet::avx2) return detail::multiply_adds_avx2(registers);
#endif
  return detail::multiply_adds<detail::OfWidth<2>::Register>(registers);
}

}  // namespace nlmech::chapters
