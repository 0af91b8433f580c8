// x' = -x from 1 to e^-1.
#include <cmath>

#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"

struct Decay {
  static constexpr int dimension = 1;
  void operator()(const auto& /*t*/, const auto& x, auto& dxdt) const { dxdt[0] = -x[0]; }
};

int main() {
  using namespace nlmech::ivp;
  const auto end = integrate(System(Decay{}), State{1}, 0, 1, Rk4{.step = 0.01});
  return end.status.ok() && std::abs(end.x[0] - std::exp(-1)) < 1e-10 ? 0 : 1;
}
