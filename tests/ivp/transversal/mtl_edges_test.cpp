/// Multi-step transversal linearisation: options, problems and blocks that fail, and how they say so.
#include <gtest/gtest.h>

#include <string>

#include "nlmech/ivp/transversal/mtl.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::mtl_edges_test {
namespace {

using testing::eps;
using testing::refusal;

TEST(Mtl, OptionsOutOfRangeAreNamed) {
  EXPECT_NE(refusal(Mtl{.step = 0}).find("step must be positive"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.points = 0}).find("points must be between 1 and 8, not 0"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.points = 9}).find("not 9"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.error_tolerance = -1}).find("-1"), std::string::npos);
  EXPECT_NE(refusal(Mtl{.error_tolerance = testing::infinity}).find("inf"), std::string::npos);
}

/// x'' = 1000 x'.
struct Growing {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = 1000 * x[1];
  }
};

TEST(Mtl, OverflowOfTheLinearPartIsSaid) {
  const auto s = integrate(System(Growing{}), State{1, 0}, 0, 1, Mtl{.step = 1, .points = 1});  // exp(1000)
  EXPECT_EQ(s.status.outcome(), Outcome::non_finite);
  EXPECT_NE(s.status.sentence().find("linear part"), std::string::npos) << s.status.text();
}

// A force that is no number ends the step, whatever start Newton's iteration takes.
TEST(Mtl, NonFiniteForceIsAStatus) {
  const auto s = integrate(System(testing::Poisoned{}), State{1, 0}, 0, 1, Mtl{.step = 0.1, .points = 2});
  EXPECT_EQ(s.status.outcome(), Outcome::non_finite);
  EXPECT_NEAR(s.t, 0.4, 1e-12);
  EXPECT_TRUE(s.x.allFinite());
}

}  // namespace
}  // namespace nlmech::ivp::mtl_edges_test
