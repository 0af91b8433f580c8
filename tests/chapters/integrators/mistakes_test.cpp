/// What is refused, and how: exit code 2, nothing on standard output, a caret under the place.
#include <filesystem>

#include "nlmech/scene/program/files.hpp"
#include "tests/chapters/integrators/run.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::integrators_commands_test {
namespace {

TEST(Mistakes, EndWithTwoAndAreNamed) {
  const std::vector<Bad> cases = {
      {{"integrate", "--equation", "x'' + y = 0", "--initial", "x=1, x'=0", "--until", "1"},
       {"--equation:1:7: y is not defined", "\n  x'' + y = 0\n        ^\n"}},
      {{"integrate", "--equation", "x'' = -x", "--initial", "x=1", "--until", "1"},
       {"an initial value is missing: --initial x'=..."}},
      {{"integrate", "--equation", "x' = -x", "--initial", "x=1, x=2", "--until", "1"},
       {"--initial:1:6: given a second time"}},
      {{"integrate", "--equation", "x' = -x", "--problem", "lorenz", "--until", "1"},
       {"give one of --problem NAME, --equation TEXT and --file NAME.ode"}},
      {{"integrate", "--until", "1"}, {"--equation TEXT"}},
      {{"integrate", "x' = -x; x(0) = 1", "--until", "1"},
       {"not expected: x' = -x; x(0) = 1", "An equation follows --equation."}},
      {{"integrate", "--file", "nowhere.ode", "--until", "1"}, {"nowhere.ode"}},
      {{"integrate", "--equation", "x' = -a x; a = 1", "--set", "b=1", "--initial", "x=1", "--until", "1"},
       {"--set b: the equation has no such definition; there is a"}},
      {{"integrate", "--equation", "x' = -x", "--initial", "x=1", "--until", "1", "--event", "z=0"},
       {"--event:1:1: z is not defined"}},
      {{"integrate", "--equation", "x' = -x", "--initial", "x=1", "--until", "1", "--event", "x'=0"},
       {"--event:1:1: x' may not stand here"}},
      {{"integrate", "--equation", "x' = -x", "--initial", "x=1", "--until", "1", "--section", "x=1",
        "--every", "1"},
       {"--section shows its own rows alone"}},
      {{"compare", "--equation", "x'^2 = x", "--initial", "x=1", "--until", "1", "--methods", "all"},
       {"x' stands in a power"}},
  };
  for (const Bad& bad : cases) expect_refused(bad);
}

// What is said of an option names it, and points at the place in its text.
TEST(Mistakes, OfTheOptionsOfARun) {
  const Words begin = {"integrate", "--equation", "x'' = -x + a; a = 0; x(0) = 1; x'(0) = 0"};
  const std::vector<Bad> cases = {
      {{"--until", "nan"}, {"--until", "nan"}},
      {{"--until", "inf"}, {"--until", "inf"}},
      {{"--until", "1e400"}, {"--until", "1e400"}},
      {{"--until", ""}, {"--until"}},
      {{"--until", "1", "--until", "2"}, {"--until"}},
      {{}, {"--until"}},
      {{"--until", "1", "--from", "nan"}, {"--from"}},
      {{"--until", "1", "--every", "0"}, {"--every 0"}},
      {{"--until", "1", "--every", "-1"}, {"--every -1"}},
      {{"--until", "100", "--every", "1e-9"}, {"--every 1e-09", "10 million rows"}},
      {{"--until", "1", "--tolerance", "0"}, {"--tolerance 0"}},
      {{"--until", "1", "--tolerance", "1e-6", "--step", "0.1"}, {"--step 0.1", "--tolerance"}},
      {{"--until", "1", "--method", "nosuch"}, {"--method", "nosuch", "adaptive-collocation"}},
      {{"--until", "1", "--method", "ode45", "--step", "0.1"}, {"--method", "ode45", "tolerance"}},
      {{"--until", "1", "--method", "rk4", "--nodes", "7"}, {"rk4", "nodes"}},
      {{"--until", "1", "--largest-step", "0"}, {"--largest-step 0"}},
      {{"--until", "1", "--largest-step", "-1"}, {"--largest-step -1"}},
      {{"--until", "1", "--largest-step", "inf"}, {"--largest-step", "inf"}},
      {{"--until", "1", "--largest-step", "0.1", "--method", "rk4"}, {"--largest-step 0.1", "rk4", "--step"}},
      {{"--until", "1", "--largest-step", "0.1", "--step", "0.1"}, {"--largest-step 0.1", "--step 0.1"}},
      {{"--until", "1", "--event", ""}, {"--event"}},
      {{"--until", "1", "--event", "x<0"}, {"--event:1:2: ", "\n  x<0\n   ^"}},
      {{"--until", "1", "--event", "=0"}, {"--event:1:1: ", "\n  =0\n  ^"}},
      {{"--until", "1", "--event", "x=0=1"}, {"--event:1:4: "}},
      {{"--until", "1", "--event", "x=0 sideways"}, {"--event:1:5: sideways is not defined"}},
      {{"--until", "1", "--event", "x=0 end end"}, {"--event:1:5: end is not defined"}},
      {{"--until", "1", "--section", "x=0", "--event", "x=1"}, {"--section", "--event"}},
      {{"--until", "1", "--initial", "y=1"}, {"--initial:1:1: "}},
      {{"--until", "1", "--initial", "x''=1"}, {"--initial:1:1: "}},
      {{"--until", "1", "--initial", "x=1, x=2"}, {"--initial:1:6: given a second time"}},
      {{"--until", "1", "--initial", "x=1/0"}, {"--initial:1:"}},
      {{"--until", "1", "--initial", "x=x'"}, {"--initial:1:"}},
      {{"--until", "1", "--initial", "x=nan"}, {"--initial:1:3: nan is not defined"}},
      {{"--until", "1", "--initial", "1,2,3"}, {"--initial 1,2,3", "3 numbers", "x,x'"}},
      {{"--until", "1", "--initial", "1,two"}, {"--initial", "two"}},
      {{"--until", "1", "--set", "a"}, {"--set a: say name=value"}},
      {{"--until", "1", "--set", "a=nan"}, {"--set a=nan"}},
      {{"--until", "1", "--set", "a=1", "a=2"}, {"--set", "a is set twice"}},
      {{"--until", "1", "--set", "x=2"}, {"--set x"}},
      {{"--until", "1", "--problem", "lorenz"}, {"give one of"}},
      {{"--until", "1", "--file", "a.ode"}, {"give one of"}},
      {{"--until", "1", "--frobnicate"}, {"--frobnicate"}}};
  for (const Bad& bad : cases) {
    Bad whole = bad;
    whole.words.insert(whole.words.begin(), begin.begin(), begin.end());
    expect_refused(whole);
  }
}

// Problems by name take the same texts and point at the same mistakes.
TEST(Mistakes, OfANamedProblem) {
  const Words begin = {"integrate", "--problem", "duffing", "--until", "1"};
  const std::vector<Bad> cases = {{{"--initial", "x=1, y=2"}, {"--initial:1:6: ", "x, x'"}},
                                  {{"--initial", "x=1, x=2"}, {"--initial:1:6: given a second time"}},
                                  {{"--initial", "x'=oops"}, {"--initial:1:4: oops is not defined"}},
                                  {{"--event", "y=0"}, {"--event:1:1: y is not defined"}},
                                  {{"--set", "mass=1"}, {"--set mass", "hardening"}}};
  for (const Bad& bad : cases) {
    Bad whole = bad;
    whole.words.insert(whole.words.begin(), begin.begin(), begin.end());
    expect_refused(whole);
  }
}

TEST(Mistakes, OfFiles) {
  const tests::TemporaryFolder folder;
  tests::put(folder / "empty.ode", "");
  tests::put(folder / "blank.ode", "\n\n   # nothing\n");
  tests::put(folder / "binary.ode", std::string("\x7f"
                                                "ELF\x02\x01\0\0\xff\xfe",
                                                10));
  tests::put(folder / "zeros.ode", std::string(1000, '\0'));
  tests::put(folder / "huge.ode", "x' = -x " + std::string(1'000'001, ' '));
  tests::put(folder / "typo.ode", "x' = -x\ny'' = sin(z)\n");
  const std::vector<std::pair<std::string, Words>> cases = {
      {"nowhere.ode", {"nowhere.ode: No such file"}},
      {".", {"is a folder"}},
      {"empty.ode", {"empty.ode:1:1: "}},
      {"blank.ode", {"blank.ode:"}},
      {"binary.ode", {"binary.ode:1:1: "}},
      {"zeros.ode", {"zeros.ode:1:1: "}},
      {"huge.ode", {"--file huge.ode: more than 1000000 bytes"}},
      {"typo.ode", {"typo.ode:2:11: z is not defined", "\n  y'' = sin(z)\n            ^"}},
      {"/dev/zero", {"--file /dev/zero: is a device"}}};
  for (const auto& [file, says] : cases)
    expect_refused({{"integrate", "--file", file, "--until", "1", "--initial", "x=1"}, says},
                   folder.string());
}

// Whatever is wrong, the terminal gets no control character and no endless line.
TEST(Mistakes, AreSaidBrieflyAndPrintably) {
  for (const std::string& text :
       {std::string("x' = \x1b[31m"), std::string(20'000, '('), "x' = " + std::string(20'000, 'q'),
        std::string("x' = \xc3\x28"), std::string("x'\n= \t\r ]")}) {
    const Finished f = integrators({"integrate", "--equation", text, "--initial", "x=1", "--until", "1"});
    EXPECT_EQ(f.exit_code, 2) << f.errors;
    EXPECT_EQ(f.output, "");
    EXPECT_LT(f.errors.size(), 2000U);
    for (const char c : f.errors) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 32) << int{c};
  }
}

}  // namespace
}  // namespace nlmech::integrators_commands_test
