/// `integrators integrate` and `compare` on equations as a user types them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/chapters/integrators/run.hpp"

namespace nlmech::integrators_commands_test {
namespace {

TEST(TypedEquation, ColumnsHaveItsNames) {
  const Rows rows =
      integrate({"--equation", "x'' = -x; y' = x", "--initial", "x=1, x'=0, y=0", "--until", "2"});
  EXPECT_EQ(rows.header, (Words{"t", "x", "y", "x'"}));
  ASSERT_EQ(rows.values.size(), 2U);
  // The command's own tolerance of 1e-9, over two units of time.
  EXPECT_NEAR(rows.values[1][1], std::cos(2), 4e-9);
  EXPECT_NEAR(rows.values[1][2], std::sin(2), 4e-9);
  EXPECT_NEAR(rows.values[1][3], -std::sin(2), 4e-9);
}

TEST(TypedEquation, SettingsAndInitialValues) {
  const std::string equation = "x' = -a x; a = 3; x(0) = 1";
  EXPECT_NEAR(integrate({"--equation", equation, "--until", "1"}).values[1][1], std::exp(-3), 2e-9);
  EXPECT_NEAR(integrate({"--equation", equation, "--until", "1", "--set", "a=1"}).values[1][1], std::exp(-1),
              2e-9);
  EXPECT_NEAR(integrate({"--equation", equation, "--until", "1", "--initial", "x=2 a"}).values[1][1],
              6 * std::exp(-3), 6e-9);
  EXPECT_NEAR(integrate({"--equation", equation, "--until", "1", "--initial", "2"}).values[1][1],
              2 * std::exp(-3), 2e-9);
}

// sqrt(1 - t) is over at t = 1, and the first trial step at this tolerance leaps across.
TEST(TypedEquation, ThatHasNoSolutionAtTheEndIsNoSuccess) {
  for (const std::string method : {"series", "ode45", "cvode-bdf"}) {
    const Finished f = integrators({"integrate", "--equation", "y' = -1/(2 y)", "--initial", "1", "--until",
                                    "2", "--tolerance", "1e-3", "--method", method});
    EXPECT_EQ(f.exit_code, 1) << method << "\n" << f.output;
    EXPECT_EQ(f.output, "") << method;
  }
}

// Four digits are asked of a step; multistep peers end with two.
TEST(TypedEquation, RunsInEveryMethod) {
  const Finished f =
      integrators({"compare", "--equation", "x'' + x + 0.1 x^3 = 0.2 cos(t)", "--initial", "x=1, x'=0",
                   "--until", "2", "--methods", "all", "--step", "0.001", "--tolerance", "1e-4"});
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  EXPECT_GT(records.size(), 25U);
  for (std::size_t i = 1; i < records.size(); ++i) {
    EXPECT_EQ(records[i].cells.at(2), "success") << records[i].cells.at(0) << ": " << records[i].cells.at(6);
    if (records[i].cells.at(2) != "success") continue;
    EXPECT_GT(std::stod(records[i].cells.at(3)), 1.5) << records[i].cells.at(0);
  }
}

// A ball that falls 20 m: t = sqrt(2 20/9.81), exactly a root of a parabola.
TEST(Events, EndTheRun) {
  const double t = std::sqrt(40 / 9.81);
  for (const std::string method : {"series", "ode45", "rk4", "adaptive-collocation", "cvode-adams"}) {
    Words words = {
        "--equation", "x'' = -9.81; x(0) = 20; x'(0) = 0", "--until", "10", "--event", "x=0 end", "--method",
        method};
    if (method == "rk4") words.insert(words.end(), {"--step", "0.1"});
    const Rows rows = integrate(words);
    ASSERT_EQ(rows.values.size(), 2U) << method;
    EXPECT_EQ(rows.events, (Words{"", "x=0"}));
    EXPECT_NEAR(rows.values[1][0], t, 1e-8 * t) << method;
    EXPECT_NEAR(rows.values[1][1], 0, 2e-7) << method;
    EXPECT_NEAR(rows.values[1][2], -9.81 * t, 1e-7) << method;
  }
}

TEST(Events, AreRowsInOrder) {
  const Rows rows = integrate({"--equation", "x'' = -x", "--initial", "x=0, x'=1", "--until", "7", "--every",
                               "2", "--event", "x=0 falling", "x'=0"});
  EXPECT_EQ(rows.header.back(), "event");
  std::vector<double> times;
  for (const auto& row : rows.values) times.push_back(row[0]);
  const double pi = std::numbers::pi;
  const std::vector<double> expected = {0, pi / 2, 2, pi, 4, 3 * pi / 2, 6, 7};
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 4e-9);
  EXPECT_EQ(rows.events, (Words{"", "x'=0", "", "x=0", "", "x'=0", "", ""}));
}

// tan has poles between its zeros, and atan2 jumps from pi to -pi.
TEST(Events, PolesAndJumpsAreNone) {
  const double pi = std::numbers::pi;
  const Words swing = {"--equation", "x'' = -x", "--initial", "x=1, x'=0", "--until", "10", "--event"};
  const auto times = [&](const std::string& event) {
    Words words = swing;
    words.push_back(event);
    std::vector<double> found;
    const Rows rows = integrate(words);
    for (std::size_t i = 0; i < rows.values.size(); ++i)
      if (rows.events[i] == event) found.push_back(rows.values[i][0]);
    return found;
  };
  const std::vector<double> zeros = times("tan(t)=0");
  ASSERT_EQ(zeros.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(zeros[i], pi * static_cast<double>(i + 1), 1e-12);
  EXPECT_TRUE(times("1/x=0").empty());
  // x = cos t, x' = -sin t, and their angle pi/2 + t is 1 at 3 pi/2 + 1. A comma in the text of an event.
  const std::vector<double> angle = times("atan2(x,x')=1");
  ASSERT_EQ(angle.size(), 1U);
  EXPECT_NEAR(angle[0], 3 * pi / 2 + 1, 1e-8);
}

TEST(Section, HasItsRowsAlone) {
  const Rows rows = integrate({"--equation", "x'' = -x", "--initial", "x=0, x'=1", "--until", "20",
                               "--section", "x=0 rising", "--tolerance", "1e-13"});
  ASSERT_EQ(rows.values.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(rows.values[i][0], 2 * std::numbers::pi * static_cast<double>(i + 1), 1e-12);
}

// x'' + x + mu sign(x' - V) = 0 without damping: it sticks at x' = V until x = mu, then swings freely about
// -(-mu).
TEST(Switching, StickAndSlipIsExact) {
  const double mu = 0.6, v = 0.5;
  const Words words = {"--equation",
                       "x'' + x + mu sign(x' - V) = 0; mu = 0.6; V = 0.5; x(0) = 0; x'(0) = 0.5",
                       "--tolerance", "1e-12", "--until"};
  const double slip = mu / v;
  for (const std::string method : {"series", "ode45", "adaptive-collocation", "cvode-bdf"}) {
    Words before = words, after = words;
    before.insert(before.end(), {"1", "--method", method});
    after.insert(after.end(), {"3", "--method", method});
    const Rows sticks = integrate(before);
    ASSERT_EQ(sticks.values.size(), 2U) << method;
    EXPECT_NEAR(sticks.values[1][1], v, 1e-11) << method;
    EXPECT_NEAR(sticks.values[1][2], v, 1e-11) << method;
    // Slips: x'' = -x + mu from x = mu, x' = V. Then x = mu + V sin(t - slip).
    const Rows slips = integrate(after);
    ASSERT_EQ(slips.values.size(), 2U) << method;
    EXPECT_NEAR(slips.values[1][1], mu + v * std::sin(3 - slip), 1e-8) << method;
  }
}

TEST(Switching, AbsoluteValueIsExact) {
  // x'' = -sign(x): arcs of parabolas, of period 4 sqrt(2 x0).
  const Rows rows = integrate(
      {"--equation", "x'' = -sign(x); x(0) = 0.5; x'(0) = 0", "--until", "12", "--tolerance", "1e-13"});
  ASSERT_EQ(rows.values.size(), 2U);
  EXPECT_NEAR(rows.values[1][1], 0.5, 1e-11);  // three periods
  EXPECT_NEAR(rows.values[1][2], 0, 1e-11);
}

TEST(Example, OfThePageRuns) {
  const Finished f = scene::run_program({NLMECH_BINARY_DIR "/bin/integrators_example"}, {});
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  // The pendulum of amplitude 1 by another method and the command.
  const Rows rows = integrate({"--equation", "a'' + (g/l) sin(a) = 0; g = 9.81; l = 2; a(0) = 1; a'(0) = 0",
                               "--until", "10", "--tolerance", "1e-13", "--method", "adaptive-collocation"});
  ASSERT_TRUE(f.output.starts_with("success: a = ")) << f.output;
  EXPECT_NEAR(std::stod(f.output.substr(13)), rows.values.at(1)[1], 2e-11);
}

}  // namespace
}  // namespace nlmech::integrators_commands_test
