#include <cstdio>

// [example]
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/problems/problem.hpp"

// A pendulum with friction, driven: q'' = -sin q - 0.1 q' + 0.6 cos(0.8 t).
struct Pendulum {
  static constexpr int dimension = 2;
  template <class T>
  void acceleration(const T& t, const nlmech::Vector<T, 1>& q, const nlmech::Vector<T, 1>& v,
                    nlmech::Vector<T, 1>& a) const {
    using std::cos;
    using std::sin;
    a[0] = -sin(q[0]) - 0.1 * v[0] + 0.6 * cos(0.8 * t);
  }
  template <class T>
  void operator()(const T& t, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    nlmech::problems::first_order_form(*this, t, x, dxdt);
  }
};

int main() {
  using namespace nlmech::ivp;
  const Hermitian method{.operators = laier, .relative_tolerance = 1e-11, .absolute_tolerance = 1e-11};
  const auto end = integrate(System(Pendulum{}), State{0.5, 0}, 0, 20, method);
  std::printf("%s: q = %.9f, v = %.9f\n", end.status.text().c_str(), end.x[0], end.x[1]);
  return end.status.ok() ? 0 : 1;
}
// [example]
