#include "nlmech/ivp/implicit/backward_euler.hpp"

namespace nlmech::ivp {

template struct Integrator<System<4>, BackwardEuler>;
template struct Integrator<System<6>, BackwardEuler>;
template struct Integrator<System<Eigen::Dynamic>, BackwardEuler>;

}  // namespace nlmech::ivp
