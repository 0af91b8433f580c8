/// The problems of the sources by the sources' own methods, as a user types them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/chapters/integrators/run.hpp"

namespace nlmech::integrators_commands_test {
namespace {

// The linear oscillator from (1, 0) is cos t: phase error z^4/720 a radian for Laier, z^2/12 for Newmark.
TEST(Hermitian, LinearOscillatorAtTheAskedRows) {
  const Finished f = run("integrate --problem linear --until 2 --step 0.1 --every 0.5 --method laier");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto rows = scene::parse_numbers(f.output, "output", {"t", "x", "x'"});
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    EXPECT_NEAR(rows.column[1][i], std::cos(rows.column[0][i]), 2 * 1e-4 / 720);
    EXPECT_NEAR(rows.column[2][i], -std::sin(rows.column[0][i]), 2 * 1e-4 / 720);
  }
  const Finished n = run("integrate --problem linear --until 2 --step 0.1 --method newmark");
  const auto ends = scene::parse_numbers(n.output, "output", {"t", "x", "x'"});
  EXPECT_NEAR(ends.column[1][1] - std::cos(2.0), std::sin(2.0) * 2 * 0.01 / 12, 1e-5);
}

// Every problem and every row of the table, to the same end: order 4 closely, order 2 roughly.
TEST(Hermitian, EveryProblemByEveryOperator) {
  struct Asked {
    std::string words;
    std::vector<std::string> header;
  };
  const std::vector<Asked> all = {
      {"laier-duffing --until 10", {"t", "x", "x'"}},
      {"laier-duffing --set damping=0 --set force=0 --initial 1,0 --until 5", {"t", "x", "x'"}},
      {"laier-van-der-pol --until 5", {"t", "x", "x'"}},
      {"laier-van-der-pol --set mu=3 --initial 2,0 --until 2", {"t", "x", "x'"}},
      {"two-dof --until 10", {"t", "x1", "x2", "x1'", "x2'"}}};
  for (const Asked& a : all) {
    const Finished best = run("integrate --problem " + a.words + " --tolerance 1e-10 --method laier");
    ASSERT_EQ(best.exit_code, 0) << best.errors;
    const auto truth = scene::parse_numbers(best.output, "output", a.header);
    for (const std::string row : {"laier", "argyris", "newmark", "hoff", "bazzi"}) {
      const Finished f = run("integrate --problem " + a.words + " --step 0.01 --method " + row);
      ASSERT_EQ(f.exit_code, 0) << f.errors;
      const auto rows = scene::parse_numbers(f.output, "output", a.header);
      ASSERT_EQ(rows.rows(), 2U);
      EXPECT_EQ(rows.column[0][1], truth.column[0][1]);
      for (std::size_t c = 1; c < a.header.size(); ++c)
        EXPECT_NEAR(rows.column[c][1], truth.column[c][1], row == "laier" || row == "argyris" ? 1e-7 : 2e-3)
            << a.words << row;
    }
  }
}

// A step that the leap of a stiff oscillator does not allow ends with the reason, where, and what to change.
TEST(Hermitian, WrongBranchIsSaid) {
  const Finished f =
      run("integrate --problem laier-van-der-pol --set mu=1000 --initial 2,0 --until 2000 --step 0.125 "
          "--method laier");
  EXPECT_EQ(f.exit_code, 1) << f.errors;
  EXPECT_EQ(f.output, "");
  for (const std::string word : {"wrong_branch", "laier", "t = 807", "smaller step"})
    EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors;
}

// Every problem, its names, its last row at the asked time, and a value from elsewhere.
TEST(Transversal, EveryProblemToItsReference) {
  struct Known {
    std::string words, header;
    double end, value, bound;
  };
  const std::vector<Known> all = {
      // oracle: transversal_motions driven Duffing *, van der Pol *
      {"driven-duffing --until 50 --step 0.005 --points 5", "t,x,x'", 50, 1.203734404401093, 1e-9},
      {"van-der-pol --until 40 --step 0.002", "t,x,x'", 40, 1.872808279858090, 1e-6},
      // x = cos t, whatever the step.
      {"linear --until 30 --step 3 --points 2", "t,x,x'", 30, std::cos(30.), 1e-13},
      // Moving as one: x = cos(sqrt(1.5) t) for k = 1.5 without the cubic terms.
      {"two-dof --set damping=0 --set hardening=0 --set force=0 --set stiffness=1.5 --initial 1,1,0,0 "
       "--until 4 "
       "--step 0.5 --points 8",
       "t,x1,x2,x1',x2'", 4, std::cos(std::sqrt(1.5) * 4), 1e-13}};
  for (const Known& k : all) {
    const Finished f = run("integrate --method mtl --problem " + k.words);
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    ASSERT_TRUE(f.output.starts_with(k.header + "\n")) << f.output;
    const auto records = scene::parse_csv(f.output, "output");
    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(std::stod(records[2].cells.at(0)), k.end);
    EXPECT_NEAR(std::stod(records[2].cells.at(1)), k.value, k.bound) << k.words;
  }
}

TEST(Transversal, RowsAtEqualDistancesWithinBlocks) {
  const Finished f =
      run("integrate --method mtl --problem linear --until 1 --step 0.4 --points 2 --every 0.25");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto rows = scene::parse_numbers(f.output, "output", {"t", "x", "x'"});
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  for (std::size_t i = 0; i < rows.rows(); ++i)
    EXPECT_NEAR(rows.column[1][i], std::cos(rows.column[0][i]), 1e-14);
}

// What van der Pol's equation shows as linear grows like exp(mu t): over a block of 3 it overflows.
TEST(Transversal, FailureSaysWhereAndWhatToChange) {
  const Finished f = run("integrate --method mtl --problem van-der-pol --set mu=1000 --until 10 --step 1");
  EXPECT_EQ(f.exit_code, 1) << f.errors;
  EXPECT_EQ(f.output, "");
  for (const std::string word : {"mtl", "t = ", "smaller step"})
    EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors;
}

// Every problem, its own names, its last row at the asked time, and its value. The default tolerance is 1e-9;
// the bounds leave what each motion amplifies. oracle: algebraic_series_motions Lorenz u(20), Duffing u(50),
// oscillator x, projectile x, projectile lands at, bodies y of 4
TEST(Series, EveryProblemToItsReference) {
  struct Known {
    std::string words, header;
    std::size_t column;
    double end, value, bound;
  };
  const std::vector<Known> all = {
      {"lorenz --until 20 --tolerance 1e-14", "t,u,v,w", 1, 20, -1.356348984580380, 1e-5},
      {"forced-duffing --until 50", "t,u,u'", 1, 50, 1.221946638567542, 1e-6},
      {"oscillator --until 378.14159265358979", "t,x,x'", 1, 378.14159265358979, -0.302938936512582, 1e-6},
      {"projectile --until 9.84601516944855", "t,x,y,z,x',y',z'", 1, 9.84601516944855, 38476.6981780052,
       1e-4},
      {"bodies --until 3000 --tolerance 1e-13",
       "t,x1,y1,z1,x2,y2,z2,x3,y3,z3,x4,y4,z4,x1',y1',z1',x2',y2',z2',x3',y3',z3',x4',y4',z4'", 11, 3000,
       3.071464269641001, 1e-6}};
  for (const Known& k : all) {
    const Finished f = run("integrate --method series --problem " + k.words);
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    ASSERT_TRUE(f.output.starts_with(k.header + "\n")) << f.output;
    const auto records = scene::parse_csv(f.output, "output");
    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(std::stod(records[2].cells.at(0)), k.end);
    EXPECT_NEAR(std::stod(records[2].cells.at(k.column)), k.value, k.bound) << k.words;
  }
}

// As published: T = 0.1 and N = 20 give another end than the solution.
// oracle: algebraic_series_motions Lorenz T = 0.1: u(20)
TEST(Series, PublishedStepAndOrder) {
  const Finished f = run("integrate --method series --problem lorenz --until 20 --step 0.1 --order 20");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NEAR(std::stod(scene::parse_csv(f.output, "output").at(2).cells.at(1)), -4.78, 0.005);
  const Finished same = run("integrate --method series --problem lorenz --until 20 --step 0.1");
  EXPECT_EQ(same.output, f.output);  // 20 is the order without one
}

TEST(Series, RowsAtEqualDistancesAndParameters) {
  const Finished f =
      run("integrate --method series --problem forced-duffing --set damping=0 --set force=0 --initial 1,0 "
          "--until 1 --every "
          "0.25");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  const auto rows = scene::parse_numbers(f.output, "output", {"t", "u", "u'"});
  EXPECT_EQ(rows.column[0], (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  // Energy v^2/2 + u^4/4 is kept.
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const double u = rows.column[1][i], v = rows.column[2][i];
    EXPECT_NEAR(v * v / 2 + u * u * u * u / 4, 0.25, 1e-8);
  }
}

// A fixed step across a pole ends in a failure, or in nonsense that is finite; here in a failure.
TEST(Series, FailureSaysWhereAndWhatToChange) {
  const Finished f =
      run("integrate --method series --problem forced-duffing --until 100 --step 0.7 --order 80");
  EXPECT_EQ(f.exit_code, 1) << f.errors;
  EXPECT_EQ(f.output, "");
  for (const std::string word : {"series", "t = "})
    EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors;
}

}  // namespace
}  // namespace nlmech::integrators_commands_test
