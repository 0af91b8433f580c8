#include <cstdio>

// [example]
#include "nlmech/ivp/transversal/mtl.hpp"

// A pendulum with friction, shaken: x'' + 0.1 x' + sin x = 0.5 cos 2t.
struct Pendulum {
  static constexpr int dimension = 2;
  template <class T>
  void acceleration(const T& t, const nlmech::Vector<T, 1>& q, const nlmech::Vector<T, 1>& v,
                    nlmech::Vector<T, 1>& a) const {
    using std::cos, std::sin;
    a[0] = 0.5 * cos(2 * t) - 0.1 * v[0] - sin(q[0]);
  }
  template <class T>
  void operator()(const T& t, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    nlmech::Vector<T, 1> a;
    acceleration(t, nlmech::Vector<T, 1>(x[0]), nlmech::Vector<T, 1>(x[1]), a);
    dxdt[0] = x[1];
    dxdt[1] = a[0];
  }
};

int main() {
  using namespace nlmech::ivp;
  const Mtl method{.step = 0.02, .points = 5, .error_tolerance = 1e-6};
  const auto end = integrate(System(Pendulum{}), State{1, 0}, 0, 20, method);
  std::printf("%s: x = %.12f, v = %.12f\n", end.status.text().c_str(), end.x[0], end.x[1]);
  return end.status.ok() ? 0 : 1;
}
// [example]
