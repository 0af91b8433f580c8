#include "nlmech/algebraic/newton/newton.hpp"

namespace nlmech::algebraic {

// The sizes that most callers share are compiled here, as a check that the header stands by itself.
template struct Workspace<Eigen::VectorXd, Eigen::MatrixXd>;

}  // namespace nlmech::algebraic
