// Systems of the problems that the tests of integrators share, so that no source compiles one anew.
#include "nlmech/ivp/compiled_system.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::detail {

template struct InSystem<testing::JumpingForce>;
template struct InSystem<testing::Manufactured>;
template struct InSystem<testing::Oscillator>;
template struct InSystem<testing::Poisoned>;

}  // namespace nlmech::ivp::detail
