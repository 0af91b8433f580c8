// System of typed equations, compiled once in the library.
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

System::System(program::Problem problem)
    : problem_(std::make_shared<const Direct<program::Problem>>(std::move(problem))) {}

}  // namespace nlmech::ivp
