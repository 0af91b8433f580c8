/// @file
/// What the tests of peers share: each runs for every peer by name, and skips those that the build lacks.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/program/value_of.hpp"

namespace nlmech::peers::testing {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

class EveryPeer : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!peer_info(GetParam()).is_available()) GTEST_SKIP() << peer_info(GetParam()).absent_sentence();
  }
  /// Runs the peer of this test.
  static ivp::Solution run(const ivp::System& system, const ivp::State& x0, double t0, double t1,
                           double tolerance = 1e-9, const ivp::Observer& observer = {},
                           const ivp::Limits& limits = {.steps = 1'000'000, .seconds = 20}) {
    return peer_integrator(GetParam(), tolerance)(system, x0, t0, t1, observer, limits);
  }
  /// A failure says who failed and where.
  static void expect_failure(const ivp::Solution& solution, Outcome outcome) {
    const std::string& sentence = solution.status.sentence();
    EXPECT_EQ(solution.status.outcome(), outcome) << solution.status.text();
    EXPECT_TRUE(solution.x.allFinite()) << sentence;
    EXPECT_TRUE(std::isfinite(solution.t));
    EXPECT_TRUE(sentence.starts_with(GetParam() + ":")) << sentence;
    EXPECT_NE(sentence.find("t = "), std::string::npos) << sentence;
  }
};

inline std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// x' = -x.
struct Decay {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    dxdt[0] = -x[0];
  }
};

}  // namespace nlmech::peers::testing
