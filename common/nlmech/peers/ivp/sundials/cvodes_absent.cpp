// The stand-in of CVODES, which this build does not have.
#include "nlmech/peers/ivp/sundials/cvodes.hpp"

#include <stdexcept>

namespace nlmech::peers {

ivp::Solution integrate_by_cvodes(const Cvode& /*method*/, const ivp::System& /*system*/,
                                  const ivp::System& /*extended*/, std::vector<double> /*sizes*/,
                                  const ivp::State& /*x0*/, double /*t0*/, double /*t1*/,
                                  const std::function<void(double t, const ivp::State& x)>& /*observe*/) {
  throw std::logic_error("CVODES is not part of this build");
}

}  // namespace nlmech::peers
