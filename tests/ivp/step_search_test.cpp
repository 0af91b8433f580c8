/// The search of a step by a tolerance: runs that agree and are wrong are not accepted.
#include "nlmech/ivp/named/step_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "nlmech/ivp/named/named_evidence.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::step_search_test {
namespace {

using problems::Duffing;
using problems::LinearOscillator;

const State one{1, 0};

Solution search(std::string_view name, double tolerance, const System& system, const State& x0, double end,
                const Limits& limits = {}) {
  return named_integrator(name, {.tolerance = tolerance})(system, x0, 0, end, {}, limits);
}

// ------------------------------------------------------------ the account

TEST(StepSearch, CountsShareNoFactorAndDifferInParity) {
  std::int64_t count = 16;
  for (int k = 0; k < 30; ++k) {
    const std::int64_t next = detail::SearchAccount::next_count(count);
    EXPECT_EQ(std::gcd(count, next), 1) << count;
    EXPECT_NE(count % 2, next % 2) << count;
    EXPECT_NEAR(static_cast<double>(next) / static_cast<double>(count), 2, 0.13);
    count = next;
  }
}

TEST(StepSearch, TimesLieOnTheWayAndCrowdWhereItBegins) {
  for (const double end : {4.0, -4.0}) {
    const std::vector<double> times = detail::search_times(0, end, {end / 2});
    EXPECT_EQ(times.back(), end);
    EXPECT_GT(times.size(), 60U);
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_GT(times[i] / end, i == 0 ? 0 : times[i - 1] / end);
    }
    EXPECT_LT(times.front() / end, 1e-5);
    // And after the jump.
    EXPECT_TRUE(std::any_of(times.begin(), times.end(),
                            [end](double t) { return t / end > 0.5 && t / end < 0.503; }));
  }
}

struct Growth {
  static constexpr int dimension = 1;
  void operator()(const auto& /*t*/, const auto& x, auto& dxdt) const { dxdt[0] = x[0]; }
};

/// A method that stays where it is, and its step a success.
Solution frozen(double /*step*/, const Observer& observer, const Limits& /*limits*/) {
  struct Dense : DenseOutput {
    void at(double /*t*/, State& x) const override { x[0] = 1; }
  };
  const State x{1.0};
  const Nodes states = x;
  const Dense dense;
  const double end = 1;
  observer({1, 0, 1, x, x, std::span(&end, 1), states, dense});
  return {1, x, {}, {.steps = 16}};
}

// Two runs that agree are not enough: a reference that moves, or an invariant, objects until nothing is left.
TEST(StepSearch, EvidenceObjectsToRunsThatAgree) {
  const State x0{1.0};
  const StepSearch asked{.name = "frozen", .order = 2, .tolerance = 1e-3, .most_steps = 1 << 12};
  const auto without = search_step(asked, frozen, {}, 0, x0, 1, {}, {});
  EXPECT_TRUE(without.status.ok()) << without.status.text();

  Evidence moving;
  moving.references.push_back([&x0](const Observer& observer, const Limits& limits) {
    return integrate(System(Growth{}), x0, 0, 1, Rk6{.step = 0.1}, observer, limits);
  });
  const auto with = search_step(asked, frozen, moving, 0, x0, 1, {}, {});
  EXPECT_EQ(with.status.outcome(), Outcome::not_converged);
  EXPECT_NE(with.status.sentence().find("another method by 0.86"), std::string::npos) << with.status.text();

  Evidence lawful;
  lawful.violation = [](double /*t*/, const State& x) { return 5 * x[0]; };
  const auto broken = search_step(asked, frozen, lawful, 0, x0, 1, {}, {});
  EXPECT_EQ(broken.status.outcome(), Outcome::not_converged);
  EXPECT_NE(broken.status.sentence().find("invariants"), std::string::npos) << broken.status.text();
}

TEST(StepSearch, AReferenceThatEndsEarlyConfirmsNothing) {
  Evidence none;
  const State x0{1.0};
  none.references.push_back([&x0](const Observer&, const Limits& limits) {
    return Solution{0.5, x0, step_limit("reference", 0.5, limits.steps), {}};
  });
  const StepSearch asked{.name = "frozen", .tolerance = 1e-3, .frequency = 1e9};
  const auto s = search_step(asked, frozen, none, 0, x0, 1, {}, {});
  EXPECT_EQ(s.status.outcome(), Outcome::not_converged);
  for (const std::string word : {"no other method", "1e+09 rad", "earlier end"})
    EXPECT_NE(s.status.sentence().find(word), std::string::npos) << s.status.text();
}

// ------------------------------------------------------------ what is known of a system

TEST(StepSearch, KnowsTheFrequenciesOfASystem) {
  const auto highest = [](const LinearOscillator& p) { return named::highest_frequency(System(p), 0, one); };
  EXPECT_NEAR(highest({.natural_frequency = 7}), 7, 1e-13);
  EXPECT_NEAR(highest({.natural_frequency = 7, .force = 1, .frequency = -90}), 90, 0);
  EXPECT_NEAR(highest({.natural_frequency = 7, .frequency = 90}), 7, 1e-13);  // no force
  EXPECT_EQ(highest({.natural_frequency = 7, .damping_ratio = 2}), 0);        // creeps
}

