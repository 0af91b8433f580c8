#include <stdexcept>

#include "nlmech/peers/ivp/gsl.hpp"

namespace nlmech::peers {

bool gsl_available() noexcept { return false; }

Status integrate_by_gsl(Run&, const Gsl&) { throw std::logic_error("this build has no GSL (NLMECH_PEERS)"); }

}  // namespace nlmech::peers
