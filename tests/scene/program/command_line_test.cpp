/// Exit codes and words of the command line that all chapters share.
#include <algorithm>
#include <sstream>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/support/echo.hpp"
#include "tests/places.hpp"
#include "tests/scene/fixture_program.hpp"

namespace nlmech::tests::command_line_test {
namespace {

using CommandLine = FixtureProgram;

TEST_F(CommandLine, ListsScenesWithTheirRuns) {
  const Finished list = fixture({"list", "--csv"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_EQ(list.errors, "");
  const auto rows = scene::parse_csv(list.output, "list");
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0].cells, (std::vector<std::string>{"scene", "place", "title", "runs"}));
  EXPECT_EQ(rows[3].cells,
            (std::vector<std::string>{"table-1", "Table 1", "Two runs in one table, \"quoted\", with a comma",
                                      "alone squared"}));
  const Finished page = fixture({"list"});
  EXPECT_TRUE(page.output.starts_with("A chapter about nothing\n\n| scene |")) << page.output;
  EXPECT_TRUE(written().empty()) << "a list computes nothing";
}

TEST_F(CommandLine, HelpsAndTellsItsVersion) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"run", "--help"}, {"check", "--help"}}) {
    const Finished help = fixture(arguments);
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("Usage: "), std::string::npos);
    EXPECT_EQ(help.errors, "");
  }
  EXPECT_TRUE(fixture({"--version"}).output.starts_with("nlmech "));
  EXPECT_TRUE(fixture({"--manual"}).output.starts_with(".TH FIXTURE 1 "));
  EXPECT_TRUE(fixture({"--completion"}).output.ends_with(" fixture\n"));
}

TEST_F(CommandLine, EndsWithTwoAtWrongUse) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{}, "subcommand is required"},
      {{"sing"}, "subcommand is required"},
      {{"run"}, "name scenes, or say --all"},
      {{"run", "fig-9"}, "fixture has no scene 'fig-9'; it has fig-1, fig-2, table-1, both, fig-3.14"},
      {{"run", "fig-1", "fig-9"}, "no scene 'fig-9'"},
      {{"run", "--fast", "fig-1"}, "--fast"},
      {{"run", "fig-1", "--out"}, "--out"},
      {{"list", "fig-1"}, "fig-1"},
      {{"check", "--png"}, "--png"},
      {{"run", "fig-1", "--no-plots", "--png"}, "--png draws what --no-plots leaves out"},
      {{"run", "fig-1", "--out", "a", "--out", "b"}, "--out: At Most 1 required but received 2"},
      {{"run", "fig-1", "--quick", "--quick"}, "--quick: At Most 1 required but received 2"},
      {{"run", "fig-1", "--out", ""}, "--out: an empty text"},
      {{"run", ""}, "scenes: an empty text"},
      {{"double", "none.csv"}, "none.csv: No such file or directory"},
      {{"double", "."}, "is a folder"}};
  for (const auto& [arguments, said] : wrong) {
    const Finished done = fixture(arguments);
    EXPECT_EQ(done.exit_code, 2) << said;
    EXPECT_EQ(done.output, "") << said;
    expect_sentence(done.errors, said);
  }
  EXPECT_TRUE(written().empty()) << "nothing is computed before all scenes are known";
}

TEST_F(CommandLine, TheEnvironmentHoldsKernelsToAnInstructionSet) {
  const auto chosen = [this](const std::string& text) {
    EXPECT_EQ(fixture({"run", "fig-1"}, {"NLMECH_INSTRUCTION_SET=" + text}).exit_code, 0) << text;
    const std::string provenance = written().at("results/fixture/fig-1.json"),
                      key = "\"instruction_set\": \"";
    const auto at = provenance.find(key) + key.size();
    return provenance.substr(at, provenance.find('"', at) - at);
  };
  EXPECT_EQ(chosen("baseline"), "baseline");
  const std::string largest = chosen("");  // as if it were not set
  EXPECT_EQ(chosen(largest), largest);
  for (const std::string wrong : {"sse9", "AVX2", "avx2 ", "\x1b[31m"}) {
    const Finished done = fixture({"list"}, {"NLMECH_INSTRUCTION_SET=" + wrong});
    EXPECT_EQ(done.exit_code, 2) << wrong;
    EXPECT_EQ(done.output, "") << wrong;
    expect_sentence(done.errors, "NLMECH_INSTRUCTION_SET=" + echoed(wrong));
    EXPECT_TRUE(done.errors.ends_with(largest + "\n")) << done.errors;
  }
}

TEST_F(CommandLine, AFlagThatIsFalseIsAsWithoutIt) {
  EXPECT_EQ(fixture({"run", "fig-1", "--no-plots=false", "--quiet=false"}).output,
            fixture({"run", "fig-1"}).output);
  EXPECT_EQ(fixture({"run", "fig-1", "--no-plots=maybe"}).exit_code, 2);
}

