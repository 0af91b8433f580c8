// A stranger's equation, integrated by a compiled method and by one inlined into this program.
#include <cmath>

#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"

struct Pendulum {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T&, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    using std::sin;
    dxdt << x[1], -sin(x[0]);
  }
};

int main() {
  using namespace nlmech::ivp;
  const auto compiled = integrate(System(Pendulum{}), {1, 0}, 0, 10, Rk4{.step = 0.01});
  const auto inlined = integrate(Direct(Pendulum{}), {1, 0}, 0, 10, Rk4{.step = 0.01});
  const auto energy = [](const State& x) { return x[1] * x[1] / 2 - std::cos(x[0]); };
  const bool good = compiled.status.ok() && inlined.status.ok() &&
                    std::abs(energy(compiled.x) + std::cos(1.0)) < 1e-8 &&
                    (compiled.x - inlined.x).norm() < 1e-12;
  return good ? 0 : 1;
}
