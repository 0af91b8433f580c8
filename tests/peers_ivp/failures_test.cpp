// Silent failures of libraries that are reported as a status here; each test failed without the corresponding
// check. Requirements on all methods: tests/ivp/every_integrator_test.cpp.
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/integrators.hpp"

namespace nlmech::peers::failures_test {
namespace {

using ivp::State, ivp::System;
using ivp::testing::Integrator;
class EveryPeer : public ivp::testing::EveryIntegrator {};
INSTANTIATE_TEST_SUITE_P(All, EveryPeer,
                         ::testing::ValuesIn(ivp::testing::integrators_that([](const Integrator& i) {
                           return i.row->is_peer();
                         })),
                         ivp::testing::label_of);

// x' = 1, with NaN in an interval of 2e-9 around 0.3, which steps pass over.
struct NoNumberAtOnePlace {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& /*x*/, Vector<T, 1>& dxdt) const {
    dxdt[0] = T(std::abs(value_of(t) - 0.3) < 1e-9 ? ivp::testing::nan : 1.0);
  }
};

// Dense output by shorter steps fails: the integration fails and returns no state there.
TEST_P(EveryPeer, FailsWhereDenseOutputHasNoState) {
  double found = 0;
  const auto look = [&](const ivp::Step& step) {
    if (step.t0 < 0.3 && 0.3 < step.t1) found = step.at(0.3)[0];
    return true;
  };
  const auto solution = run(System(NoNumberAtOnePlace{}), State{0.0}, 0, 1, look);
  if (solution.status.ok()) {
    EXPECT_NEAR(found, 0.3, 1e-8);
  } else {
    expect_failure(solution, Outcome::not_converged);
    EXPECT_GT(solution.t, 0.3);
  }
  const bool by_steps = row().name.starts_with("gsl") || row().name == "odeint-fehlberg78" ||
                        row().name == "odeint-bulirsch-stoer";
  EXPECT_EQ(solution.status.ok(), !by_steps) << solution.status.text();
}

// A finite right-hand side with a Jacobian that is not finite.
struct NoJacobian {
  static constexpr int dimension = 1;
  void operator()(double /*t*/, const Vector<double, 1>& x, Vector<double, 1>& dxdt) const {
    dxdt[0] = -x[0];
  }
  void jacobian(double /*t*/, const Vector<double, 1>& /*x*/, Matrix<double, 1>& j) const {
    j(0, 0) = ivp::testing::nan;
  }
};

TEST_P(EveryPeer, FailsWithoutAJacobianIfImplicit) {
  const auto solution = run(System(NoJacobian{}), State{1.0}, 0, 1);
  EXPECT_EQ(solution.status.ok(), row().family != ivp::Family::implicit) << solution.status.text();
  EXPECT_TRUE(solution.x.allFinite());
}

TEST_P(EveryPeer, TakesAToleranceBelowDoublePrecision) {
  const auto solution = with(1e-18)(System(problems::TextProblem("duffing")), {1, 0}, 0, 0.5, {},
                                    {.steps = 20000, .seconds = 2});
  const Outcome outcome = solution.status.outcome();
  EXPECT_TRUE(outcome == Outcome::success || outcome == Outcome::step_underflow ||
              outcome == Outcome::step_limit || outcome == Outcome::newton_diverged ||
              outcome == Outcome::time_limit)
      << solution.status.text();
  EXPECT_TRUE(solution.x.allFinite());
}

// Declared bounds are checked for peers as well: with a tolerance far above y2 the multistep codes let y2
// become negative, and the solution then grows without bound.
TEST(Peers, RobertsonDoesNotRunAway) {
  const problems::TextProblem robertson("robertson");
  int refused = 0;
  for (const char* name : {"cvode-bdf", "gsl-msbdf", "arkode-dirk", "odeint-rosenbrock4"}) {
    if (!peer_info(name).is_available()) continue;
    for (const double tolerance : {1e-4, 1e-6}) {
      const auto s = peer_integrator(name, tolerance)(System(robertson), robertson.initial_state(), 0, 1e11,
                                                      {}, {.steps = 20'000});
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
}  // namespace nlmech::peers::failures_test
