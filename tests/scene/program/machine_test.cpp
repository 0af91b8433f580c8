#include "nlmech/scene/program/machine.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <thread>

#include "nlmech/scene/run.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::scene::machine_test {
namespace {

using tests::TemporaryFolder;

/// A lock of the test's own, and another program that leaves a file where it ends.
class TheMachine : public ::testing::Test {
 protected:
  /// Returns once @p hold has given the other program what it holds; that goes on for @p time.
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

TEST_F(TheMachine, LetsNoMoreProgramsComputeThanItHasProcessors) {
  const pid_t child = other([](const auto& compute) {
    Machine machine(1);
    const Machine::Processor processor(machine);
    compute();
  });
  Machine machine(1);
  const Machine::Processor processor(machine);
  EXPECT_TRUE(other_ended());
  ::waitpid(child, nullptr, 0);
}

TEST_F(TheMachine, IsGivenBackByAProgramThatDies) {
  const pid_t child = other([](const auto& compute) {
    Machine machine(1);
    const Machine::Processor processor(machine);
    compute();
    ::_exit(1);  // no destructor runs
  });
  Machine machine(1);
  const Machine::Processor processor(machine);
  EXPECT_TRUE(other_ended());
  ::waitpid(child, nullptr, 0);
}

// The child, once it waits, comes before the next scene of the parent.
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

// Who waits has the first processor as soon as the program that holds it has few scenes left.
TEST_F(TheMachine, IsKeptWithManyScenesLeft) {
  Results results(false);
  results.take_turn(100);
  const pid_t child = ::fork();
  if (child == 0) {
    Machine its(1);
    const Machine::Processor waits(its);
    ::_exit(0);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  results.take_turn(100);
  EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << "still waits";
  results.take_turn(1);
  EXPECT_EQ(::waitpid(child, nullptr, 0), child);
}

TEST_F(TheMachine, IsNotWaitedForWhereThereIsNoFolder) {
  const tests::TemporaryFilesIn absent(folder_ / "absent");
  Machine machine(1), beside(1);
  const Machine::Processor processor(machine), second(beside);
  SUCCEED();
}

}  // namespace
}  // namespace nlmech::scene::machine_test
