/// `compare`: which methods, which tolerances, which reference.
#include <algorithm>

#include "tests/chapters/integrators/run.hpp"

namespace nlmech::integrators_commands_test {
namespace {

struct Compared {
  std::vector<Words> rows;  ///< without the header
  std::string errors;
  [[nodiscard]] Words methods() const {
    Words names;
    for (const Words& row : rows) names.push_back(row.at(0));
    return names;
  }
};

Compared compare(Words words) {
  words.insert(words.begin(), "compare");
  const Finished f = integrators(words);
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  Compared c{{}, f.errors};
  if (f.exit_code != 0) return c;
  const auto records = scene::parse_csv(f.output, "output");
  EXPECT_EQ(records.at(0).cells,
            (Words{"method", "setting", "status", "digits", "seconds", "right_hand_sides", "note"}));
  for (std::size_t i = 1; i < records.size(); ++i) c.rows.push_back(records[i].cells);
  return c;
}

bool has(const Words& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

TEST(Compare, WithoutAListTakesWhatSuitsTheProblem) {
  const Words free =
      compare({"--equation", "x'' + sin(x) = 0", "--initial", "x=1, x'=0", "--until", "5"}).methods();
  for (const char* name : {"adaptive-collocation", "series", "ode45", "rkn1210"})
    EXPECT_TRUE(has(free, name)) << name;
  // Velocities: no rkn1210, also where they come with a factor that is zero at first.
  const Words damped =
      compare({"--equation", "x'' + x^2 x' + x = 0", "--initial", "x=0, x'=1", "--until", "5"}).methods();
  EXPECT_FALSE(has(damped, "rkn1210"));
  EXPECT_TRUE(has(damped, "series"));
  // With a step those that take one.
  for (const Words& row :
       compare({"--equation", "x'' + x = 0", "--initial", "x=0, x'=1", "--until", "5", "--step", "0.1"}).rows)
    EXPECT_EQ(row[2], "success") << row[0] << row[6];
  const Compared stiff = compare({"--file", "chapters/integrators/examples/robertson.ode", "--until", "1e4"});
  EXPECT_TRUE(has(stiff.methods(), "adaptive-collocation"));
  EXPECT_FALSE(has(stiff.methods(), "series"));
  for (const Words& row : stiff.rows) EXPECT_EQ(row[2], "success") << row[0] << row[6];
}

TEST(Compare, SweepsByDecadesOrAList) {
  const Words equation = {"--equation", "x'' = -x", "--initial", "x=1, x'=0",
                          "--until",    "20",       "--methods", "ode45,series"};
  Words decades = equation, list = equation;
  decades.insert(decades.end(), {"--tolerances", "1e-3:1e-6"});
  list.insert(list.end(), {"--tolerances", "1e-3,1e-4,1e-5,1e-6"});
  const Compared one = compare(decades), two = compare(list);
  ASSERT_EQ(one.rows.size(), 8U);
  ASSERT_EQ(two.rows.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    // Everything but the seconds is the same to the bit: the tolerances are.
    for (const std::size_t column : {0U, 1U, 2U, 3U, 5U}) EXPECT_EQ(one.rows[i][column], two.rows[i][column]);
    EXPECT_EQ(one.rows[i][0], i < 4 ? "ode45" : "series");
    EXPECT_EQ(one.rows[i][1],
              Words({"tolerance 0.001", "tolerance 0.0001", "tolerance 1e-05", "tolerance 1e-06"})[i % 4]);
    if (i % 4 == 0) continue;
    EXPECT_GT(std::stod(one.rows[i][3]), std::stod(one.rows[i - 1][3])) << i;
  }
  EXPECT_NE(one.errors.find("agree to "), std::string::npos) << one.errors;
}

// Methods of fixed step take the step, the others the tolerances; without a step they have none to take.
TEST(Compare, TakesAStepBesideTolerances) {
  Words words = {"--equation", "x'' = -x",  "--initial", "x=1, x'=0",    "--until",
                 "2",          "--methods", "rk4,ode45", "--tolerances", "1e-3,1e-6"};
  const Compared without = compare(words);
  words.insert(words.end(), {"--step", "0.1"});
  const Compared with = compare(words);
  ASSERT_EQ(without.rows.size(), 3U);
  ASSERT_EQ(with.rows.size(), 3U);
  EXPECT_EQ(without.rows[0][2], "unsuitable");
  EXPECT_NE(without.rows[0][6].find("give a step"), std::string::npos) << without.rows[0][6];
  EXPECT_EQ(with.rows[0][1], "step 0.1");
  EXPECT_EQ(with.rows[0][2], "success");
  EXPECT_EQ(with.rows[1][1], "tolerance 0.001");
  EXPECT_EQ(with.rows[2][1], "tolerance 1e-06");
  const Compared absolute = compare({"--equation", "x' = -x", "--initial", "x=1", "--until", "1", "--methods",
                                     "rk4,ode45", "--step", "0.1", "--absolute-tolerance", "1e-12"});
  ASSERT_EQ(absolute.rows.size(), 2U);
  EXPECT_EQ(absolute.rows[0][1], "step 0.1");
  EXPECT_EQ(absolute.rows[1][1], "tolerance 1e-09 absolute 1e-12");
}

TEST(Compare, RefusesTolerancesThatCannotBeMeant) {
  const Words begin = {"compare", "--equation", "x' = -x", "--initial",
                       "x=1",     "--until",    "1",       "--tolerances"};
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"1e-12:1e-3"}, "from the coarse one to the tight one"},
      {{"1e-3:"}, "--tolerances 1e-3:: a sweep"},
      {{":"}, "--tolerances :: a sweep"},
      {{"1e-3:1e-6:1e-9"}, "--tolerances 1e-3:1e-6:1e-9: a sweep"},
      {{"1e-3,,1e-6"}, "--tolerances"},
      {{"0"}, "--tolerances"},
      {{"-1e-3"}, "--tolerances"},
      {{"nan"}, "--tolerances"},
      {{"1e-3:0"}, "--tolerances"},
      {{"1:1e-300"}, "thirty decades"},
      {{"few"}, "--tolerances few"},
      {{"1e-3", "--tolerance", "1e-6"}, "no --tolerance"},
      {{"1e-3", "--methods", "rk4,rk6", "--step", "0.1"}, "--tolerances: none of the methods rk4,rk6"},
      {{"1e-3", "--methods", "ode45,ode45"}, "ode45 is given twice"},
      {{"1e-3", "--methods", "ode45,,rk4"}, "--methods"},
      {{"1e-3", "--methods", "all,rk4"}, "there is no method 'all'"}};
  for (const auto& [more, says] : cases) {
    Words words = begin;
    words.insert(words.end(), more.begin(), more.end());
    expect_refused({words, {says}});
  }
}

}  // namespace
}  // namespace nlmech::integrators_commands_test
