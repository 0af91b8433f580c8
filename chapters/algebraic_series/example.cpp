#include <cstdio>

// [example]
#include "nlmech/ivp/series/series.hpp"

// A mass between two walls that repel it: x'' = -x/(1 - x^2).
struct HardWall {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = -x[0] / (1 - x[0] * x[0]);
  }
};

int main() {
  using namespace nlmech::ivp;
  const Series method{.relative_tolerance = 1e-13, .absolute_tolerance = 1e-13};
  const auto end = integrate(System(HardWall{}), State{0.9, 0}, 0, 100, method);
  std::printf("%s: x = %.12f, v = %.12f\n", end.status.text().c_str(), end.x[0], end.x[1]);
  return end.status.ok() ? 0 : 1;
}
// [example]
