/// `homotopy frame --dynamic`: motions in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/chapters/homotopy/own_frame.hpp"

namespace nlmech::own_work_motion_test {
namespace {

using namespace own_frame;

TEST(OwnMotion, EnergiesOfAMotionBalance) {
  const Finished f = frame(shipped("toggle"), {"--dynamic", "--factor", "30", "--time", "0.2"});
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const Rows rows = scene::parse_csv(f.output, "output");
  const std::size_t kinetic = column(rows, "kinetic_energy"), strain = column(rows, "strain_energy"),
                    work = column(rows, "work");
  double greatest = 0, worst = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double done = number(rows[i].cells[work]);
    greatest = std::max(greatest, std::abs(done));
    worst = std::max(worst, std::abs(number(rows[i].cells[kinetic]) + number(rows[i].cells[strain]) - done));
  }
  // Beyond a hundredth the command itself says failure.
  // period.
  EXPECT_GT(greatest, 1);
  EXPECT_LE(worst, 1e-2 * greatest);
  // Steps far too long for it: no success.
  const Finished blown =
      frame(shipped("toggle"), {"--dynamic", "--time", "0.2", "--method", "explicit", "--step", "0.1"});
  EXPECT_EQ(blown.exit_code, 1);
  EXPECT_NE(blown.errors.find("of the greatest energy"), std::string::npos) << blown.errors;
}

// Rows at the times asked for, of steps that are given and of chosen ones.
TEST(OwnMotion, RowsOfAMotionAreAtTheTimesAskedFor) {
  std::vector<double> ends;
  for (const std::vector<std::string>& method : {std::vector<std::string>{"--method", "newmark"},
                                                 {"--method", "explicit"},
                                                 {"--method", "dop853", "--tolerance", "1e-9"}}) {
    std::vector<std::string> words = {"--dynamic", "--factor", "30", "--time", "0.18", "--every", "0.05"};
    words.insert(words.end(), method.begin(), method.end());
    const Rows rows = path_of(shipped("toggle"), words);
    ASSERT_EQ(rows.size(), 6U);
    const std::array<double, 5> times = {0, 0.05, 0.1, 0.15, 0.18};
    for (const std::size_t i : {0U, 1U, 2U, 3U, 4U}) EXPECT_EQ(number(rows[i + 1].cells[0]), times[i]);
    ends.push_back(number(rows[4].cells[column(rows, "B.y")]));
  }
  // Of the largest displacement, 0.215, a hundredth is what a fixed step may be off by.
  EXPECT_NEAR(ends[0], ends[2], 2e-3);
  EXPECT_NEAR(ends[1], ends[2], 2e-3);
}

// A mass on a bar that is hinged at the origin: a mechanism, which falls. x'' = -s x, y'' = -g - s y with the
// tension s = EA/l (r/l - 1)/(m r), by Runge and Kutta's steps of 1e-4.
TEST(OwnMotion, APendulumFallsInTime) {
  const std::string pendulum = R"([nodes]
A = [0, 0]
B = [1, 0]
[[members]]
nodes = ["A", "B"]
EA = 1000
EI = 1
mass = 1e-9
hinges = ["A"]
[supports]
A = ["x", "y"]
[masses]
B = { mass = 1 }
[loads]
B = { y = -9.81 }
)";
  using Four = std::array<double, 4>;
  const auto slope = [](const Four& z) {
    const double r = std::hypot(z[0], z[1]), s = 1000 * (r - 1) / r;
    return Four{z[2], z[3], -s * z[0], -9.81 - s * z[1]};
  };
  const auto moved = [](Four z, const Four& by, double h) {
    for (std::size_t i = 0; i < 4; ++i) z[i] += h * by[i];
    return z;
  };
  Four z = {1, 0, 0, 0};
  constexpr double h = 1e-4;
  for (int i = 0; i < 10'000; ++i) {
    const Four a = slope(z), b = slope(moved(z, a, h / 2)), c = slope(moved(z, b, h / 2)),
               d = slope(moved(z, c, h));
    z = moved(moved(moved(moved(z, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
  }
  const Rows rows = path_of(written(pendulum), {"--elements", "1", "--dynamic", "--time", "1", "--every", "1",
                                                "--method", "dop853", "--tolerance", "1e-10"});
  EXPECT_NEAR(number(rows.back().cells[column(rows, "B.x")]), z[0] - 1, 1e-6);
  EXPECT_NEAR(number(rows.back().cells[column(rows, "B.y")]), z[1], 1e-6);
  // Under growing loads it is refused as before.
  EXPECT_NE(frame(written(pendulum)).errors.find("mechanism"), std::string::npos);
}

// A rod of stiffness k = EA/l with a mass m at its end, under a sudden load P: P/k (1 - cos(w t)) with w^2 =
// k/m, here 1, as long as strains are small.
TEST(OwnMotion, AStepIsHeldToHalfOfIt) {
  const std::string rod = R"([nodes]
A = [0, 0]
B = [0, 1]
[[members]]
nodes = ["A", "B"]
elements = 1
EA = 1e6
EI = 1
mass = 1e-9
[supports]
A = ["x", "y", "rotation"]
B = ["x", "rotation"]
[masses]
B = { mass = 1e6 }
[loads]
B = { y = -1 }
)";
  const auto end_of = [](const Finished& f) {
    const Rows rows = scene::parse_csv(f.output, "output");
    return number(rows.back().cells[column(rows, "B.y")]);
  };
  const std::vector<std::string> words = {"--dynamic", "--time", "100", "--elements", "1", "--every", "1"};
  const auto with_step = [&](const std::string& step) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--step", step});
    return frame(written(rod), all);
  };
  const double exact = -1e-6 * (1 - std::cos(100.));
  const Finished chosen = frame(written(rod), words);
  EXPECT_EQ(chosen.exit_code, 0) << chosen.errors;
  EXPECT_NEAR(end_of(chosen), exact, 2e-8);
  // A period of 2 pi in 12 steps: the phase lags by (w h)^2/12 a radian, 2 rad in all.
  const Finished coarse = with_step("0.5");
  EXPECT_EQ(coarse.exit_code, 1) << end_of(coarse);
  for (const char* word : {"newmark", "half the step of 0.5", "--step", "dop853"})
    EXPECT_NE(coarse.errors.find(word), std::string::npos) << coarse.errors;
}

}  // namespace
}  // namespace nlmech::own_work_motion_test
