#include "nlmech/ivp/hermitian/hermitian.hpp"

namespace nlmech::ivp {

template struct Integrator<System<6>, Hermitian>;
template struct Integrator<System<Eigen::Dynamic>, Hermitian>;

}  // namespace nlmech::ivp
