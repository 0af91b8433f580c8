// What libraries do wrong in silence is a status here. Each test ran into the fault that it names before the
// walk of the peers watched for it.
#include <chrono>
#include <stdexcept>
#include <thread>

#include "nlmech/problems/texts.hpp"
#include "tests/peers_ivp/peers.hpp"

namespace nlmech::peers::failures_test {
namespace {

using namespace testing;
class EveryPeerFails : public EveryPeer {
 protected:
  // Libraries print on their own, if they are let.
  void SetUp() override {
    EveryPeer::SetUp();
    if (!IsSkipped()) ::testing::internal::CaptureStderr();
  }
  void TearDown() override {
    if (!IsSkipped()) {
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Peers, EveryPeerFails, ::testing::ValuesIn(all_peer_names()), test_name);

// y' = y^3 from 1 ends at 1/2. Odeint returns NaN at t = 2 as a success; CVODE and ARKODE stay where they are
// and let y grow to 1e100 until their steps are used up.
TEST_P(EveryPeerFails, AtABlowUp) {
  const auto solution = run(ivp::System(problems::TextProblem("blow-up")), ivp::State{1.0}, 0, 2);
  expect_failure(solution, Outcome::step_underflow);
  // At a distance d of the end y is 1/sqrt(2 d): steps cease to move t near y^2 = 1/(d eps). The tolerance
  // moves the end by some 1e-7.
  EXPECT_NEAR(solution.t, 0.5, 1e-6);
  EXPECT_GT(solution.x[0], 1e5);
}

// x' = -x up to 1/2, no number from there on.
struct NoNumberAfterHalf {
  static constexpr int dimension = 1;
  double value = nan;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    dxdt[0] = value_of(t) > 0.5 ? T(value) : T(-x[0]);
  }
};

// GSL's rkf45, rk8pd and bsimp and all of Odeint accept steps to NaN and return success.
TEST_P(EveryPeerFails, WhereTheRightHandSideIsNoNumber) {
  for (const double value : {nan, infinity, -infinity}) {
    const auto solution = run(ivp::System(NoNumberAfterHalf{value}), ivp::State{1.0}, 0, 1);
    expect_failure(solution, Outcome::non_finite);
    EXPECT_LE(solution.t, 0.5);
    EXPECT_GT(solution.t, 0.4);
    EXPECT_NEAR(solution.x[0], std::exp(-solution.t), 100e-9);
  }
}

TEST_P(EveryPeerFails, WhereTheRightHandSideBeginsWithoutANumber) {
  const auto solution = run(ivp::System(NoNumberAfterHalf{}), ivp::State{1.0}, 0.75, 1);
  expect_failure(solution, Outcome::non_finite);
  EXPECT_EQ(solution.t, 0.75);
  EXPECT_EQ(solution.x[0], 1);
}

// x' = 1, with a gap of 2e-9 around 0.3 without a number, which steps pass over.
struct NoNumberAtOnePlace {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& /*x*/, Vector<T, 1>& dxdt) const {
    dxdt[0] = T(std::abs(value_of(t) - 0.3) < 1e-9 ? nan : 1.0);
  }
};

// Dense output by shorter steps does not get there: the run fails, and hands out no state in place of it.
TEST_P(EveryPeerFails, WhereDenseOutputHasNoState) {
  double found = nan;
  const auto look = [&](const ivp::Step& step) {
    if (step.t0 < 0.3 && 0.3 < step.t1) found = step.at(0.3)[0];
    return true;
  };
  const auto solution = run(ivp::System(NoNumberAtOnePlace{}), ivp::State{0.0}, 0, 1, 1e-9, look);
  if (solution.status.ok()) {
    EXPECT_NEAR(found, 0.3, 1e-8);
  } else {
    expect_failure(solution, Outcome::not_converged);
    EXPECT_GT(solution.t, 0.3);
  }
  const bool by_steps = GetParam().starts_with("gsl") || GetParam() == "odeint-fehlberg78" ||
                        GetParam() == "odeint-bulirsch-stoer";
  EXPECT_EQ(solution.status.ok(), !by_steps) << solution.status.text();
}

// A right-hand side that is finite, and its Jacobian that is not.
struct NoJacobian {
  static constexpr int dimension = 1;
  void operator()(double /*t*/, const Vector<double, 1>& x, Vector<double, 1>& dxdt) const {
    dxdt[0] = -x[0];
  }
  void jacobian(double /*t*/, const Vector<double, 1>& /*x*/, Matrix<double, 1>& j) const { j(0, 0) = nan; }
};

TEST_P(EveryPeerFails, WithoutAJacobianIfImplicit) {
  const auto solution = run(ivp::System(NoJacobian{}), ivp::State{1.0}, 0, 1);
  if (peer_info(GetParam()).family == ivp::Family::implicit) {
    EXPECT_FALSE(solution.status.ok());
    EXPECT_TRUE(solution.x.allFinite());
  } else {
    EXPECT_TRUE(solution.status.ok()) << solution.status.text();
  }
}

TEST_P(EveryPeerFails, WhenItsStepsAreUsedUp) {
  const auto solution =
      run(ivp::System(problems::TextProblem("duffing")), {1, 0}, 0, 1000, 1e-9, {}, {.steps = 25});
  expect_failure(solution, Outcome::step_limit);
  EXPECT_GT(solution.t, 0);
  EXPECT_LT(solution.t, 1000);
  // Libraries that repeat a rejected step themselves may pass the limit within one.
  EXPECT_GE(solution.statistics.steps + solution.statistics.rejected, 25);
  EXPECT_LE(solution.statistics.steps, 25);
}

struct Slow {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    std::this_thread::sleep_for(std::chrono::microseconds(20));
    dxdt[0] = -x[0];
  }
};

TEST_P(EveryPeerFails, WhenItsTimeIsUsedUp) {
  const auto solution = run(ivp::System(Slow{}), ivp::State{1.0}, 0, 1e6, 1e-12, {}, {.seconds = 0.005});
  expect_failure(solution, Outcome::time_limit);
  EXPECT_LT(solution.t, 1e6);
}

TEST_P(EveryPeerFails, WhenItsObserverSaysStop) {
  double reached = 0;
  ivp::State state(2);
  const auto third = [&](const ivp::Step& step) {
    reached = step.t1;
    state = step.x1;
    return step.index < 3;
  };
  const auto solution = run(ivp::System(problems::TextProblem("duffing")), {1, 0}, 0, 20, 1e-9, third);
  expect_failure(solution, Outcome::interrupted);
  EXPECT_EQ(solution.statistics.steps, 3);
  EXPECT_EQ(solution.t, reached);
  EXPECT_EQ(solution.x, state);
}

// An exception of the problem's own comes out as it went in, past the C of SUNDIALS and GSL, and frees what
// they had allocated (which the address sanitizer watches).
struct Thrown : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct Throws {
  static constexpr int dimension = 1;
  bool from_jacobian = false;
  void operator()(double t, const Vector<double, 1>& x, Vector<double, 1>& dxdt) const {
    if (!from_jacobian && t > 0.5) throw Thrown("no data beyond 0.5");
    dxdt[0] = -x[0];
  }
  void jacobian(double /*t*/, const Vector<double, 1>& /*x*/, Matrix<double, 1>& j) const {
    if (from_jacobian) throw Thrown("no Jacobian");
    j(0, 0) = -1;
  }
};

TEST_P(EveryPeerFails, WithTheProblemsOwnException) {
  EXPECT_THROW((void)run(ivp::System(Throws{}), ivp::State{1.0}, 0, 1), Thrown);
  EXPECT_THROW((void)run(ivp::System(Throws{}), ivp::State{1.0}, 0.75, 1), Thrown);
  if (peer_info(GetParam()).family == ivp::Family::implicit) {
    EXPECT_THROW((void)run(ivp::System(Throws{true}), ivp::State{1.0}, 0, 1), Thrown);
  }
  EXPECT_TRUE(run(ivp::System(Throws{}), ivp::State{1.0}, 0, 0.5).status.ok());
}

TEST_P(EveryPeerFails, WithTheObserversException) {
  const auto refuse = [](const ivp::Step&) -> bool { throw Thrown("seen enough"); };
  EXPECT_THROW((void)run(ivp::System(Decay{}), ivp::State{1.0}, 0, 1, 1e-9, refuse), Thrown);
}

TEST_P(EveryPeerFails, BeforeItBeginsWithABadState) {
  const auto solution = run(ivp::System(problems::TextProblem("duffing")), {1, nan}, 0, 1);
  EXPECT_EQ(solution.status.outcome(), Outcome::non_finite);
  EXPECT_EQ(solution.statistics.right_hand_sides, 0);
}

// The two ends are neighbouring doubles, or as far apart as doubles go: an answer either way, and no more.
TEST_P(EveryPeerFails, OrNotOnTheShortestWay) {
  for (const double t1 : {std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0), 1 + 1e-12}) {
    const auto solution = run(ivp::System(Decay{}), ivp::State{1.0}, 1, t1);
    if (solution.status.ok()) {
      EXPECT_EQ(solution.t, t1);
    } else {
      expect_failure(solution, Outcome::step_underflow);
    }
    EXPECT_NEAR(solution.x[0], 1, 2e-12);
  }
}

// At t = 1e16 doubles are two apart: every step of x'' + x = 0 is rounded. Left alone, CVODE, ARKODE, rk8pd
// and bsimp arrive at t1 in another state.
TEST_P(EveryPeerFails, WhereTimeHasNoRoomForAStep) {
  const auto solution =
      run(ivp::System(problems::TextProblem("duffing", {{"hardening", 0}})), {1, 0}, 1e16, 1e16 + 64);
  expect_failure(solution, Outcome::step_underflow);
}

TEST_P(EveryPeerFails, OrNotWithATolerancePastDoublePrecision) {
  const auto solution = run(ivp::System(problems::TextProblem("duffing")), {1, 0}, 0, 0.5, 1e-18, {},
                            {.steps = 20000, .seconds = 2});
  const Outcome outcome = solution.status.outcome();
  EXPECT_TRUE(outcome == Outcome::success || outcome == Outcome::step_underflow ||
              outcome == Outcome::step_limit || outcome == Outcome::newton_diverged ||
              outcome == Outcome::time_limit)
      << solution.status.text();
  EXPECT_TRUE(solution.x.allFinite());
}

}  // namespace
}  // namespace nlmech::peers::failures_test
