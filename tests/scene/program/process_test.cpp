/// Processes: programs that are run, the end of this program, and shared use of the machine's processors.
#include "nlmech/scene/program/process.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "nlmech/scene/program/machine.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/time_limit.hpp"
#include "nlmech/scene/scene.hpp"
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
  ::setenv("NLMECH_TEST", "outer", 1);
  EXPECT_EQ(run_program({"sh", "-c", "echo $NLMECH_TEST"}, {}, {"NLMECH_TEST=inner"}).output, "inner\n");
  EXPECT_EQ(shell("echo $NLMECH_TEST").output, "outer\n");
  ::unsetenv("NLMECH_TEST");
}

TEST(RunProgram, GivesItAnEmptyStandardInput) { EXPECT_EQ(run_program({"wc", "-c"}, {}).output, "0\n"); }

TEST(RunProgram, NamesTheProgramThatMayNotRun) {
  const TemporaryFolder folder;
  tests::put(folder / "text", "not a program");
  EXPECT_THROW((void)run_program({(folder / "text").string()}, {}), Failure);
}

// A pipe holds 64 KiB: a reader that reads the pipes one after the other would block for ever.
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

// A process inherits an ignored SIGCHLD: the system then discards the exit code, which must not count as 0.
TEST(RunProgram, DoesNotTakeALostExitCodeForSuccess) {
  ASSERT_NE(::signal(SIGCHLD, SIG_IGN), SIG_ERR);
  EXPECT_THROW((void)shell("exit 3"), Failure);
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
    EXPECT_THROW((void)run_program({"no-such-program-at-all"}, {}), Failure);
  }
  EXPECT_EQ(open(), before);
}

namespace fs = std::filesystem;
using tests::put;

TEST(ThisProcess, ClearsItsTracesAwayAtItsEnd) {
  const TemporaryFolder folder;
  const fs::path left = folder / "left", gone = folder / "gone";
  put(left, "half of a");
  put(gone, "whole");
  const auto end = [&] {
    {
      const CriticalSection section;
      static CleanupOnExit half(section, [&] { fs::remove(left); });
      static CleanupOnExit whole(section, [&] { fs::remove(gone); });
      whole.dismiss(section);
    }
    end_process(3, "no more\x1b[31m time");
  };
  EXPECT_EXIT(end(), ::testing::ExitedWithCode(3), "no more.x1b.31m time");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(gone)) << "its trace was given up";
}

