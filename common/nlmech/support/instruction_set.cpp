#include "nlmech/support/instruction_set.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech {
namespace {

constexpr InstructionSet all_sets[] = {InstructionSet::baseline, InstructionSet::avx2,
                                       InstructionSet::avx512};
constexpr const char* variable = "NLMECH_INSTRUCTION_SET";

// The run-time test of the compiler covers the processor and the operating system, which must save the wide
// registers.
bool executable(InstructionSet set) noexcept {
  if (set == InstructionSet::baseline) return true;
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

/// The largest set that this processor executes, or the one given by the environment variable.
InstructionSet chosen_set() {
  const char* const text = std::getenv(variable);
  const std::string name = text == nullptr ? "" : text;
  InstructionSet largest = InstructionSet::baseline;
  std::string names;
  for (const InstructionSet set : all_sets) {
    if (!executable(set)) continue;
    if (name == to_string(set)) return set;
    largest = set;
    names += (names.empty() ? "" : ", ") + std::string(to_string(set));
  }
  if (name.empty()) return largest;
  throw InputError(std::string(variable) + "=" + quoted_input(name) +
                   ": is not an instruction set of this processor; choose one of " + names);
}

}  // namespace

std::string_view to_string(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::baseline: return "baseline";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
  }
  return "unknown";
}

InstructionSet best_instruction_set() {
  static const InstructionSet best = chosen_set();
  return best;
}

bool available(InstructionSet set) { return set <= best_instruction_set(); }

void require_available(InstructionSet set) {
  if (available(set)) return;
  throw std::invalid_argument("instruction set " + std::string(to_string(set)) +
                              (executable(set) ? " is larger than " + std::string(variable) + " allows"
                                               : ": this processor has none"));
}

}  // namespace nlmech
