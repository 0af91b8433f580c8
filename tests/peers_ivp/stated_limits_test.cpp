// Peers are held to what a problem says of its solutions, as our own methods are.
#include <gtest/gtest.h>

#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::peers::stated_limits_test {
namespace {

// Under a tolerance far above y2 the multistep codes let it become negative; the solution then runs away.
TEST(PeersStatedLimits, RobertsonDoesNotRunAway) {
  const ivp::System system(problems::TextProblem("robertson"));
  int refused = 0;
  for (const char* name : {"cvode-bdf", "gsl-msbdf", "arkode-dirk", "odeint-rosenbrock4"}) {
    if (!peer_info(name).is_available()) continue;
    for (const double tolerance : {1e-4, 1e-6}) {
      const auto s = peer_integrator(name, tolerance)(
          system, problems::TextProblem("robertson").initial_state(), 0, 1e11, {}, {.steps = 20'000});
      if (s.status.ok()) {
        EXPECT_GE(s.x.minCoeff(), -20 * tolerance) << name << ' ' << tolerance;
        EXPECT_LE(s.x.maxCoeff(), 1 + 100 * tolerance) << name << ' ' << tolerance;
      } else if (s.status.outcome() == Outcome::spurious_root) {
        ++refused;
        EXPECT_NE(s.status.sentence().find(name), std::string::npos) << s.status.text();
      }
    }
  }
  EXPECT_TRUE(refused > 0 || !peer_info("cvode-bdf").is_available()) << "none of these runs tests anything";
}

}  // namespace
}  // namespace nlmech::peers::stated_limits_test
