// Another processor, or a build without Xbyak: there is no machine code.
#include "nlmech/program/machine_code/machine_code.hpp"

namespace nlmech::machine_code {

std::shared_ptr<Values> values(const program::Program& /*program*/, std::size_t /*first*/,
                               std::size_t /*last*/) {
  return nullptr;
}
std::shared_ptr<Coefficients> coefficients(const tape::Program& /*program*/, std::int64_t /*stride*/,
                                           int /*order*/) {
  return nullptr;
}
std::shared_ptr<Coefficients> lane_coefficients(const tape::Program& /*program*/, std::int64_t /*stride*/,
                                                int /*order*/, InstructionSet /*set*/) {
  return nullptr;
}

}  // namespace nlmech::machine_code
