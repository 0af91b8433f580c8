#include <stdexcept>

#include "nlmech/peers/ivp/native.hpp"

namespace nlmech::peers {

bool gsl_available() noexcept { return false; }

Status integrate_by(Run&, const Gsl&) { throw std::logic_error("this build has no GSL (NLMECH_PEERS)"); }

bool gsl_natively(const Gsl&, const NativeEquations&, double, double, double*) { return false; }

}  // namespace nlmech::peers
