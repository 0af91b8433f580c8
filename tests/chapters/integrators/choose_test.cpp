/// `integrators choose`, and `integrate` without a method, as a user types them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/chapters/integrators/run.hpp"

namespace nlmech::integrators_commands_test {
namespace {

const Words forced = {"--equation", "x'' + 0.1 x' + x + a x^3 = 0.2 cos(1.1 t); a = 3", "--initial",
                      "x=1, x'=0"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
Words of(const std::string& command, const Words& problem, const Words& more) {
  return with(with({command}, problem), more);
}

/// The first row's method.
std::string chosen(const Words& problem, const Words& more) {
  const Finished f = integrators(of("choose", problem, more));
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  return f.exit_code == 0 ? scene::parse_csv(f.output, "output").at(1).cells.at(1) : "";
}

TEST(Choose, PrintsRanksWithTheirReasons) {
  const Finished f = integrators(of("choose", forced, {"--until", "20", "--set", "a=4"}));
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto records = scene::parse_csv(f.output, "output");
  EXPECT_EQ(records.at(0).cells, (Words{"rank", "method", "tolerance", "seconds", "reason"}));
  ASSERT_GE(records.size(), 3U);
  for (std::size_t i = 1; i < records.size(); ++i) {
    const Words& cells = records[i].cells;
    ASSERT_EQ(cells.size(), 5U);
    EXPECT_EQ(cells[0], std::to_string(i));
    EXPECT_GT(std::stod(cells[2]), 0.9e-13);
    EXPECT_LT(std::stod(cells[2]), 1e-7);
    EXPECT_GT(std::stod(cells[3]), 0);
  }
  for (const std::string part : {"9 digits", "not stiff", "smooth", "a right-hand side takes"})
    EXPECT_NE(records[1].cells[4].find(part), std::string::npos) << part << ": " << records[1].cells[4];
}

TEST(Choose, SaysTheCommandThatRunsTheFirst) {
  const Finished f = integrators(of("choose", forced, {"--until", "20", "--set", "a=4", "--digits", "6"}));
  const std::string head =
      "integrators integrate --equation \"x'' + 0.1 x' + x + a x^3 = 0.2 cos(1.1 t); a = 3\" --set a=4 "
      "--initial \"x=1, "
      "x'=0\" --until 20 --method ";
  ASSERT_EQ(f.errors.substr(0, head.size()), head);
  const auto records = scene::parse_csv(f.output, "output");
  const std::string method = records.at(1).cells.at(1), tolerance = records.at(1).cells.at(2);
  EXPECT_EQ(f.errors.substr(head.size()), method + " --tolerance " + tolerance + "\n");
  const Finished run = integrators(of(
      "integrate", forced, {"--set", "a=4", "--until", "20", "--method", method, "--tolerance", tolerance}));
  EXPECT_EQ(run.exit_code, 0) << run.errors;
}

TEST(Choose, FitsTheProblem) {
  EXPECT_EQ(chosen({"--problem", "duffing"}, {"--until", "100"}), "rkn1210");
  EXPECT_EQ(chosen({"--problem", "lorenz"}, {"--until", "5"}), "series");
  EXPECT_EQ(chosen({"--problem", "van-der-pol"}, {"--set", "mu=1000", "--until", "2000"}),
            "adaptive-collocation");
  EXPECT_EQ(chosen({"--file", "chapters/integrators/examples/friction.ode"}, {"--until", "20"}), "series");
}

// More digits than rounding leaves: Lorenz's attractor multiplies errors by e^(0.9 t).
TEST(Choose, SaysWhatRoundingLeaves) {
  const Finished f = integrators({"choose", "--problem", "lorenz", "--until", "25", "--digits", "14"});
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(f.errors.find("rounding alone leaves"), std::string::npos) << f.errors;
}

TEST(Choose, EndsWithOneWhereTheSolutionEnds) {
  const Finished f = integrators({"choose", "--equation", "x' = x^2", "--initial", "x=1", "--until", "2"});
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_EQ(f.output, "");
  EXPECT_NE(f.errors.find("t = 1.0"), std::string::npos) << f.errors;
}

TEST(Choose, RefusesWhatCannotBeMeant) {
  const std::vector<Bad> all = {
      {of("choose", forced, {"--until", "20", "--digits", "15"}), {"--digits 15", "from 1 to 14"}},
      {of("choose", forced, {"--until", "20", "--digits", "0"}), {"--digits 0"}},
      {of("choose", forced, {"--until", "0"}), {"--until 0", "nothing to choose"}},
      {of("choose", forced, {"--until", "20", "--set", "b=1"}), {"b"}},
      {of("choose", forced, {}), {"--until"}},
      {{"choose", "--until", "1"}, {"--equation TEXT"}},
      {{"choose", "--equation", "x' = -y", "--initial", "x=1", "--until", "1"}, {"y is not defined"}}};
  for (const Bad& bad : all) expect_refused(bad);
}

// At a tolerance of 1e-9 it is what `choose` says for nine digits, as each method's last digits tell.
TEST(Integrate, TakesTheMethodThatChooseSays) {
  const std::vector<std::pair<Words, std::string>> all = {
      {{"--problem", "duffing"}, "100"},
      {{"--problem", "lorenz"}, "5"},
      {{"--file", "chapters/integrators/examples/van-der-pol.ode"}, "1000"},
      {forced, "20"}};
  for (const auto& [problem, end] : all) {
    const std::string method = chosen(problem, {"--until", end});
    const Finished without = integrators(of("integrate", problem, {"--until", end}));
    const Finished with_it = integrators(of("integrate", problem, {"--until", end, "--method", method}));
    EXPECT_EQ(without.exit_code, 0) << without.errors;
    EXPECT_EQ(without.output, with_it.output) << method;
  }
}

// What `series` alone has is a choice of it; a polynomial within steps is as exact as their ends.
TEST(Integrate, ChoosesAmongMethodsThatHaveWhatIsAsked) {
  const Words problem = {"--problem", "duffing", "--until", "10"};
  for (const Words& asked : {Words{"--order", "18"}, Words{"--every", "1"}, Words{"--event", "x=0"}}) {
    const Finished without = integrators(of("integrate", problem, asked));
    const Finished series = integrators(of("integrate", problem, with(asked, {"--method", "series"})));
    EXPECT_EQ(without.exit_code, 0) << without.errors;
    EXPECT_EQ(without.output, series.output) << asked.front();
  }
}

}  // namespace
}  // namespace nlmech::integrators_commands_test
