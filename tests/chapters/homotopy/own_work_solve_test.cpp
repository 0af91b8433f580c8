/// `homotopy solve` with all solvers, and what it says of wrong words.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_solve_test {
namespace {

scene::Finished solve(const std::vector<std::string>& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/homotopy", "solve"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  return scene::run_program(arguments, {});
}

double deflection_of(const scene::Finished& f) {
  const auto rows = scene::parse_csv(f.output, "output");
  double value = 0;
  EXPECT_EQ(rows.size(), 2U) << f.output;
  EXPECT_TRUE(rows.size() == 2 && scene::parse_number(rows[1].cells.at(1), value)) << f.output;
  return value;
}

// One unknown, below the limit load; |F| of 1e-10 of 13.6 lb over half the slope of 14.7 lb/in.
// oracle: homotopy_frames toggle 0.32 of 1 drop under 27.11
TEST(SolveBySolver, AllButFictitiousTimeFindTheDeflection) {
  for (const std::string_view name : algebraic::solver_names()) {
    const auto f =
        solve({"--height", "0.32", "--load", "27.11", "--elements", "1", "--solver", std::string(name)});
    if (name == "fictitious-time") {  // unstable with steps of 0.1: the stiffness at rest is 5000 lb/in
      EXPECT_EQ(f.exit_code, 1);
      EXPECT_NE(f.errors.find("non_finite: fictitious-time"), std::string::npos) << f.errors;
      continue;
    }
    ASSERT_EQ(f.exit_code, 0) << name << ": " << f.errors;
    EXPECT_NEAR(deflection_of(f), 0.265167973289, 5e-10) << name;
  }
}

TEST(SolveBySolver, ManyElementsConvergeToTheElastica) {
  // From rest and past the limit: from m elements the error falls like m^-2, so that 4 and 8 tell 64.
  const std::vector<std::string> words = {"--height", "0.44", "--load", "43.79", "--elements"};
  const auto at = [&](const char* elements) {
    std::vector<std::string> all = words;
    all.emplace_back(elements);
    const auto f = solve(all);
    EXPECT_EQ(f.exit_code, 0) << f.errors;
    return deflection_of(f);
  };
  const double four = at("4"), eight = at("8"), many = at("64");
  const double extrapolated = eight + (eight - four) / 3, step = std::abs(eight - four);
  EXPECT_NEAR(many, extrapolated, 0.1 * step);  // next order, and 1/64 of the step itself
}

TEST(SolveBySolver, WrongWordsAreNamed) {
  const auto expect = [](const std::vector<std::string>& words, const std::string& named) {
    const auto f = solve(words);
    EXPECT_EQ(f.exit_code, 2) << named;
    EXPECT_TRUE(f.output.empty()) << f.output;
    EXPECT_NE(f.errors.find(named), std::string::npos) << f.errors;
  };
  expect({"--height", "0.44", "--load", "43", "--solver", "magic"}, "--solver magic");
  expect({"--height", "0.44", "--load", "43", "--solver", "magic"}, "energy-trust-region");
  expect({"--height", "0.44", "--load", "inf"}, "--load inf");
  expect({"--height", "x", "--load", "43"}, "--height x");
  expect({"--height", "0", "--load", "43"}, "--height 0");
  expect({"--height", "-1", "--load", "43", "--model", "williams"}, "--height -1");
  expect({"--height", "0.44", "--load", "43", "--model", "wooden"}, "--model wooden");
  expect({"--height", "0.44", "--load", "43", "--elements", "0"}, "--elements 0");
  expect({"--height", "0.44", "--load", "43", "--elements", "1e9"}, "--elements 1e9");
  expect({"--height", "0.44", "--load", "43", "--model", "williams", "--elements", "2"}, "--elements 2");
  expect({"--height", "0.44", "--load", "43", "--tolerance", "0"}, "--tolerance 0");
}

}  // namespace
}  // namespace nlmech::own_work_solve_test
