// Peers by name.
#include <gtest/gtest.h>

#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::peers::registry_test {
namespace {

TEST(Registry, HasThirteenPeers) {
  const std::vector<std::string> names = {"cvode-adams",       "cvode-bdf",         "arkode-erk",
                                          "arkode-dirk",       "gsl-rkf45",         "gsl-rk8pd",
                                          "gsl-bsimp",         "gsl-msadams",       "gsl-msbdf",
                                          "odeint-dopri5",     "odeint-fehlberg78", "odeint-bulirsch-stoer",
                                          "odeint-rosenbrock4"};
  EXPECT_EQ(all_peer_names(), names);
  for (const std::string& name : names) EXPECT_TRUE(peer_info(name).is_peer()) << name;
  for (const std::string& name : peer_names()) EXPECT_TRUE(peer_info(name).is_available()) << name;
  EXPECT_THROW((void)peer_info("rk4"), std::invalid_argument);
}

TEST(Registry, SaysWhichPeersThereAre) {
  try {
    (void)peer_integrator("lsoda", 1e-9);
    FAIL() << "there is no lsoda";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(
        std::string(error.what()).find("there is no peer 'lsoda'; choose one of cvode-adams, cvode-bdf"),
        std::string::npos)
        << error.what();
  }
}

TEST(Registry, SaysWhatIsAbsent) {
  EXPECT_EQ(peer_info("gsl-msbdf").absent_sentence(),
            "gsl-msbdf is not in this build: configure with GSL (NLMECH_PEERS)");
}

TEST(Methods, RefuseTolerancesThatAreNone) {
  if (!cvode_available()) GTEST_SKIP();
  const ivp::System system = ivp::testing::typed("x' = -x");
  const auto with = [&](double relative, double absolute) {
    return ivp::integrate(system, ivp::State{1.0}, 0, 1,
                          Cvode{.relative_tolerance = relative, .absolute_tolerance = absolute});
  };
  EXPECT_THROW((void)with(-1, 1e-9), std::invalid_argument);
  EXPECT_THROW((void)with(1e-9, 0), std::invalid_argument);
  EXPECT_TRUE(with(0, 1e-9).status.ok());
}

}  // namespace
}  // namespace nlmech::peers::registry_test