TEST_F(CommandLine, HelpShowsKindsAndDefaults) {
  const std::string help = fixture({"double", "--help"}).output;
  EXPECT_NE(help.find("file TEXT=-"), std::string::npos) << help;
  EXPECT_NE(help.find("--limit NUMBER=60"), std::string::npos) << help;
}

TEST_F(CommandLine, WorksOnTheUsersOwnNumbers) {
  const Finished done = shell("printf 'x\\n0.1\\n+2\\n' | $fixture double -");
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.output, "x\n0.20000000000000001\n4\n");
  EXPECT_EQ(done.errors, "");
}

TEST_F(CommandLine, NamesTheCellOfBadInput) {
  const Finished done = shell("printf '1\\n\\ntwo\\n' | $fixture double");
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_EQ(done.output, "") << "nothing is printed once an error is found";
  EXPECT_EQ(done.errors, "fixture: standard input: line 3, column 1 (x): 'two' is not a finite number\n");
}

TEST_F(CommandLine, EndsWithOneWhenAComputationFails) {
  const Finished done = shell("printf '1\\n-1\\n' | $fixture double");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.output, "");
  EXPECT_EQ(done.errors, "fixture: outside_validity: double: a negative number; give its magnitude\n");
}

TEST_F(CommandLine, SaysThatStandardInputCannotBeRead) {
  const Finished done = shell("$fixture double < .");
  EXPECT_EQ(done.exit_code, 2);
  expect_sentence(done.errors, "standard input: ");
}

// A full disk behind standard output.
TEST_F(CommandLine, SaysThatStandardOutputIsFull) {
  for (const char* command :
       {"$fixture list", "$fixture list --csv", "$fixture check", "echo 1 | $fixture double",
        "$fixture --help", "$fixture run --help", "$fixture --version"}) {
    const Finished done = shell(std::string(command) + " > /dev/full");
    EXPECT_EQ(done.exit_code, 1) << command;
    expect_sentence(done.errors, "standard output: cannot be written: No space left on device");
  }
}

TEST_F(CommandLine, SurvivesClosedStreams) {
  const Finished no_output = shell("$fixture list >&-");
  EXPECT_EQ(no_output.exit_code, 1);
  expect_sentence(no_output.errors, "standard output: cannot be written: Bad file descriptor");
  EXPECT_EQ(shell("$fixture run fig-1 --quiet >&- 2>&- <&-").exit_code, 0);
  EXPECT_EQ(written().size(), 4U) << "gnuplot draws with all three streams closed";
  EXPECT_EQ(shell("$fixture run both >&- 2>&- <&-").exit_code, 1) << "nobody was told";
  EXPECT_EQ(written().size(), 10U);
}

TEST_F(CommandLine, IsSilentInAPipe) {
  const Finished done = fixture({"run", "--all", "--quick", "--quiet"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.output, "");
  EXPECT_EQ(done.errors, "");
}

TEST_F(CommandLine, NamesTheFilesOfARun) {
  const Finished done = fixture({"run", "--all", "--quick", "--out", "a"});
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_EQ(done.errors, "");
  std::vector<std::string> lines;
  std::istringstream text(done.output);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  std::vector<std::string> files;
  for (const auto& [name, bytes] : written("a")) files.push_back(name);
  EXPECT_EQ(lines, files);
  EXPECT_EQ(fixture({"run", "--all", "--quick", "--out", "a"}).output, done.output)
      << "unchanged files are named too";
}

TEST_F(CommandLine, ListsInAlignedColumnsOnATerminal) {
  for (const std::size_t columns : {50U, 80U, 200U}) {
    const Finished list =
        shell("COLUMNS=" + std::to_string(columns) + " script -qec '$fixture list' /dev/null");
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_EQ(list.output.find('|'), std::string::npos) << list.output;
    std::istringstream text(list.output);
    for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), columns + 1) << line;  // and CR
  }
}

// A token of ten million bytes, and one that would clear the screen.
TEST_F(CommandLine, EchoesLittleOfWhatWasTyped) {
  const std::vector<std::string> commands = {
      "head -c 10000000 /dev/zero | tr '\\0' 1 | tr -d '\\n' | $fixture double",
      "$fixture run \"$(head -c 100000 /dev/zero | tr '\\0' a)\"",
      "$fixture run fig-1 --$(head -c 100000 /dev/zero | tr '\\0' a)",
      "$fixture double \"$(head -c 100000 /dev/zero | tr '\\0' a)\"",
      "$fixture list $(seq 1 20000)",
      "$fixture run fig-1 --quick=$(head -c 100000 /dev/zero | tr '\\0' a)",
      "printf '\\033[2J\\033]0;title\\007\\n' | $fixture double",
      "$fixture run \"$(printf '\\033[2J')\"",
      "$fixture \"$(printf '\\033[2J')\"",
      "$fixture double \"$(printf '\\033[2J')\"",
      "$fixture spin --limit \"$(printf '\\033[2J')\""};
  for (const std::string& command : commands) {
    const Finished done = shell(command);
    EXPECT_EQ(done.exit_code, 2) << command;
    EXPECT_EQ(done.output, "") << command;
    EXPECT_LT(done.errors.size(), 1000U) << command;
    EXPECT_EQ(done.errors.find_first_of("\x1b\x07"), std::string::npos) << command;
    EXPECT_GT(done.errors.size(), 10U) << command;
  }
}

