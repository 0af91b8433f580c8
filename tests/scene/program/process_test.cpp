#include "nlmech/scene/program/process.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::scene::process_test {
namespace {

using tests::TemporaryFolder;

Finished shell(const std::string& command) { return run_program({"sh", "-c", command}, {}); }

TEST(RunProgram, GivesOutputErrorsAndExitCode) {
  const Finished done = shell("echo out; echo err >&2; exit 3");
  EXPECT_EQ(done.output, "out\n");
  EXPECT_EQ(done.errors, "err\n");
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_EQ(shell("exit 0").exit_code, 0);
  EXPECT_EQ(shell("exit 255").exit_code, 255);
}

TEST(RunProgram, PassesArgumentsAsTheyAre) {
  const std::string hard = "a b;'\"$HOME`\\ *\n";
  EXPECT_EQ(run_program({"printf", "%s|%s", hard, ""}, {}).output, hard + "|");
}

TEST(RunProgram, RunsInTheFolder) {
  const TemporaryFolder folder;
  tests::put(folder / "mark", "here");
  EXPECT_EQ(run_program({"cat", "mark"}, folder.path()).output, "here");
}

TEST(RunProgram, SetsVariablesForTheProgramAlone) {
  ::unsetenv("NLMECH_TEST");
  EXPECT_EQ(run_program({"sh", "-c", "echo $NLMECH_TEST"}, {}, {"NLMECH_TEST=a b"}).output, "a b\n");
  EXPECT_EQ(shell("echo $NLMECH_TEST").output, "\n");
  ::setenv("NLMECH_TEST", "ours", 1);
  EXPECT_EQ(run_program({"sh", "-c", "echo $NLMECH_TEST"}, {}, {"NLMECH_TEST=theirs"}).output, "theirs\n");
  EXPECT_EQ(shell("echo $NLMECH_TEST").output, "ours\n");
  ::unsetenv("NLMECH_TEST");
}

TEST(RunProgram, GivesItAnEmptyStandardInput) { EXPECT_EQ(run_program({"wc", "-c"}, {}).output, "0\n"); }

TEST(RunProgram, NamesTheProgramThatIsMissing) {
  const TemporaryFolder folder;  // a closed folder in the reader's own PATH would change the reason
  const char* before = std::getenv("PATH");
  const std::string path = before == nullptr ? "" : before;
  ::setenv("PATH", folder.string().c_str(), 1);
  try {
    static_cast<void>(run_program({"no-such-program-at-all"}, {}));
    FAIL() << "a missing program was run";
  } catch (const Failure& failure) {
    EXPECT_STREQ(failure.what(), "no-such-program-at-all: cannot be started: No such file or directory");
  }
  ::setenv("PATH", path.c_str(), 1);
}

TEST(RunProgram, NamesTheProgramThatMayNotRun) {
  const TemporaryFolder folder;
  tests::put(folder / "text", "not a program");
  EXPECT_THROW(static_cast<void>(run_program({(folder / "text").string()}, {})), Failure);
}

// Each pipe holds 64 KiB: a reader that empties them one after the other would wait for ever.
TEST(RunProgram, ReadsMuchFromBothPipesAtOnce) {
  const Finished done = shell(
      "i=0; while [ $i -lt 40 ]; do head -c 50000 /dev/zero; head -c 50000 /dev/zero >&2; i=$((i+1)); done");
  EXPECT_EQ(done.output.size(), 2'000'000U);
  EXPECT_EQ(done.errors.size(), 2'000'000U);
  EXPECT_EQ(done.exit_code, 0);
}

TEST(RunProgram, ReadsMuchFromEitherPipe) {
  EXPECT_EQ(shell("head -c 3000000 /dev/zero").output.size(), 3'000'000U);
  EXPECT_EQ(shell("head -c 3000000 /dev/zero >&2").errors.size(), 3'000'000U);
}

TEST(RunProgram, TellsASignalFromAnExit) {
  EXPECT_EQ(shell("kill -KILL $$").exit_code, 128 + SIGKILL);
  EXPECT_EQ(shell("kill -TERM $$").exit_code, 128 + SIGTERM);
}

// A parent that ignores SIGCHLD hands this down: the system then throws the exit code away, and it must not
// read as 0.
TEST(RunProgram, DoesNotTakeALostExitCodeForSuccess) {
  ASSERT_NE(::signal(SIGCHLD, SIG_IGN), SIG_ERR);
  EXPECT_THROW(static_cast<void>(shell("exit 3")), Failure);
  ASSERT_NE(::signal(SIGCHLD, SIG_DFL), SIG_ERR);
}

TEST(RunProgram, LeavesNoDescriptorsOpen) {
  const auto open = [] {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
      count += entry.exists() ? 1 : 0;
    return count;
  };
  const std::size_t before = open();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(shell("true").exit_code, 0);
    EXPECT_THROW(static_cast<void>(run_program({"no-such-program-at-all"}, {})), Failure);
  }
  EXPECT_EQ(open(), before);
}

}  // namespace
}  // namespace nlmech::scene::process_test
