/// Every command has a limit of wall time, and leaves all in order when it is reached. No time is asserted: a
/// limit that did not hold would leave these tests without an end.
#include <csignal>
#include <sstream>

#include "tests/places.hpp"
#include "tests/scene/fixture_program.hpp"

namespace nlmech::tests::limits_test {
namespace {

namespace fs = std::filesystem;

using Limits = FixtureProgram;

TEST_F(Limits, EndWhatIsNeverDone) {
  const Finished done = fixture({"spin", "--limit", "0.1"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.output, "");
  EXPECT_EQ(
      done.errors,
      "fixture: time_limit: spin: not done within --limit 0.1 s (it was computing); give a larger --limit, "
      "or ask for less\n");
}

TEST_F(Limits, AreKeptByEveryCommandAndNamedInItsHelp) {
  for (const char* command : {"list", "run", "check", "double", "spin", "heed"})
    EXPECT_NE(fixture({command, "--help"}).output.find("--limit"), std::string::npos) << command;
  EXPECT_NE(fixture({"spin", "--help"}).output.find("=60"), std::string::npos);
  EXPECT_EQ(fixture({"run", "--help"}).output.find("=60"), std::string::npos) << "scenes may take long";
}

TEST_F(Limits, ArePositiveNumbers) {
  for (const char* limit : {"0", "-1", "nan", "soon", "1e999"}) {
    const Finished done = fixture({"spin", "--limit", limit});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(done.output, "");
    expect_sentence(done.errors, std::string("--limit ") + limit);
  }
  EXPECT_EQ(shell("echo 1 | $fixture double --limit 1e300").exit_code, 0);
}

TEST_F(Limits, HoldWhileStandardInputHasNoEnd) {
  const Finished done = shell("mkfifo never; exec 3<>never; $fixture double --limit 1 <&3");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.output, "");
  expect_sentence(done.errors, "double: not done within --limit 1 s (it was reading standard input)");
}

TEST_F(Limits, LeaveTheLastWordToACommandThatHeedsThem) {
  const Finished done = fixture({"heed", "--limit", "0.1"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.errors, "fixture: time_limit: heed: at step 17 of 20; take longer steps\n");
  const Finished deaf = fixture({"heed", "deaf", "--limit", "0.1"});
  EXPECT_EQ(deaf.exit_code, 1);
  expect_sentence(deaf.errors, "heed: not done within --limit 0.1 s");
}

// The reader of a result may take as long as it likes; what it gets is whole.
TEST_F(Limits, DoNotCutAResultThatIsBeingPrinted) {
  const Finished done = shell("{ $fixture flood --limit 0.1; echo $? >&2; } | { sleep 0.4; wc -c; }");
  EXPECT_EQ(done.output, "1000001\n");
  EXPECT_EQ(done.errors, "0\n");
}

TEST_F(Limits, KeepTheScenesThatAreDone) {
  const Finished done =
      fixture({"run", "fig-1", "fig-2", "--no-plots", "--limit", "3"}, {"FIXTURE_FAULT=endless"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.output, "results/fixture/fig-1.csv\nresults/fixture/fig-1.gp\nresults/fixture/fig-1.json\n");
  expect_sentence(done.errors, "run: not done within --limit 3 s (it was computing fig-2)");
  const auto files = written();
  EXPECT_EQ(files.size(), 3U) << "something is half written";
}

TEST_F(Limits, EndGnuplotToo) {
  const fs::path program = folder_ / "bin/gnuplot";
  put(program, "#!/bin/sh\necho $$ > " + (folder_ / "child").string() + "\nexec sleep 1000\n");
  fs::permissions(program, fs::perms::owner_all);
  const Finished done =
      shell("PATH=" + program.parent_path().string() + ":$PATH $fixture run fig-1 --limit 3");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(done.output, "");
  expect_sentence(done.errors, "not done within");
  pid_t child = 0;
  std::istringstream(bytes_of(folder_ / "child")) >> child;
  ASSERT_GT(child, 1);
  // Gone, or about to be: SIGKILL was sent before the program ended.
  const std::string state = shell("sleep 0.1; cat /proc/" + std::to_string(child) + "/stat 2>&1").output;
  EXPECT_TRUE(state.find("No such file") != std::string::npos || state.find(") Z") != std::string::npos)
      << state;
}

TEST_F(Limits, LeaveExitCodesOfWhatEndsInTime) {
  EXPECT_EQ(shell("echo 1 | $fixture double --limit 50").output, "x\n2\n");
  EXPECT_EQ(shell("echo -1 | $fixture double --limit 50").exit_code, 1);
  EXPECT_EQ(shell("echo two | $fixture double --limit 50").exit_code, 2);
  EXPECT_EQ(fixture({"list", "--limit", "50"}).exit_code, 0);
}

}  // namespace
}  // namespace nlmech::tests::limits_test
