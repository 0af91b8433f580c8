// A build without the libraries: the peers are known by name and reported as absent.
#include <gtest/gtest.h>

#include "nlmech/peers/ivp/gsl/gsl.hpp"
#include "nlmech/peers/ivp/native.hpp"
#include "nlmech/peers/ivp/odeint/odeint.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/peers/ivp/sundials/arkode.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"
#include "tests/ivp/typed.hpp"

namespace nlmech::peers::absent_test {
namespace {

TEST(AbsentPeers, AreKnownByName) {
  EXPECT_EQ(all_peer_names().size(), 13U);
  EXPECT_TRUE(peer_names().empty());
  for (const std::string& name : all_peer_names()) {
    EXPECT_FALSE(peer_info(name).is_available());
    try {
      (void)peer_integrator(name, 1e-9);
      FAIL() << name;
    } catch (const std::logic_error& error) {
      EXPECT_EQ(error.what(), peer_info(name).absent_sentence());
    }
  }
}

TEST(AbsentPeers, RefuseToIntegrate) {
  const ivp::System system = ivp::testing::typed("x' = -x");
  const auto refuses = [&](const auto& method, const std::string& library) {
    try {
      (void)ivp::integrate(system, ivp::State{1.0}, 0, 1, method);
      FAIL() << library;
    } catch (const std::logic_error& error) {
      EXPECT_EQ(error.what(), "this build has no " + library + " (NLMECH_PEERS)");
    }
  };
  refuses(Cvode{}, "CVODE");
  refuses(Arkode{}, "ARKODE");
  refuses(Gsl{}, "GSL");
  refuses(Odeint{}, "Odeint");
}

TEST(AbsentPeers, GetNowhereByThemselves) {
  double x = 1;
  EXPECT_FALSE(gsl_natively({}, {}, 0, 1, &x));
  EXPECT_FALSE(cvode_natively({}, {}, 0, 1, &x));
  EXPECT_EQ(x, 1);
}

}  // namespace
}  // namespace nlmech::peers::absent_test
