// The System of equations as they are typed, compiled once.
#include "nlmech/ivp/compiled_system.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::ivp::detail {

template struct InSystem<program::Problem>;

}  // namespace nlmech::ivp::detail
