/// Which kernels this process may use. That commands obey the environment:
/// tests/commands/scene.t.
#include "nlmech/support/instruction_set.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace nlmech {
namespace {

constexpr InstructionSet sets[] = {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512};

TEST(InstructionSets, UpToTheBestAreAvailableAndNoOther) {
  EXPECT_TRUE(available(InstructionSet::baseline));
  for (const InstructionSet set : sets) {
    EXPECT_EQ(available(set), set <= best_instruction_set()) << to_string(set);
    if (available(set))
      EXPECT_NO_THROW(require_available(set)) << to_string(set);
    else
      EXPECT_THROW(require_available(set), std::invalid_argument) << to_string(set);
  }
}

TEST(InstructionSets, TheEnvironmentChooses) {
  const char* const chosen = std::getenv("NLMECH_INSTRUCTION_SET");
  if (chosen == nullptr || *chosen == '\0') GTEST_SKIP() << "NLMECH_INSTRUCTION_SET is not set";
  EXPECT_EQ(to_string(best_instruction_set()), chosen);
}

}  // namespace
}  // namespace nlmech
