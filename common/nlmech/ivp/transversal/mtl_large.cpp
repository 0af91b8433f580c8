#include "nlmech/ivp/transversal/mtl.hpp"

namespace nlmech::ivp {

template struct Integrator<System<4>, Mtl>;
template struct Integrator<System<6>, Mtl>;
template struct Integrator<System<Eigen::Dynamic>, Mtl>;

}  // namespace nlmech::ivp