// end_process() waits for the end of the critical section.
TEST(ThisProcess, FinishesTheActUnderWay) {
  const auto end = [] {
    auto section = std::make_unique<CriticalSection>();
    const std::jthread ender([] { end_process(3, "over"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::fputs("whole ", stderr);
    section.reset();
    std::this_thread::sleep_for(std::chrono::seconds(100));
  };
  EXPECT_EXIT(end(), ::testing::ExitedWithCode(3), "whole over");
}

TEST(ThisProcess, IsNotEndedBehindItsLastResult) {
  const auto end = [] {
    print_last_result("");
    end_process(3, "over");
    std::_Exit(0);
  };
  EXPECT_EXIT(end(), ::testing::ExitedWithCode(0), "^$");
}

TEST(ThisProcess, SaysWhatItIsDoing) {
  EXPECT_EQ(doing_now(), "computing");
  {
    const ProgressScope outer("drawing");
    {
      const ProgressScope inner("reading");
      EXPECT_EQ(doing_now(), "reading");
    }
    EXPECT_EQ(doing_now(), "drawing");
  }
  EXPECT_EQ(doing_now(), "computing");
}

/// Redirects standard error to a terminal during its lifetime.
class ErrorsOnATerminal {
 public:
  ErrorsOnATerminal() : before_(::dup(STDERR_FILENO)) {
    int slave = -1;
    EXPECT_EQ(::openpty(&master_, &slave, nullptr, nullptr, nullptr), 0);
    ::dup2(slave, STDERR_FILENO);
    ::close(slave);
  }
  ErrorsOnATerminal(const ErrorsOnATerminal&) = delete;
  ErrorsOnATerminal& operator=(const ErrorsOnATerminal&) = delete;
  ~ErrorsOnATerminal() { static_cast<void>(shown()); }
  /// @returns the output, and restores standard error.
  std::string shown() {
    if (before_ < 0) return "";
    ::dup2(before_, STDERR_FILENO);
    ::close(std::exchange(before_, -1));
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = ::read(master_, buffer.data(), buffer.size())) > 0;)
      text.append(buffer.data(), static_cast<std::size_t>(n));
    ::close(master_);
    return text;
  }

 private:
  int before_ = -1, master_ = -1;
};

TEST(TimeLimit, ShowsProgressOnATerminalAndWipesItAway) {
  ErrorsOnATerminal terminal;
  {
    const ProgressScope doing("looking for poles");
    const TimeLimit limit({"gss_control", "poles", 50., 0, 0.01});
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_EQ(terminal.shown(), "\r\x1b[Kgss_control poles: looking for poles, 0 s (--limit 50)\r\x1b[K");
}

TEST(TimeLimit, IsSilentBeforeAndInAPipeAndWhileTheUserTypes) {
  ErrorsOnATerminal terminal;
  {
    const ProgressScope typing("reading standard input", true);
    const TimeLimit limit({"gss_control", "poles", 50., 0, 0.01});
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  { const TimeLimit limit({"gss_control", "poles", 50.}); }
  EXPECT_EQ(terminal.shown(), "");
  ::testing::internal::CaptureStderr();
  {
    const TimeLimit limit({"gss_control", "poles", 50., 0, 0.01});
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

/// A lock file for the test, and another program that reports its end in a file.
class TheMachine : public ::testing::Test {
 protected:
  /// Starts the other program, which acquires by @p hold and continues for @p time; returns once it has
  /// acquired.
  pid_t other(const std::function<void(const std::function<void()>&)>& hold,
              std::chrono::milliseconds time = std::chrono::milliseconds(200)) const {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child == 0) {
      hold([&] {
        static_cast<void>(::write(pipe[1], "x", 1) + 1);
        std::this_thread::sleep_for(time);
        tests::put(folder_ / "ended", "");
      });
      ::_exit(0);
    }
    char holds = 0;
    EXPECT_EQ(::read(pipe[0], &holds, 1), 1);
    for (const int end : pipe) ::close(end);
    return child;
  }
  [[nodiscard]] bool other_ended() const { return std::filesystem::exists(folder_ / "ended"); }

  TemporaryFolder folder_;
  tests::TemporaryFilesIn there_{folder_.path()};
};

TEST_F(TheMachine, LetsAProgramComputeForEachProcessor) {
  const pid_t child = other(
      [](const auto& compute) {
        Machine machine(2);
        const Machine::Processor processor(machine);
        compute();
      },
      std::chrono::seconds(30));  // longer than any pause of this program on a busy machine
  Machine machine(2);
  const Machine::Processor processor(machine);
  EXPECT_FALSE(other_ended()) << "the second processor is free";
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST_F(TheMachine, LetsNoMoreProgramsComputeThanItHasProcessorsUntilOneEndsOrDies) {
  for (const bool dies : {false, true}) {
    std::filesystem::remove(folder_ / "ended");
    const pid_t child = other([dies](const auto& compute) {
      Machine machine(1);
      const Machine::Processor processor(machine);
      compute();
      if (dies) ::_exit(1);  // no destructor runs
    });
    Machine machine(1);
    const Machine::Processor processor(machine);
    EXPECT_TRUE(other_ended()) << dies;
    ::waitpid(child, nullptr, 0);
  }
}

// A waiting child gets the machine before the next scene of the parent.
TEST_F(TheMachine, IsTakenInTurn) {
  Machine machine(1);
  std::optional<Machine::Processor> processor(machine);
  const pid_t child = ::fork();
  if (child == 0) {
    Machine its(1);
    const Machine::Processor waits(its);
    tests::put(folder_ / "ended", "");
    ::_exit(0);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(other_ended());
  processor.reset();
  processor.emplace(machine);
  EXPECT_TRUE(other_ended());
  ::waitpid(child, nullptr, 0);
}

// A waiting program gets the first processor as soon as the other program has few scenes left.
TEST_F(TheMachine, IsKeptWithManyScenesLeft) {
  Results results(false);
  results.wait_for_processor(100);
  const pid_t child = ::fork();
  if (child == 0) {
    Machine its(1);
    const Machine::Processor waits(its);
    ::_exit(0);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  results.wait_for_processor(100);
  EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << "still waits";
  results.wait_for_processor(1);
  EXPECT_EQ(::waitpid(child, nullptr, 0), child);
}

TEST_F(TheMachine, IsNotWaitedForWhereThereIsNoFolder) {
  const tests::TemporaryFilesIn absent(folder_ / "absent");
  Machine machine(1), beside(1);
  const Machine::Processor processor(machine), second(beside);
  SUCCEED();
}

}  // namespace
}  // namespace nlmech::scene::process_test
