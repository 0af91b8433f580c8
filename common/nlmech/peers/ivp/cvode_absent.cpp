#include <stdexcept>

#include "nlmech/peers/ivp/cvode.hpp"

namespace nlmech::peers {

bool cvode_available() noexcept { return false; }

Status integrate_by_cvode(Run&, const Cvode&) {
  throw std::logic_error("this build has no CVODE (NLMECH_PEERS)");
}

}  // namespace nlmech::peers
