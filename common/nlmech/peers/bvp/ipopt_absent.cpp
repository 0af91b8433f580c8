#include <stdexcept>

#include "nlmech/peers/bvp/ipopt.hpp"

namespace nlmech::peers {

bool ipopt_available() noexcept { return false; }

bvp::DirectResult ipopt_start(const bvp::ExtremalProblem&, const bvp::ControlGuess&, const IpoptOptions&) {
  throw std::logic_error("this build has no Ipopt (NLMECH_PEERS)");
}

}  // namespace nlmech::peers
