/// Basis of the chapter's figures and tables.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "chapters/gss_control/control/modal_loop.hpp"
#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "chapters/gss_control/plant/extended.hpp"
#include "nlmech/spacecraft/control/lyapunov.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"

namespace nlmech::chapters::gss_control::studies_test {
namespace {

// 15 digits. oracle: gss_control_plant bare * at 0.1, bare * at 1000, tip * at 1, tip * at 100
TEST(Extended, HasTheKnownValues) {
  struct Known {
    bool tip;
    double omega, theta, middle, end;
  };
  constexpr std::array known = {
      Known{false, 0.1, -9.75833120309274, -0.00155072104594153, -0.00447670586136782},
      Known{false, 1000, -1.26289815221454e-7, 9.33002707313804e-7, -1.56096643502893e-7},
      Known{true, 1, -0.0536584284810462, -0.00487037747371546, -0.0153109262016674},
      Known{true, 100, -1.24569176143171e-5, 4.20049688309619e-5, 6.06691862730473e-5}};
  for (const Known& k : known) {
    const Extended e = extended_response(craft(k.tip), k.omega);
    EXPECT_NEAR(e.value[0] / k.theta, 1, 2e-14) << k.omega;  // of 15 digits
    EXPECT_NEAR(e.value[1] / k.middle, 1, 2e-14) << k.omega;
    EXPECT_NEAR(e.value[2] / k.end, 1, 2e-14) << k.omega;
  }
}

// theta/u ~ -1/(J omega^2) at both ends of low frequencies, whose logarithmic slope is -2.
TEST(Extended, IsRigidAtLowFrequencies) {
  const Extended e = extended_response(craft(true), 1e-6);
  EXPECT_NEAR(e.value[0] * 1e-12 * -18.0961, 1, 1e-12);
  EXPECT_NEAR(e.condition[0], 2, 1e-10);
}

/// The classical Runge-Kutta method on the equations of CVODE's sweep.
Eigen::VectorXd integrate(const ModalLoop& loop, double end, int steps) {
  using Vector = Eigen::VectorXd;
  Vector x = Vector::Zero(loop.size()), a(x.size()), b(x.size()), c(x.size()), d(x.size());
  const double h = end / steps;
  for (int k = 0; k < steps; ++k) {
    loop(0., x, a);
    loop(0., Vector(x + h / 2 * a), b);
    loop(0., Vector(x + h / 2 * b), c);
    loop(0., Vector(x + h * c), d);
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return x;
}

// The control law solved for u, against the matrix exponential of the model before diagonalisation, also with
// root-load feedback. The error of the Runge-Kutta method is (omega h)^4 of small parts: omega h is 0.13 for
// the third mode.
TEST(ModalLoop, IsTheDiscretisedClosedLoop) {
  const auto model = spacecraft::assumed_modes(craft(true), 3);
  for (const spacecraft::Gains& gains : {unit_gains, designed_gains}) {
    const ModalLoop loop(diagonalise(model), gains, 1);
    const Eigen::VectorXd x = integrate(loop, 2, 2500);
    spacecraft::DiscreteLoop exact(model, gains, 1, 0.01);
    for (int k = 0; k < 200; ++k) exact.advance();
    EXPECT_NEAR(loop.angle(x), exact.theta(), 1e-6) << gains.k2;
    const Eigen::VectorXd shapes = diagonalise(model).mode_shapes(2);
    EXPECT_NEAR(shapes.dot(x.segment(1, shapes.size())), exact.deflection(2), 1e-6) << gains.k2;
  }
}

TEST(Grids, HoldTheirEnds) {
  const auto grid = logarithmic(1e-8, 1e8, 33);
  EXPECT_EQ(grid.front(), 1e-8);
  EXPECT_EQ(grid.back(), 1e8);
  EXPECT_EQ(grid.size(), 33U);
  for (std::size_t i = 1; i < grid.size(); ++i) EXPECT_NEAR(grid[i] / grid[i - 1], std::sqrt(10.0), 1e-12);
  EXPECT_THROW((void)logarithmic(0, 1, 5), std::invalid_argument);
  EXPECT_THROW((void)logarithmic(2, 1, 5), std::invalid_argument);
  EXPECT_THROW((void)logarithmic(1, 2, 1), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::chapters::gss_control::studies_test
