#include <stdexcept>

#include "nlmech/peers/algebraic/kinsol.hpp"

namespace nlmech::peers {

bool kinsol_available() noexcept { return false; }

algebraic::Report find_root(const Kinsol&, algebraic::Equations&, Eigen::VectorXd&,
                            const algebraic::Observer&) {
  throw std::logic_error("this build has no KINSOL (NLMECH_PEERS)");
}

}  // namespace nlmech::peers
