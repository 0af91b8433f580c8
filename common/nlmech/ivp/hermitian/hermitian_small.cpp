#include "nlmech/ivp/hermitian/hermitian.hpp"

namespace nlmech::ivp {

template struct Integrator<System<2>, Hermitian>;
template struct Integrator<System<4>, Hermitian>;

}  // namespace nlmech::ivp
