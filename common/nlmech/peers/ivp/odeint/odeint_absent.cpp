#include <stdexcept>

#include "nlmech/peers/ivp/odeint/odeint.hpp"

namespace nlmech::peers {

bool odeint_available() noexcept { return false; }

Status integrate_by(Run&, const Odeint&) {
  throw std::logic_error("this build has no Odeint (NLMECH_PEERS)");
}

}  // namespace nlmech::peers