TEST(StepSearch, CountsBrokenLawsInTolerances) {
  const System system(Duffing{});
  const Evidence evidence = named::evidence_of(system, one, 0, 1, 1e-6);
  ASSERT_TRUE(evidence.violation);
  const State later = oracle::duffing(0.7);
  EXPECT_LT(evidence.violation(0.7, later), 1e-6);
  State wrong = later;
  wrong[0] += 1e-5;  // the unit is 1e-6 (1 + |x|), and that of the velocity counts with it
  EXPECT_GT(evidence.violation(0.7, wrong), 1);
  EXPECT_LT(evidence.violation(0.7, wrong), 10);

  // Concentrations do not become negative.
  const System reaction(problems::Robertson{});
  const State begin = problems::Robertson::initial_state();
  const Evidence bounded = named::evidence_of(reaction, begin, 0, 1, 1e-6);
  ASSERT_TRUE(bounded.violation);
  EXPECT_EQ(bounded.violation(0, begin), 0);
  EXPECT_NEAR(bounded.violation(1, State{1 + 1e-5, -1e-5, 0}), 10, 0.1);
}

// ------------------------------------------------------------ what used to be accepted

// Both runs have died out in their first steps.
TEST(StepSearch, RunsThatHaveDiedOutAreNotAccepted) {
  const double w = 5000, tolerance = 1e-3;
  const System system(LinearOscillator{.natural_frequency = w});
  for (const char* name : {"backward-euler", "hht", "generalized-alpha", "lgl-coll", "radau-coll"}) {
    const auto s = search(name, tolerance, system, one, 1, {.steps = 20'000});
    EXPECT_TRUE(!s.status.ok() || std::abs(s.x[0] - std::cos(w)) <= 5 * tolerance) << name << ": " << s.x[0];
  }
  const auto s = search("radau-coll", tolerance, system, one, 1);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], std::cos(w), 5 * tolerance);
}

// Steps that meet a load at its crests see a constant force.
TEST(StepSearch, RunsThatMeetALoadAtItsCrestsAreNotAccepted) {
  const LinearOscillator crests{.force = 10, .frequency = 6433.981754551896};  // 2 pi 1024
  const double right =
      10 * (std::cos(1) - std::cos(crests.frequency)) / (crests.frequency * crests.frequency - 1);
  const auto s = search("newmark", 1e-6, System(crests), State::Zero(2), 1);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], right, 2e-6);

  // And where the problem does not say what loads it.
  const problems::ThreeMassChain chain{.force = 10, .frequency = 6283.185307179586};
  for (const char* name : {"rk4", "rk6"}) {
    const auto three = search(name, 1e-9, System(chain), State::Zero(6), 1.024);
    ASSERT_TRUE(three.status.ok()) << three.status.text();
    EXPECT_NEAR(three.x[1], -1.70e-7, 5e-10) << name;  // two other programs
  }
}

// The amplification of Newmark's method tends to -1: after an even number of steps the state is back.
TEST(StepSearch, RunsThatStandStillAreNotAccepted) {
  const auto s = search("newmark", 1e-9, System(LinearOscillator{.natural_frequency = 1e10}), one, 1);
  EXPECT_EQ(s.status.outcome(), Outcome::not_converged);
  EXPECT_NE(s.status.sentence().find("frequency of 1e+10 rad"), std::string::npos) << s.status.text();
  EXPECT_LT(s.statistics.steps, 10'000);
}

// States between ends of steps are within the tolerance too: observers print them.
TEST(StepSearch, HoldsDenseOutput) {
  const double tolerance = 1e-7;
  for (const char* name : {"rk6", "radau-coll", "mcpi", "mtl", "explicit", "backward-euler"}) {
    const double asked =
        name == std::string("explicit") || name == std::string("backward-euler") ? 1e-3 : tolerance;
    double worst = 0;
    State x(2);
    const Observer observe = [&](const Step& s) {
      for (const double share : {0.31, 0.77}) {
        const double t = s.t0 + share * (s.t1 - s.t0);
        if (s.index % 37 != 1) continue;
        s.dense.at(t, x);
        const State truth = oracle::duffing(t);
        for (int i = 0; i < 2; ++i)
          worst = std::max(worst, std::abs(x[i] - truth[i]) / (1 + std::abs(truth[i])));
      }
      return true;
    };
    const auto s = named_integrator(name, {.tolerance = asked})(System(Duffing{}), one, 0, 3, observe, {});
    ASSERT_TRUE(s.status.ok()) << s.status.text();
    EXPECT_LE(worst, 3 * asked) << name;
  }
}

// A stiff motion, and one that cannot be expanded in a series, have a reference too.
TEST(StepSearch, FallsBackToAnotherReference) {
  const LinearOscillator creeping{.natural_frequency = 1e3, .damping_ratio = 5e3};  // rates 0.1 and 1e7
  const double rate = 1e3 / (5e3 + std::sqrt(5e3 * 5e3 - 1));
  const auto s = search("radau-coll", 1e-6, System(creeping), State{1, -rate}, 10);
  ASSERT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_NEAR(s.x[0], std::exp(-10 * rate), 4e-6);

  const testing::Unannounced<testing::Manufactured> plain;
  const auto m = search("rk4", 1e-8, System(plain), plain.problem.exact(0), 3);
  ASSERT_TRUE(m.status.ok()) << m.status.text();
  EXPECT_LE(oracle::distance(m.x, plain.problem.exact(3)), 4e-8);
}

}  // namespace
}  // namespace nlmech::ivp::step_search_test
