// The System of equations as they are typed, compiled once.
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

System::System(program::Problem problem)
    : problem_(std::make_shared<const Direct<program::Problem>>(std::move(problem))) {}

}  // namespace nlmech::ivp
