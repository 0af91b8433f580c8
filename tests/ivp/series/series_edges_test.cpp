/// The Taylor series method: directions, limits, refusals.
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::series_edges_test {
namespace {

using testing::eps;
using testing::infinity;
using testing::Manufactured;
using testing::nan;

// A free oscillator keeps errors as they are; back and forth is twice the way.
TEST(SeriesEdges, GoesBackwards) {
  const Manufactured problem;
  const auto there = integrate(System(problem), problem.exact(3), 3, -4, Series{.relative_tolerance = 1e-12});
  EXPECT_TRUE(there.status.ok());
  EXPECT_EQ(there.t, -4);
  EXPECT_LT((there.x - problem.exact(-4)).cwiseAbs().maxCoeff(), 1e-8);  // damping backwards enlarges by e^2
  const auto fixed = integrate(System(problem), problem.exact(3), 3, -4, Series{.order = 16, .step = 0.25});
  EXPECT_EQ(fixed.t, -4);
  EXPECT_LT((fixed.x - problem.exact(-4)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SeriesEdges, IntervalsWithoutLengthAndTheShortestOne) {
  const System system(testing::Oscillator{});
  EXPECT_EQ(integrate(system, State{1, 2}, 5, 5, Series{}).x, (State{1, 2}));
  const double end = std::nextafter(1.0, 2.0);
  const auto s = integrate(system, State{1, 0}, 1, end, Series{});
  EXPECT_TRUE(s.status.ok()) << s.status.text();
  EXPECT_EQ(s.t, end);
}

// Steps follow each other without gap, dense output is the state at both ends.
TEST(SeriesEdges, ObserverSeesEveryStep) {
  const Manufactured problem;
  double t = 0;
  std::int64_t count = 0;
  const auto look = [&](const Step& step) {
    EXPECT_EQ(step.index, ++count);
    EXPECT_EQ(step.t0, t);
    t = step.t1;
    State x(2);
    step.dense.at(step.t0, x);
    EXPECT_EQ(x, step.x0);
    step.dense.at(step.t1, x);
    EXPECT_LT((x - step.x1).cwiseAbs().maxCoeff(), 4 * eps);
    EXPECT_EQ(step.times.back(), step.t1);
    EXPECT_EQ(State(step.states.col(0)), step.x1);
    return step.index < 5;
  };
  const auto s = integrate(System(problem), problem.exact(0), 0, 10, Series{}, look);
  EXPECT_EQ(s.status.outcome(), Outcome::interrupted);
  EXPECT_EQ(s.t, t);
  EXPECT_EQ(count, 5);
}

struct ForDoubleAlone {
  static constexpr int dimension = 1;
  void operator()(double /*t*/, const Vector<double, 1>& x, Vector<double, 1>& f) const { f[0] = -x[0]; }
  void jacobian(double /*t*/, const Vector<double, 1>& /*x*/, Matrix<double, 1, 1>& j) const { j(0, 0) = -1; }
};

TEST(SeriesEdges, RefusesAProblemForDoubleAlone) {
  try {
    static_cast<void>(integrate(System(ForDoubleAlone{}), State{1.0}, 0, 1, Series{}));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("template on the scalar"), std::string::npos);
  }
}

TEST(SeriesEdges, Limits) {
  const System system(Manufactured{});
  const auto few = integrate(system, State{1, 0}, 0, 100, Series{}, {}, {.steps = 3});
  EXPECT_EQ(few.status.outcome(), Outcome::step_limit);
  EXPECT_EQ(few.statistics.steps, 3);
  EXPECT_EQ(integrate(system, State{1, 0}, 0, 1e5, Series{}, {}, {.seconds = 1e-6}).status.outcome(),
            Outcome::time_limit);
  const auto bound = integrate(system, State{1, 0}, 0, 1, Series{.largest_step = 0.0625});
  EXPECT_EQ(bound.statistics.steps, 16);
}

struct RootOfTime {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& /*x*/, Vector<T, 1>& f) const {
    using std::sqrt;
    f[0] = sqrt(t);
  }
};

TEST(SeriesEdges, FailuresSayWhatHappened) {
  // f is finite at t = 0, its derivatives are not.
  const auto singular = integrate(System(RootOfTime{}), State{0.0}, 0, 1, Series{});
  EXPECT_EQ(singular.status.outcome(), Outcome::non_finite);
  EXPECT_NE(singular.status.sentence().find("Taylor coefficients"), std::string::npos);
  EXPECT_EQ(singular.x[0], 0);
  EXPECT_EQ(integrate(System(RootOfTime{}), State{0.0}, 0, 1, Series{.step = 0.1}).status.outcome(),
            Outcome::non_finite);
  const auto nowhere = integrate(System(RootOfTime{}), State{0.0}, -1, 1, Series{});
  EXPECT_EQ(nowhere.status.outcome(), Outcome::non_finite);
  EXPECT_NE(nowhere.status.sentence().find("right-hand side"), std::string::npos);
  EXPECT_EQ(integrate(System(testing::Oscillator{}), State{1, 0}, 1, 2, Series{.largest_step = 1e-20})
                .status.outcome(),
            Outcome::step_underflow);
}

TEST(SeriesEdges, OptionsOutOfRangeAreNamed) {
  using testing::refusal;
  EXPECT_NE(refusal(Series{.order = 1}).find("order must be between 2 and 100, not 1"), std::string::npos);
  EXPECT_NE(refusal(Series{.order = 101}).find("101"), std::string::npos);
  EXPECT_NE(refusal(Series{.relative_tolerance = 0}).find("relative_tolerance"), std::string::npos);
  EXPECT_NE(refusal(Series{.absolute_tolerance = nan}).find("absolute_tolerance"), std::string::npos);
  EXPECT_NE(refusal(Series{.step = -1}).find("step must be"), std::string::npos);
  EXPECT_NE(refusal(Series{.largest_step = infinity}).find("largest_step"), std::string::npos);
  EXPECT_EQ(refusal(Series{.order = 2, .step = 0.01}), "accepted");
  EXPECT_EQ(refusal(Series{.order = 100}), "accepted");
}

TEST(SeriesEdges, OrderFollowsTheTolerance) {
  EXPECT_EQ(series_order(0.1), 10);   // 9 + 0.36 x 2.3, rounded up
  EXPECT_EQ(series_order(1e-9), 17);  // 1 + 0.75 x 20.7, rounded up
  EXPECT_EQ(series_order(1e-18), 33);
}

}  // namespace
}  // namespace nlmech::ivp::series_edges_test
