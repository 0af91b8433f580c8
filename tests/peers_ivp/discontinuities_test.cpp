// Steps land on announced discontinuities and do not look across them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "nlmech/problems/texts.hpp"
#include "tests/peers_ivp/peers.hpp"

namespace nlmech::peers::discontinuities_test {
namespace {

using namespace testing;
class EveryPeerAtJumps : public EveryPeer {};
INSTANTIATE_TEST_SUITE_P(Peers, EveryPeerAtJumps, ::testing::ValuesIn(all_peer_names()), test_name);

// x' = 1 before a time, -1 from there on. On each side every formula is exact to rounding, and the first
// slope from the other side would cost a step's length.
struct Kink {
  static constexpr int dimension = 1;
  double at = 0.3;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& /*x*/, Vector<T, 1>& dxdt) const {
    dxdt[0] = T(value_of(t) < at ? 1.0 : -1.0);
  }
  [[nodiscard]] std::vector<double> discontinuities(double from, double to) const {
    const bool between = std::min(from, to) < at && at < std::max(from, to);
    return between ? std::vector<double>{at} : std::vector<double>{};
  }
};

// Most make a rounding or two a step, bsimp some for each of 160 substeps, which its extrapolation enlarges:
// 160 eps have been seen. One look across the jump by a rounding error of t cost bsimp 1e-7.
constexpr double roundings = 5000 * eps;

TEST_P(EveryPeerAtJumps, NeverLooksAcrossOne) {
  const auto there = run(ivp::System(Kink{}), ivp::State{0.0}, 0, 1);
  ASSERT_TRUE(there.status.ok()) << there.status.text();
  EXPECT_NEAR(there.x[0], -0.4, roundings);
  EXPECT_EQ(there.statistics.rejected, 0);
  const auto back = run(ivp::System(Kink{}), ivp::State{-0.4}, 1, 0);
  ASSERT_TRUE(back.status.ok()) << back.status.text();
  EXPECT_NEAR(back.x[0], 0, roundings);
  EXPECT_EQ(back.statistics.rejected, 0);
}

RC_GTEST_PROP(PeersAtJumps, NeverLookAcrossOneAnywhere, ()) {
  if (peer_names().empty()) return;
  const std::string peer = *rc::gen::elementOf(peer_names());
  const double at = *rc::gen::inRange(1, 1'000'000) / 1e6;
  const bool forwards = *rc::gen::arbitrary<bool>();
  const auto solution = peer_integrator(peer, 1e-6)(ivp::System(Kink{at}), ivp::State{0.0}, forwards ? 0 : 1,
                                                    forwards ? 1 : 0, {}, {});
  RC_ASSERT(solution.status.ok());
  RC_ASSERT(std::abs(solution.x[0] - (forwards ? 2 * at - 1 : 1 - 2 * at)) < roundings);
}

// The impact of Table 4.3. States at 1/2 and 1 by Taylor series of order 64 in 60 digits.
TEST_P(EveryPeerAtJumps, LandsOnTheCornersOfAnImpact) {
  const ivp::State half{0.04114876293396327914860, 0.2448313772903179460346};
  const ivp::State one{0.2345637237526737363950, 0.4279799258511257045665};
  std::set<double> ends;
  double worst = 0;
  const auto note = [&](const ivp::Step& step) {
    ends.insert(step.t1);
    if (step.t1 == 0.5) worst = std::max(worst, (step.x1 - half).lpNorm<Eigen::Infinity>());
    if (step.t1 == 1) worst = std::max(worst, (step.x1 - one).lpNorm<Eigen::Infinity>());
    return true;
  };
  const ivp::System system(problems::TextProblem("impact"));
  const auto there = run(system, {0, 0}, 0, 2, 1e-9, note);
  ASSERT_TRUE(there.status.ok()) << there.status.text();
  EXPECT_TRUE(ends.contains(0.5) && ends.contains(1.0) && ends.contains(2.0));
  // Two short smooth pieces: errors add up over some ten (order 8) to some hundred (BDF) steps.
  EXPECT_LT(worst, 100e-9);

  ends.clear();
  const auto back = run(system, there.x, 2, 0, 1e-9, note);
  ASSERT_TRUE(back.status.ok()) << back.status.text();
  EXPECT_TRUE(ends.contains(1.0) && ends.contains(0.5) && ends.contains(0.0));
  EXPECT_LT(back.x.lpNorm<Eigen::Infinity>(), 400e-9);
}

}  // namespace
}  // namespace nlmech::peers::discontinuities_test
