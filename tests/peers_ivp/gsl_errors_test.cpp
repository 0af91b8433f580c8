// GSL ends the program at an error by default; the peers switch its error handler off and restore it.
#include <gtest/gtest.h>

#include <gsl/gsl_errno.h>

#include "nlmech/peers/ivp/registry.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::peers::gsl_errors_test {
namespace {

void handler(const char* /*reason*/, const char* /*file*/, int /*line*/, int /*code*/) {}

// x' = k x has the Newton matrix 1 - c h k, which is 0 for one k. For bsimp's first step, 1e-6 from 0, it is
// 1 - h k/2. GSL's error handler would end the program; without it bsimp returns 1e301.
TEST(SingularMatrix, IsNotTakenForASolvedStep) {
  for (const std::string& name : peer_names()) {
    // rosenbrock4 has 4/h - k.
    const ivp::System system =
        ivp::testing::typed(name == "odeint-rosenbrock4" ? "x' = 4e6 x" : "x' = 2e6 x");
    const auto solution = peer_integrator(name, 1e-9)(system, ivp::State{0.0}, 0, 1, {}, {.steps = 10000});
    EXPECT_TRUE(solution.status.ok()) << solution.status.text();
    EXPECT_EQ(solution.x[0], 0) << name;
  }
}

TEST(GslErrors, GoToTheProgramsHandlerAgainAfterwards) {
  gsl_error_handler_t* before = gsl_set_error_handler(&handler);
  const auto look = [](const ivp::Step&) {
    gsl_error_handler_t* now = gsl_set_error_handler_off();  // which it is already
    EXPECT_NE(now, &handler);
    return true;
  };
  (void)peer_integrator("gsl-rk8pd", 1e-9)(ivp::testing::typed("x' = -x"), ivp::State{1.0}, 0, 1, look, {});
  EXPECT_EQ(gsl_set_error_handler(before), &handler);
}

}  // namespace
}  // namespace nlmech::peers::gsl_errors_test
