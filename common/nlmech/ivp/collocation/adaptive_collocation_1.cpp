// A file for each size: all in one took minutes to compile.
#include "nlmech/ivp/collocation/adaptive_collocation.hpp"

namespace nlmech::ivp {

template struct Integrator<System<1>, AdaptiveCollocation>;

}  // namespace nlmech::ivp
