/// `homotopy frame`: the frames that ship, frames of one's own, and what is said of files that are none.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/chapters/homotopy/own_frame.hpp"

namespace nlmech::own_work_frame_test {
namespace {

using namespace own_frame;

void expect_limits(const Rows& rows, double maximum, double minimum, double tolerance) {
  ASSERT_EQ(loads(rows, "maximum").size(), 1U);
  ASSERT_EQ(loads(rows, "minimum").size(), 1U);
  EXPECT_NEAR(loads(rows, "maximum")[0], maximum, tolerance);
  EXPECT_NEAR(loads(rows, "minimum")[0], minimum, tolerance);
}

// oracle: homotopy_frames toggle 0.44 of 4 m*imum, Lee's frame of 20 *limit, shallow arch of 32 *
TEST(OwnFrame, TheFramesThatShip) {
  expect_limits(path_of(shipped("toggle")), 42.4387099966, 32.1222520061, 2e-10);
  expect_limits(path_of(shipped("lee")), 1.8556739134, -0.9414420703, 2e-10);
  const Rows half = path_of(shipped("half-shallow-arch")), whole = path_of(shipped("shallow-arch"));
  expect_limits(half, 34.0902630603, 14.2531501017, 1e-9);
  expect_limits(whole, 34.0902630603, 14.2531501017, 1e-9);
  EXPECT_TRUE(loads(half, "bifurcation").empty());
  ASSERT_EQ(loads(whole, "bifurcation").size(), 2U);
  EXPECT_NEAR(loads(whole, "bifurcation")[0], 27.0, 0.15);  // between two places of a walk
  const double limit = 2 * std::pow(1 - std::pow(1.25, -1. / 3), 1.5);
  expect_limits(path_of(shipped("truss")), limit, -limit, 1e-12);
}

// Errors of m^-2 with 20, 40 and 80 elements; the load is in units of EI/R^2 = 100.
// oracle: homotopy_frames deep arch of 20 limit
TEST(OwnFrame, DeepArch) {
  std::vector<double> found;
  for (const char* elements : {"2", "4", "8"})
    found.push_back(loads(path_of(shipped("deep-arch"), {"--elements", elements}), "maximum").at(0));
  EXPECT_NEAR(100 * found[0], 907.34075563, 1e-8);
  EXPECT_NEAR((4 * found[2] - found[1]) / 3, 8.973, 5e-4);
}

TEST(OwnFrame, ColumnCantileverAndPortal) {
  const Rows column_rows = path_of(shipped("column"), {"--branches", "2", "--until", "1.5"});
  ASSERT_EQ(column_rows.at(0).cells.at(0), "branch");
  for (const double load : loads(column_rows, "bifurcation")) EXPECT_NEAR(load, 1, 2e-5);  // pi^2/EA and m^-2
  EXPECT_EQ(number(column_rows.back().cells.at(0)), 2);
  EXPECT_EQ(number(column_rows.back().cells.at(1)), 1.5);
  const Rows rolled = path_of(shipped("cantilever"), {"--until", "1"});
  EXPECT_EQ(number(rolled.back().cells.at(0)), 1);
  EXPECT_NEAR(number(rolled.back().cells.at(1)), -1, 1e-11);
  EXPECT_NEAR(number(rolled.back().cells.at(2)), 0, 1e-11);
  EXPECT_NEAR(number(rolled.back().cells.at(3)), 2 * std::acos(-1.), 1e-11);
  // With its small force sideways the portal sways: x grows all the way to the limit, past the sway
  // load 7.379.
  const Rows portal = path_of(shipped("portal"));
  ASSERT_FALSE(loads(portal, "maximum").empty());
  EXPECT_GT(loads(portal, "maximum")[0], 7.379);
  EXPECT_TRUE(loads(portal, "bifurcation").empty());
}

TEST(OwnFrame, EndsAndNames) {
  const Rows rows = path_of(written(beam), {"--until", "0.5"});
  EXPECT_EQ(rows[0].cells, (std::vector<std::string>{"load_factor", "B.x", "B.y", "B.rotation", "mesh_error",
                                                     "negative_eigenvalues", "kind"}));
  EXPECT_EQ(number(rows.back().cells[0]), 0.5);
  const Finished short_of = frame(written(beam), {"--until", "50", "--steps", "2"});
  EXPECT_EQ(short_of.exit_code, 1);
  EXPECT_NE(short_of.errors.find("2 steps end at a load factor"), std::string::npos) << short_of.errors;
  EXPECT_EQ(scene::parse_csv(short_of.output, "output").size(), 4U) << short_of.output;
  // A name that has a comma.
  std::string named = with(beam, "B = [1", "'B,1' = [1");
  named = with(with(named, "\"B\"", "\"B,1\""), "B = {", "'B,1' = {");
  EXPECT_EQ(path_of(written(named), {"--until", "1"})[0].cells[1], "B,1.x");
  // A load factor of the other sign, of which this beam's displacements are a mirror image.
  const Rows down = path_of(written(beam), {"--until", "0.5"}),
             up = path_of(written(beam), {"--until", "-0.5"});
  EXPECT_EQ(number(up.back().cells[0]), -0.5);
  EXPECT_NEAR(number(up.back().cells[2]), -number(down.back().cells[2]), 1e-12);
  EXPECT_EQ(frame(written(beam), {"--until", "0"}).exit_code, 2);
}

// Every branch that does not come to its end says so: without a limit or branch point, and behind one.
TEST(OwnFrame, AnEndAfterAllStepsIsAFailure) {
  const auto expect = [](const std::string& file, const std::vector<std::string>& words, std::size_t points) {
    const Finished f = frame(file, words);
    EXPECT_EQ(f.exit_code, 1) << f.errors;
    for (const char* said :
         {"step_limit", "all points found are printed", "steps end at a load factor", "(until)"})
      EXPECT_NE(f.errors.find(said), std::string::npos) << f.errors;
    const Rows rows = scene::parse_csv(f.output, "output");
    EXPECT_EQ(loads(rows, "maximum").size() + loads(rows, "minimum").size(), points);
  };
  expect(written(beam), {}, 0);
  const std::string lee = scene::read_whole(shipped("lee")), stiff = "EA = 4.32e7\n";
  std::string slender = lee;
  for (std::size_t at = 0; (at = slender.find("EA = ", at)) != std::string::npos; at += stiff.size())
    slender.replace(at, slender.find('\n', at) + 1 - at, stiff);
  expect(written(slender), {}, 1);
  expect(shipped("toggle"), {"--turn", "0.002"}, 0);
}

// The first row takes a hundredth of all that is asked for: ten seconds here.
TEST(OwnFrame, TheLimitOfTimeKeepsThePoints) {
  const Finished path = frame(shipped("lee"), {"--elements", "100", "--limit", "1"});
  EXPECT_EQ(path.exit_code, 1) << path.errors;
  EXPECT_NE(path.errors.find("time_limit"), std::string::npos) << path.errors;
  EXPECT_GE(scene::parse_csv(path.output, "output").size(), 2U);
  const Finished motion = frame(shipped("toggle"), {"--dynamic", "--time", "1000", "--step", "1e-4",
                                                    "--every", "0.01", "--elements", "10", "--limit", "1"});
  EXPECT_EQ(motion.exit_code, 1) << motion.errors;
  EXPECT_NE(motion.errors.find("time_limit"), std::string::npos) << motion.errors;
  EXPECT_GE(scene::parse_csv(motion.output, "output").size(), 2U);
}

// A bar that is 1 long and 1 stiff has no length left under a load of 1.
TEST(OwnFrame, ABarWithoutLengthIsNamed) {
  std::string bar = with(with(with(beam, "EA = 1000", "EA = 1"), "y = -1", "x = -1"), "[supports]",
                         "[supports]\nB = [\"y\", \"rotation\"]");
  const Finished f = frame(written(bar), {"--elements", "1", "--until", "2"});
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_NE(f.errors.find("length left"), std::string::npos) << f.errors;
  // Steps whose squares are no numbers.
  EXPECT_NE(frame(written(beam), {"--until", "1e-300"}).errors.find("too small to be squared"),
            std::string::npos);
  EXPECT_EQ(number(path_of(written(beam), {"--until", "1e-100"}).back().cells[0]), 1e-100);
}

// Steps that turn less are shorter, and more of them lead to the same limit.
TEST(OwnFrame, TurnsAsMuchAsItIsTold) {
  const Rows usual = path_of(shipped("truss")), fine = path_of(shipped("truss"), {"--turn", "0.03"});
  EXPECT_GT(fine.size(), 3 * usual.size());
  const double limit = 2 * std::pow(1 - std::pow(1.25, -1. / 3), 1.5);
  expect_limits(fine, limit, -limit, 1e-12);
}

TEST(OwnFrame, WrongFilesAreNamedWithTheirLine) {
  const auto expect = [](const std::string& text, const std::vector<std::string>& named) {
    const Finished f = frame(written(text));
    EXPECT_EQ(f.exit_code, 2) << text << f.errors;
    EXPECT_TRUE(f.output.empty()) << f.output;
    for (const std::string& words : named)
      EXPECT_NE(f.errors.find(words), std::string::npos) << f.errors << " lacks " << words;
  };
  expect("", {".toml", "[nodes]", "no nodes"});
  expect("nodes = 1", {"line 1", "table"});
  expect(with(beam, "B = [1, 0]", "B = [1]"), {"line 3", "nodes.B", "[x, y]"});
  expect(with(beam, "B = [1, 0]", "B = [inf, 0]"), {"line 3", "finite"});
  expect(with(beam, "B = [1, 0]", "B = [1, 0]\nB = [2, 0]"), {"line 4"});
  expect(with(beam, "B = [1, 0]", "B = [0, 0.0]"), {"line 3", "node B", "where node A is"});
  expect(with(beam, "B = [1, 0]", "B = [1, 0]\nC = [2, 0]"), {"line 4", "node C has no member"});
  expect(with(beam, "\"B\"]", "\"b\"]"), {"line 4", "no node b"});
  expect(with(beam, "EI = 1", "EI = -1"), {"line 4", "A-B", "EI = -1"});
  expect(with(beam, "EI = 1", "EI = 'soft'"), {"line 7", "EI", "not a number"});
  expect(with(beam, "EI = 1\n", ""), {"line 4", "without EI"});
  expect(with(beam, "EI = 1", "EI = 1\nhinges = [\"C\"]"), {"line 8", "joins A and B"});
  expect(with(beam, "EI = 1", "EI = 1\nelements = 0"), {"line 8", "whole number"});
  expect(with(beam, "EI = 1", "EI = 1\nradius = 0.4"), {"line 4", "radius = 0.4"});
  expect(with(beam, "EI = 1", "EJ = 1"), {"line 7", "EJ", "no such key"});
  expect(with(beam, "\"rotation\"", "\"turn\""), {"line 9", "turn is no motion"});
  expect(with(beam, "A = [\"x\"", "Z = [\"x\""), {"line 9", "no node Z"});
  expect(with(beam, "\"rotation\"", "\"y\""), {"line 3", "node B can move along"});
  expect(with(beam, "A = [\"x\", \"y\", \"rotation\"]", ""), {"line 2", "node A can move"});
  expect(with(beam, "y = -1", "z = -1"), {"line 11", "z", "x, y, moment"});
  expect(with(beam, "y = -1", "y = 0"), {"no load"});
  expect(with(beam, "B = { y", "A = { y"), {"line 11", "A.y, which is held"});
  expect(with(beam, "[loads]", "[load]"), {"line 10", "no such key"});
  expect("[nodes\n", {"line 1", "column"});
  expect("a." + std::string(5000, '.'), {"dots"});
}

TEST(OwnFrame, CasesDisplacementsAndMotionsInTimeAreNamedWhereTheyAreWrong) {
  const auto expect = [](const std::string& file, const std::vector<std::string>& words,
                         const std::vector<std::string>& named) {
    const Finished f = frame(file, words);
    EXPECT_EQ(f.exit_code, 2) << f.errors;
    EXPECT_TRUE(f.output.empty()) << f.output;
    for (const std::string& word : named)
      EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors << " lacks " << word;
  };
  const std::string cases = shipped("cases"), toggle = shipped("toggle");
  expect(cases, {}, {"[loads]", "--case", "lift, twist, weight"});
  expect(cases, {"--case", "nothing"}, {"no case nothing", "lift, twist, weight"});
  expect(toggle, {"--case", "weight"}, {"no case weight"});
  // Mistakes of a case that is not asked for.
  const std::string two = with(beam, "[loads]\nB", "[loads.down]\nB");
  for (const auto& [other, word] :
       std::vector<std::pair<std::string, std::string>>{{"Z = { y = 1 }", "no node Z"},
                                                        {"A = { x = 2 }", "A.x, which is held"},
                                                        {"B = { y = 0 }", "no load"}})
    expect(written(two + "[loads.other]\n" + other + "\n"), {"--case", "down"}, {"line 13", word});
  expect(written(two + "[displacements.other]\nA = { y = 1 }\n"), {"--case", "down"}, {"line 13", "A.y"});
  expect(written(std::string(beam) + "[displacements]\nZ = { y = 1 }\n"), {}, {"line 13", "no node Z"});
  expect(written(std::string(beam) + "[displacements]\nA = { y = 1 }\n"), {}, {"line 13", "held"});
  expect(written(std::string(beam) + "[imperfection]\nmode = 0\namplitude = 1\n"), {}, {"line 13", "mode"});
  expect(written(std::string(beam) + "[damping]\nmass = -1\n"), {"--dynamic", "--time", "1"},
         {"line 12", "damping = -1"});
  expect(toggle, {"--dynamic"}, {"--time"});
  expect(shipped("lee"), {"--dynamic", "--time", "1"}, {"line 11", "mass"});
  expect(toggle, {"--dynamic", "--time", "1", "--history", "ramp"}, {"--duration"});
  expect(toggle, {"--dynamic", "--time", "1", "--duration", "1"}, {"--duration", "step"});
  expect(toggle, {"--dynamic", "--time", "1", "--step", "1e-3", "--tolerance", "1e-6"}, {"one of both"});
  expect(toggle, {"--dynamic", "--time", "1", "--step", "1e-7"}, {"--every", "1000000"});
  expect(toggle, {"--dynamic", "--time", "1", "--every", "1e-7"}, {"--every", "1000000"});
}

// An option that the mode does not heed changes nothing, which its user cannot see: it is refused.
TEST(OwnFrame, OptionsOfTheOtherModeAreNamed) {
  const auto expect = [](const std::string& file, const std::vector<std::string>& words) {
    const Finished f = frame(file, words);
    EXPECT_EQ(f.exit_code, 2) << words[words.size() - 2];
    EXPECT_TRUE(f.output.empty()) << f.output;
    EXPECT_NE(f.errors.find(words[words.size() - 2] + ":"), std::string::npos) << f.errors;
  };
  const std::string toggle = shipped("toggle");
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--history", "step"},
                                                                                      {"--factor", "1"},
                                                                                      {"--duration", "1"},
                                                                                      {"--time", "1"},
                                                                                      {"--method", "newmark"},
                                                                                      {"--step", "0.1"},
                                                                                      {"--tolerance", "0.1"},
                                                                                      {"--every", "1"}})
    expect(toggle, {option, value});
  for (const char* option : {"--until", "--branches", "--steps", "--turn"})
    expect(toggle, {"--dynamic", "--time", "0.01", option, "1"});
  // The steps are those on the way to the shape of an imperfection.
  EXPECT_NE(frame(shipped("level-brace"), {"--dynamic", "--time", "1", "--steps", "100"}).errors.find("mass"),
            std::string::npos);
}

TEST(OwnFrame, DrawsThePaths) {
  const std::string picture = testing::TempDir() + "own_frame_" + std::to_string(::getpid()) + ".svg";
  std::filesystem::remove(picture);
  for (const char* name : {"lee", "shallow-arch", "column"}) {
    const Finished f =
        frame(shipped(name), {"--branches", "2", "--until", "40", "--steps", "20", "--plot", picture});
    EXPECT_NE(f.exit_code, 2) << f.errors;
    EXPECT_EQ(f.errors.find("not drawn"), std::string::npos) << f.errors;
    EXPECT_TRUE(std::filesystem::exists(picture));
  }
  std::filesystem::remove(picture);
}

}  // namespace
}  // namespace nlmech::own_work_frame_test
