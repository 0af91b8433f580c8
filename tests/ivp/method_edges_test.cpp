// What all methods owe their caller at the edges: ends, limits, observers, bad numbers, bad options.
#include <gtest/gtest.h>

#include <array>

#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::method_edges_test {
namespace {

using namespace testing;

// Those of for_each_method(), and collocation.
template <class Do>
void for_all_methods(Do&& action) {
  for_each_method(action);
  action(Mcpi{.step = 0.01});
  action(PolynomialCollocation{.step = 0.01, .nodes = 5});
  action(
      PolynomialCollocation{.step = 0.01, .nodes = 5, .points = collocation::NodeFamily::left_end_and_radau});
  action(RbfCollocation{.step = 0.01});
}

// The name of a method in sentences; collocation has a name_of() of its own.
template <class Method>
std::string name_of(const Method& method) {
  return std::string(method_name(method));
}

TEST(EveryMethod, StandsStillForAnEmptyInterval) {
  for_all_methods([](const auto& method) {
    const auto solution = integrate(System(Oscillator{}), State{1, 2}, 3, 3, method);
    EXPECT_TRUE(solution.status.ok());
    EXPECT_EQ(solution.t, 3);
    EXPECT_EQ(solution.x, (State{1, 2}));
    EXPECT_EQ(solution.statistics.steps, 0);
    EXPECT_EQ(solution.statistics.right_hand_sides, 0);
  });
}

// Backwards a method solves the same equation: the error stays that of forwards, up to the constant.
TEST(EveryMethod, RunsBackwards) {
  for_each_method([](const auto& method) {
    const double forwards = largest_error(Manufactured{}, with_step(method, 0.01), 0, 2, true);
    const double backwards = largest_error(Manufactured{}, with_step(method, 0.01), 2, 0, true);
    EXPECT_LT(backwards, 10 * forwards) << method.name;
    EXPECT_GT(backwards, 0.1 * forwards) << method.name;
  });
}

// Ten steps of 0.1 make exactly 1, in either direction, and 0.3 leaves a last step of 0.1.
TEST(FixedSteps, LandOnTheEnd) {
  for_each_method([](const auto& method) {
    if constexpr (requires { method.step; }) {
      for (const double end : {1.0, -1.0}) {
        const auto even = integrate(System(Oscillator{}), State{1, 0}, 0, end, with_step(method, 0.1));
        EXPECT_EQ(even.statistics.steps, 10) << method.name;
        EXPECT_EQ(even.t, end);
        double last = 0;
        const auto note = [&](const Step& step) {
          last = step.t1 - step.t0;
          return true;
        };
        const auto odd = integrate(System(Oscillator{}), State{1, 0}, 0, end, with_step(method, 0.3), note);
        EXPECT_EQ(odd.statistics.steps, 4) << method.name;
        EXPECT_EQ(odd.t, end);
        EXPECT_NEAR(last, end * 0.1, 4 * eps);
      }
    }
  });
}

// The spacing of doubles at 1e16 is 2.
TEST(FixedSteps, NoticeAStepThatDoesNotMoveTime) {
  for_all_methods([](const auto& method) {
    if constexpr (requires { method.step; }) {
      for (const auto& [step, begin, end] : {std::array{1e-20, 1.0, 2.0}, {0.5, 1e16, 1e16 + 64}}) {
        const auto s = integrate(System(Oscillator{}), State{1, 0}, begin, end, with_step(method, step));
        EXPECT_EQ(s.status.outcome(), Outcome::step_underflow) << s.status.text();
        EXPECT_EQ(s.t, begin);
        EXPECT_NE(s.status.sentence().find(name_of(method)), std::string::npos);
        if (begin > 1) {
          EXPECT_NE(s.status.sentence().find("t = 10000000000000000"), std::string::npos);
        }
      }
    }
  });
}

TEST(EveryMethod, KeepsToItsLimits) {
  for_all_methods([](const auto& method) {
    const auto used_up = integrate(System(Oscillator{}), State{1, 0}, 0, 100, method, {}, {.steps = 7});
    EXPECT_EQ(used_up.status.outcome(), Outcome::step_limit) << method.name;
    EXPECT_EQ(used_up.statistics.steps + used_up.statistics.rejected, 7) << method.name;
    if constexpr (requires { method.step; }) {
      EXPECT_NEAR(used_up.t, 7 * method.step, 1e-15);
    }
    EXPECT_LT(used_up.t, 100);
    EXPECT_NE(used_up.status.sentence().find(name_of(method)), std::string::npos);
    const auto late = integrate(System(Oscillator{}), State{1, 0}, 0, 100, method, {}, {.seconds = 0});
    EXPECT_EQ(late.status.outcome(), Outcome::time_limit) << method.name;
  });
}

TEST(EveryMethod, ObeysItsObserver) {
  for_each_method([](const auto& method) {
    State seen(2);
    double time = 0;
    const auto stop = [&](const Step& step) {
      seen = step.x1;
      EXPECT_EQ(step.t0, time);
      time = step.t1;
      EXPECT_EQ(step.times.back(), step.t1);
      return step.index < 3;
    };
    const auto solution = integrate(System(Oscillator{}), State{1, 0}, 0, 100, method, stop);
    EXPECT_EQ(solution.status.outcome(), Outcome::interrupted) << method.name;
    EXPECT_EQ(solution.statistics.steps, 3);
    EXPECT_EQ(solution.t, time);
    EXPECT_EQ(solution.x, seen);
    EXPECT_NE(solution.status.sentence().find(method.name), std::string::npos);
  });
}

// Dense output joins the ends of every step.
TEST(EveryMethod, DenseOutputMeetsTheEndsOfSteps) {
  for_each_method([](const auto& method) {
    State x(2);
    const auto compare = [&](const Step& step) {
      step.dense.at(step.t0, x);
      EXPECT_LT((x - step.x0).cwiseAbs().maxCoeff(), 8 * eps) << method.name;
      step.dense.at(step.t1, x);
      EXPECT_LT((x - step.x1).cwiseAbs().maxCoeff(), 8 * eps) << method.name;
      return true;
    };
    EXPECT_TRUE(integrate(System(Manufactured{}), State{1, 0}, 0, 1, method, compare).status.ok());
  });
}

// NaN and infinity, from the start and on the way: a failure with a sentence, the last good state, no NaN.
TEST(EveryMethod, SeesRightHandSidesThatAreNotFinite) {
  for (const double value : {nan, infinity, -infinity}) {
    for (const double at : {-1.0, 0.5}) {
      const System system(Poisoned{at, value});
      for_all_methods([&](const auto& method) {
        const auto solution = integrate(system, State{1, 0}, 0, 2, method);
        EXPECT_EQ(solution.status.outcome(), Outcome::non_finite) << method.name << solution.status.text();
        EXPECT_TRUE(solution.x.allFinite()) << method.name;
        EXPECT_LE(solution.t, std::max(at + 0.01, 0.0)) << method.name;
        EXPECT_NEAR(solution.x[0], std::cos(solution.t), 0.01) << method.name;
        EXPECT_GE(solution.t, at - 0.01) << method.name;
        EXPECT_NE(solution.status.sentence().find(name_of(method)), std::string::npos);
        EXPECT_NE(solution.status.sentence().find("t = "), std::string::npos);
      });
    }
  }
}

TEST(EveryMethod, RefusesAnInitialStateThatIsNotFinite) {
  for_each_method([](const auto& method) {
    for (const double value : {nan, -infinity}) {
      const auto solution = integrate(System(Oscillator{}), State{1, value}, 0, 2, method);
      EXPECT_EQ(solution.status.outcome(), Outcome::non_finite) << method.name;
      EXPECT_NE(solution.status.sentence().find("component 2"), std::string::npos);
    }
  });
}

// q'' = 6 q^5/(...) is not needed: q'' = 2 q^3 with q = 1/(1 - t) ends at t = 1. Explicit methods overflow
// behind it, implicit ones lose their root before.
struct EndsAtOne {
  static constexpr int dimension = 2;
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 1>& q, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    a[0] = 2 * (q[0] * q[0] * q[0]);
  }
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

TEST(EveryMethod, DoesNotCrossABlowUp) {
  for_each_method([](const auto& method) {
    const auto solution = integrate(System(EndsAtOne{}), State{1, 1}, 0, 2, method);
    EXPECT_FALSE(solution.status.ok()) << method.name;
    EXPECT_TRUE(solution.x.allFinite()) << method.name;
    EXPECT_GT(solution.t, 0.9) << method.name;
    EXPECT_LT(solution.t, 1.2) << method.name;
    EXPECT_NE(solution.status.sentence().find(method.name), std::string::npos);
  });
}

TEST(EveryMethod, SaysWhichOptionIsWrong) {
  for_each_method([](auto method) {
    if constexpr (requires { method.step; }) {
      for (const double step : {0.0, -0.1, nan, infinity}) {
        const std::string text = refusal(with_step(method, step));
        EXPECT_NE(text.find(std::string(method.name) + ": the step must be positive"), std::string::npos)
            << text;
      }
    }
  });
  EXPECT_EQ(refusal(Newmark{.beta = 0.6}), "newmark: beta must be between 0 and 0.5, not 0.6");
  EXPECT_EQ(refusal(Newmark{.gamma = -0.1}), "newmark: gamma must be between 0 and 1, not -0.1");
  EXPECT_EQ(refusal(Hht{.alpha = 0.1}), "hht: alpha must be between -0.333333 and 0, not 0.1");
  EXPECT_NE(refusal(Hht{.alpha = -0.4}).find("-0.4"), std::string::npos);
  EXPECT_EQ(refusal(GeneralizedAlpha{.rho_inf = 1.1}),
            "generalized-alpha: rho_inf must be between 0 and 1, not 1.1");
  EXPECT_NE(refusal(GeneralizedAlpha{.rho_inf = nan}).find("nan"), std::string::npos);
}

// x' = (x2, -x1) without accelerations.
struct Rotation {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = -x[0];
  }
};

TEST(StructuralMethods, NeedAccelerations) {
  for_each_method([](const auto& method) {
    using Method = std::decay_t<decltype(method)>;
    if constexpr (std::is_same_v<Method, BackwardEuler> || std::is_same_v<Method, Rk4> ||
                  std::is_same_v<Method, Ode45> || std::is_same_v<Method, Dop853>) {
      EXPECT_TRUE(integrate(System(Rotation{}), State{1, 0}, 0, 1, method).status.ok());
    } else {
      try {
        (void)integrate(System(Rotation{}), State{1, 0}, 0, 1, method);
        ADD_FAILURE() << method.name << " accepted a problem without accelerations";
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("acceleration"), std::string::npos) << error.what();
      }
    }
  });
}

}  // namespace
}  // namespace nlmech::ivp::method_edges_test
