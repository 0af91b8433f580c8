/// The toggle: limit points, half and full model, any number of elements.
#include "nlmech/frames/toggle.hpp"

#include <gtest/gtest.h>

#include <string>

#include "nlmech/frames/williams.hpp"
#include "tests/frames/control.hpp"
#include "tests/frames/oracle.hpp"

namespace nlmech::frames::toggle_test {
namespace {

using Eigen::VectorXd;

PathPoint at_rest(const ToggleFrame& t) { return {VectorXd::Zero(t.frame.size()), 0, 1}; }

/// The load path by drops, in steps short enough for Newton.
PathPoint dropped(const ToggleFrame& t, double drop) {
  PathPoint at = at_rest(t);
  for (int i = 1; i <= 20; ++i) at = control(t.frame, t.load, t.apex, -drop * i / 20, at);
  return at;
}

/// Limit point between two drops.
PathPoint limit(const Toggle& toggle, double low, double high) {
  const ToggleFrame t = make_frame(toggle);
  return limit_point(t.frame, t.load, t.apex, dropped(t, low), -high);
}

// oracle: homotopy_frames toggle 0.?? of 1 maximum*, toggle 0.?? of 1 minimum*
TEST(Toggle, LimitPointsOfOneElement) {
  const auto expect = [](double height, double low, double high, double delta, double load) {
    const ToggleFrame t = make_frame({.height = height});
    const PathPoint at = limit({.height = height}, low, high);
    EXPECT_NEAR(-at.x[t.apex], delta, 1e-10);
    EXPECT_NEAR(at.load, load, 1e-10);
  };
  expect(0.44, 0.1, 0.4, 0.22710546333003, 42.435492120383);
  expect(0.44, 0.4, 0.6, 0.4800337802312, 32.124218754757);
  expect(0.38, 0.1, 0.3, 0.23387819214942, 33.122797603353);
  expect(0.38, 0.3, 0.5, 0.38040896031666, 31.107808393235);
}

TEST(Toggle, TheFullModelIsTheHalfOne) {
  for (const int elements : {1, 3}) {
    const ToggleFrame half = make_frame({.height = 0.44, .elements = elements});
    const ToggleFrame full = make_frame({.height = 0.44, .elements = elements, .full = true});
    const PathPoint a = dropped(half, 0.5), b = dropped(full, 0.5);
    EXPECT_NEAR(a.load, b.load, 1e-9);
    EXPECT_NEAR(b.x[full.frame.unknown(elements, Motion::rotation)], 0, 1e-12);
    EXPECT_EQ(full.load.sum(), 2 * half.load.sum());
  }
}

TEST(Toggle, PublishedLoadsLieBeyondTheLimit) {
  // 1e-9: half a unit of the reference's last digit times the stiffness, with room for the residual's floor.
  const ToggleFrame t = make_frame({.height = 0.44}), low = make_frame({});
  EXPECT_NEAR(dropped(t, 0.621922545486).load, 43.79, 1e-9);
  EXPECT_NEAR(dropped(t, 0.623070489).load, 44, 1e-7);
  EXPECT_NEAR(dropped(low, 0.265167973289).load, 27.11, 1e-9);
}

// Near rest the toggle of one element and Williams' equation agree to first order, up to cos(beta) = 1.
TEST(Toggle, AtRestItIsWilliams) {
  const double height = 0.44, square = std::pow(height / 12.94, 2);
  const ToggleFrame t = make_frame({.height = height});
  EXPECT_NEAR(
      control(t.frame, t.load, t.apex, -1e-7, at_rest(t)).slope / -Williams{.height = height}.stiffness(1e-7),
      1, 2 * square);
}

// A member of one element, with EA a thousand times that of Table 2.1, is past its clamped buckling load: the
// frame says so, and gives the load of the straight branch (79.286, and 81.1062 where a
// solver stops at the pole). oracle: homotopy_williams element 0.44 with 1000 EA*
TEST(Toggle, TheStraightBranchIsReported) {
  const ToggleFrame t = make_frame({.height = 0.44, .ea = 1.885e9});
  VectorXd x(1), f(1);
  x << -0.2;
  const Status status = t.frame.force<double>(x, f);
  EXPECT_EQ(status.outcome(), Outcome::wrong_branch);
  EXPECT_NE(status.sentence().find("clamped buckling load"), std::string::npos);
  EXPECT_NEAR(-2 * f[0], 79.286, 5e-4);
}

TEST(Toggle, RefusesWhatItCannotBuild) {
  EXPECT_THROW(static_cast<void>(make_frame({.height = 0})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(make_frame({.height = 13})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(make_frame({.elements = 0})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(make_frame({.ea = -1})), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::frames::toggle_test
