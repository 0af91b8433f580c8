// A right-hand side that jumps in value: every method must see one smooth function on each side of the jump.
#include <gtest/gtest.h>

#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/implicit/backward_euler.hpp"
#include "nlmech/ivp/runge_kutta/dop853.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"

namespace nlmech::ivp::jump_test {
namespace {

// q'' = 1 before t = 1, q'' = -2 from there on. From rest at 0: q(2) = 1/2 + 1 - 1 = 1/2, v(2) = 1 - 2 = -1.
struct Push {
  static constexpr int dimension = 2;
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>&, const Vector<T, 1>&, Vector<T, 1>& a) const {
    a[0] = T(value_of(t) < 1 ? 1 : -2);
  }
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt << x[1], T(value_of(t) < 1 ? 1 : -2);
  }
  [[nodiscard]] static std::vector<double> discontinuities(double t0, double t1) {
    const bool between = std::min(t0, t1) < 1 && 1 < std::max(t0, t1);
    return between ? std::vector<double>{1} : std::vector<double>{};
  }
};

// Every method of order two or more is exact on each side; 32 steps of 0.0625 round to 32 ulp, collocation to
// the norm of its matrices (some 50) more.
template <class Method>
void expect_exact(const Method& method) {
  const System system(Push{});
  const auto there = integrate(system, {0, 0}, 0, 2, method);
  ASSERT_TRUE(there.status.ok()) << there.status.text();
  EXPECT_NEAR(there.x[0], 0.5, 1e-12) << Method::name;
  EXPECT_NEAR(there.x[1], -1, 1e-12) << Method::name;
  const auto back = integrate(system, {0.5, -1}, 2, 0, method);
  ASSERT_TRUE(back.status.ok()) << back.status.text();
  EXPECT_NEAR(back.x[0], 0, 1e-12) << Method::name << ", backwards";
  EXPECT_NEAR(back.x[1], 0, 1e-12) << Method::name << ", backwards";
}

TEST(Jump, IsNeverLookedAcross) {
  constexpr double h = 0.0625;
  expect_exact(Rk4{.step = h});
  expect_exact(Rk6{.step = h});
  expect_exact(Ode45{});
  expect_exact(Dop853{});
  expect_exact(Newmark{.step = h});
  expect_exact(Hht{.step = h});
  expect_exact(GeneralizedAlpha{.step = h});
  expect_exact(CentralDifference{.step = h});
  expect_exact(Mcpi{.step = h});
  expect_exact(PolynomialCollocation{.step = h, .nodes = 5});
  expect_exact(
      PolynomialCollocation{.step = h, .nodes = 5, .points = collocation::NodeFamily::left_end_and_radau});
}

// Euler is exact for the velocity alone.
TEST(Jump, ShowsEulerTheRightSide) {
  const auto s = integrate(System(Push{}), {0, 0}, 0, 2, Euler{.step = 0.0625});
  EXPECT_NEAR(s.x[1], -1, 1e-14);
  const auto b = integrate(System(Push{}), {0, 0}, 0, 2, BackwardEuler{.step = 0.0625});
  EXPECT_NEAR(b.x[1], -1, 1e-12);
}

}  // namespace
}  // namespace nlmech::ivp::jump_test
