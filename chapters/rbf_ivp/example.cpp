/// @example chapters/rbf_ivp/example.cpp
/// A damped pendulum, integrated by collocation with Radau nodes.
//! [example]
#include <cmath>
#include <cstdio>

#include "nlmech/ivp/collocation/collocation.hpp"

struct Pendulum {  // written once, for numbers and for the dual numbers that give the Jacobian
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    using std::sin;
    dxdt[0] = x[1];
    dxdt[1] = -sin(x[0]) - 0.1 * x[1];
  }
};

int main() {
  using namespace nlmech;
  const ivp::PolynomialCollocation method{
      .step = 1, .nodes = 12, .points = collocation::NodeFamily::left_end_and_radau};
  const auto end = ivp::integrate(ivp::System(Pendulum{}), {1, 0}, 0, 10, method);
  std::printf("%s: x = %.12f, v = %.12f\n", end.status.text().c_str(), end.x[0], end.x[1]);
}
//! [example]
