/// The Taylor series method: failures, refusals.
#include <gtest/gtest.h>

#include "nlmech/ivp/series/series.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::series_edges_test {
namespace {

using testing::infinity;
using testing::nan;

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
