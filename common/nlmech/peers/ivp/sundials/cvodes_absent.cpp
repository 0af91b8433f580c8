// The stand-in of CVODES, which this build does not have.
#include "nlmech/peers/ivp/sundials/cvodes.hpp"

namespace nlmech::peers {

bool cvodes_available() noexcept { return false; }

bool cvodes_natively(const Cvode& /*method*/, const ivp::System& /*system*/, const ivp::System& /*extended*/,
                     const std::vector<double>& /*sizes*/, double /*t0*/, double /*t1*/, ivp::State& /*x*/) {
  return false;
}

}  // namespace nlmech::peers
