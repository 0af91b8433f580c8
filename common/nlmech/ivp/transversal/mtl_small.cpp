#include "nlmech/ivp/transversal/mtl.hpp"

namespace nlmech::ivp {

template struct Integrator<System<1>, Mtl>;
template struct Integrator<System<2>, Mtl>;
template struct Integrator<System<3>, Mtl>;

}  // namespace nlmech::ivp
