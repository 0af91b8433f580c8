#include <stdexcept>

#include "nlmech/peers/ivp/native.hpp"

namespace nlmech::peers {

bool cvode_available() noexcept { return false; }

Status integrate_by(Run&, const Cvode&) { throw std::logic_error("this build has no CVODE (NLMECH_PEERS)"); }

bool cvode_natively(const Cvode&, const NativeEquations&, double, double, double*) { return false; }

}  // namespace nlmech::peers
