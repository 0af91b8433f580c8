// One equation, every integrator of the library.
// [example]
#include <cmath>
#include <cstdio>

#include "nlmech/ivp/named/named_methods.hpp"

struct Pendulum {  // q'' = -sin(q), once: the library calls it with numbers, dual numbers and series
  static constexpr int dimension = 2;
  void acceleration(const auto& /*t*/, const auto& q, const auto& /*v*/, auto& a) const {
    using std::sin;
    a[0] = -sin(q[0]);
  }
  void operator()(const auto& /*t*/, const auto& x, auto& dxdt) const {
    using std::sin;
    dxdt << x[1], -sin(x[0]);
  }
};

int main() {
  using namespace nlmech::ivp;
  const System pendulum(Pendulum{});
  const State rest{2, 0};  // at 2 rad, and so again after a period, which elliptic integrals give
  const double period = 4 * std::comp_ellint_1(std::sin(rest[0] / 2));
  for (const MethodInfo& method : named_methods()) {
    const Settings settings =
        method.fixed_step() ? Settings{.step = period / 1000} : Settings{.tolerance = 1e-8};
    const auto end = named_integrator(method.name, settings)(pendulum, rest, 0, period, {}, {});
    const double error = end.status.ok() ? (end.x - rest).cwiseAbs().maxCoeff() : NAN;
    std::printf("%-20s error %.1e, %8.0f right-hand sides, %s\n", method.name.data(), error,
                double(end.statistics.right_hand_sides), end.status.text().c_str());
  }
}
// [example]
