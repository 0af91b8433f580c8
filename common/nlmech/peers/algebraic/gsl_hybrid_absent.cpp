#include <stdexcept>

#include "nlmech/peers/algebraic/gsl_hybrid.hpp"

namespace nlmech::peers {

bool gsl_hybrid_available() noexcept { return false; }

algebraic::Report find_root(const GslHybrid&, algebraic::Equations&, Eigen::VectorXd&) {
  throw std::logic_error("this build has no GSL (NLMECH_PEERS)");
}

}  // namespace nlmech::peers
