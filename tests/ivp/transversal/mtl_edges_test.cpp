/// Multi-step transversal linearisation: options, problems and blocks that fail, and how they say so.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

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

/// x'' = -x with a linear part or load that cannot be.
struct Odd : testing::Oscillator {
  Eigen::Matrix2d a{{0, 1}, {-1, 0}};
  Harmonic harmonic{1, 1, 0, 0};
  void linear_part(Matrix<double, 2, 2>& out) const { out = a; }
  [[nodiscard]] std::vector<Harmonic> load() const { return {harmonic}; }
};

TEST(Mtl, LinearPartsAndLoadsThatCannotBeAreNamed) {
  const auto complaint = [](const Odd& problem) -> std::string {
    try {
      static_cast<void>(integrate(System(problem), State{1, 0}, 0, 1, Mtl{}));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  Odd odd;
  EXPECT_EQ(complaint(odd), "accepted");
  odd.a(0, 1) = 2;
  EXPECT_NE(complaint(odd).find("[0 1]"), std::string::npos);
  odd = {};
  odd.a(1, 0) = testing::nan;
  EXPECT_NE(complaint(odd).find("not finite"), std::string::npos);
  for (const int component : {-1, 0, 2}) {
    odd = {};
    odd.harmonic.component = component;
    EXPECT_NE(complaint(odd).find("component " + std::to_string(component)), std::string::npos);
  }
  odd = {};
  odd.harmonic.frequency = testing::infinity;
  EXPECT_NE(complaint(odd).find("inf"), std::string::npos);
}

TEST(Mtl, OverflowOfTheLinearPartIsSaid) {
  Odd odd;
  odd.a << 0, 1, 0, 1e3;  // exp(1e3 * 1)
  const auto s = integrate(System(odd), State{1, 0}, 0, 1, Mtl{.step = 1, .points = 1});
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