/// The data of the fixture with other published values.
std::filesystem::path data_with(const TemporaryFolder& folder, const std::string& published) {
  std::filesystem::copy(NLMECH_SOURCE_DIR "/tests/scene/fixture/data", folder.path(),
                        std::filesystem::copy_options::recursive);
  put(folder / "tables/published/made-up.csv", published);
  return folder.path();
}

TEST_F(CommandLine, ChecksEndWithZeroWhenAllPromisesAreKept) {
  const Finished check = fixture({"check"});
  EXPECT_EQ(check.exit_code, 0) << check.errors;
  EXPECT_EQ(check.errors, "");
  EXPECT_EQ(check.output,
            "       made-up/table-1/nominal/reproduced: published 2, nominal 2: reproduced\n"
            "       made-up/table-1/inferred/reproduced (inferred): published 3, nominal 5, inferred 3.2: "
            "reproduced, "
            "inferred reading [twice the load (3 tried; explains 1 of 1 rows)]\n"
            "       made-up/table-1/smaller/better: published 1e-3, nominal 1.2e-6: better\n"
            "       made-up/table-1/other/differs: published 1.0, nominal 4: differs [a misprint]\n"
            "       made-up/table-1/start; guess, \"seed\" #1/not stated: published 7: not stated [the start "
            "is not stated]\n"
            "       made-up/table-1/old machine/context: published 0.23: context [measured elsewhere]\n"
            "       made-up/table-1/load/input: published 9.81, nominal 9.81: input\n"
            "5 quantities of 5 scenes: 5 pass, 0 fail\n");
  EXPECT_EQ(written().size(), 1U);
  EXPECT_TRUE(written().contains("results/fixture/check.csv"));
}

TEST_F(CommandLine, ChecksEndWithOneWhenValuesAreMissed) {
  const TemporaryFolder data;
  data_ = data_with(data, bytes_of(NLMECH_SOURCE_DIR "/tests/scene/fixture/missed.csv"));
  const Finished check = fixture({"check"});
  EXPECT_EQ(check.exit_code, 1);
  for (const char* line :
       {"FAILS made-up/table-1/nominal/reproduced: published 20, nominal 2: differs (FAILS: expected "
        "reproduced)",
        "FAILS made-up/table-1/inferred/reproduced (inferred): published 3, nominal 5, inferred 3.2: ",
        "FAILS made-up/table-1/smaller/better: published 1e-9, nominal 1.2e-6: differs (FAILS: expected "
        "better)",
        "FAILS made-up/table-1/other/differs: published 4, nominal 4: reproduced (FAILS: expected differs) "
        "[a misprint]",
        "FAILS made-up/table-1/load/input: published 9.8, nominal 9.81: reproduced (FAILS: expected input)",
        "       made-up/table-1/old machine/context: published 0.23: context"}) {
    EXPECT_NE(check.output.find(line), std::string::npos) << line << "\n\n" << check.output;
  }
  EXPECT_TRUE(written().contains("results/fixture/check.csv")) << "the report needs it, misses or not";
}

TEST_F(CommandLine, ChecksEndWithOneWhenAQuantityIsMissed) {
  const Finished check = fixture({"check"}, {"FIXTURE_FAULT=quantity"});
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.output.find("5 quantities of 5 scenes: 0 pass, 5 fail\n"), std::string::npos)
      << check.output;
  EXPECT_NE(check.errors.find("FAILS table-1: first value = 3 1, allowed 2 to 2 (counted by hand)\n"),
            std::string::npos)
      << check.errors;
  EXPECT_TRUE(written().contains("results/fixture/check.csv"));
}

TEST_F(CommandLine, RefusesBadFilesOfPublishedValues) {
  const TemporaryFolder data;
  data_ = data_with(data, "place,row\n1,2\n");
  const Finished check = fixture({"check"});
  EXPECT_EQ(check.exit_code, 2);
  expect_sentence(check.errors, "made-up.csv: line 2: 2 of 15 cells");
  data_ = "/nowhere/at/all";
  EXPECT_EQ(fixture({"check"}).exit_code, 2);
}

}  // namespace
}  // namespace nlmech::tests::command_line_test
