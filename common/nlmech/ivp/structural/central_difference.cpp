#include "nlmech/ivp/structural/central_difference.hpp"

namespace nlmech::ivp {

template struct Integrator<System<2>, CentralDifference>;
template struct Integrator<System<4>, CentralDifference>;
template struct Integrator<System<6>, CentralDifference>;
template struct Integrator<System<Eigen::Dynamic>, CentralDifference>;

}  // namespace nlmech::ivp
