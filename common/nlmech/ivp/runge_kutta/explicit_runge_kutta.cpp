#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"

namespace nlmech::ivp {

template struct ExplicitRun<System<1>, Euler>;
template struct ExplicitRun<System<2>, Euler>;
template struct ExplicitRun<System<3>, Euler>;
template struct ExplicitRun<System<4>, Euler>;
template struct ExplicitRun<System<6>, Euler>;
template struct ExplicitRun<System<Eigen::Dynamic>, Euler>;

template struct ExplicitRun<System<1>, Rk4>;
template struct ExplicitRun<System<2>, Rk4>;
template struct ExplicitRun<System<3>, Rk4>;
template struct ExplicitRun<System<4>, Rk4>;
template struct ExplicitRun<System<6>, Rk4>;
template struct ExplicitRun<System<Eigen::Dynamic>, Rk4>;

template struct ExplicitRun<System<1>, Rk6>;
template struct ExplicitRun<System<2>, Rk6>;
template struct ExplicitRun<System<3>, Rk6>;
template struct ExplicitRun<System<4>, Rk6>;
template struct ExplicitRun<System<6>, Rk6>;
template struct ExplicitRun<System<Eigen::Dynamic>, Rk6>;

}  // namespace nlmech::ivp
