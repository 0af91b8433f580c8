#include "nlmech/ivp/implicit/backward_euler.hpp"

namespace nlmech::ivp {

template struct Integrator<System<1>, BackwardEuler>;
template struct Integrator<System<2>, BackwardEuler>;
template struct Integrator<System<3>, BackwardEuler>;

}  // namespace nlmech::ivp
