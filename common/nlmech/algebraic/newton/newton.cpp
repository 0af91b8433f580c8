#include "nlmech/algebraic/newton/newton.hpp"

namespace nlmech::algebraic {

// What most callers share is compiled here, as a check that the header stands by itself.
template struct Workspace<Eigen::VectorXd>;

}  // namespace nlmech::algebraic
