#include <stdexcept>

#include "nlmech/peers/ivp/sundials/arkode.hpp"

namespace nlmech::peers {

bool arkode_available() noexcept { return false; }

Status integrate_by(Run&, const Arkode&) {
  throw std::logic_error("this build has no ARKODE (NLMECH_PEERS)");
}

}  // namespace nlmech::peers
