#include "nlmech/scene/machine.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "tests/scene/temporary_folder.hpp"

namespace nlmech::scene {
namespace {

using tests::TemporaryFolder;

/// A lock of the test's own, and another program that leaves a file where it ends.
class TheMachine : public ::testing::Test {
 protected:
  TheMachine() {
    if (const char* folder = std::getenv("TMPDIR")) before_ = folder;
    ::setenv("TMPDIR", folder_.string().c_str(), 1);
  }
  ~TheMachine() override {
    if (before_)
      ::setenv("TMPDIR", before_->c_str(), 1);
    else
      ::unsetenv("TMPDIR");
  }
  /// Returns once @p hold has given the other program what it holds; that goes on for a while.
  pid_t other(const std::function<void(const std::function<void()>&)>& hold) const {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child == 0) {
      hold([&] {
        static_cast<void>(::write(pipe[1], "x", 1) + 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
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
  std::optional<std::string> before_;
};

TEST_F(TheMachine, IsTakenWhenNoOtherProgramComputesAnyMore) {
  const pid_t child = other([](const auto& compute) {
    const Machine machine;
    compute();
  });
  Machine machine;
  EXPECT_FALSE(other_ended()) << "programs that take no times do not wait for each other";
  const Machine::Alone alone(machine);
  EXPECT_TRUE(other_ended());
  ::waitpid(child, nullptr, 0);
}

TEST_F(TheMachine, LetsNoOtherProgramBeginWhileItIsTaken) {
  const pid_t child = other([](const auto& compute) {
    Machine machine;
    const Machine::Alone alone(machine);
    compute();
  });
  const Machine machine;
  EXPECT_TRUE(other_ended());
  ::waitpid(child, nullptr, 0);
}

TEST_F(TheMachine, IsGivenBackByAProgramThatDies) {
  const pid_t child = other([](const auto& compute) {
    Machine machine;
    const Machine::Alone alone(machine);
    compute();
    ::_exit(1);  // no destructor runs
  });
  Machine machine;
  const Machine::Alone alone(machine);
  EXPECT_TRUE(other_ended());
  ::waitpid(child, nullptr, 0);
}

TEST_F(TheMachine, CanBeTakenTwiceByOneProgram) {
  Machine machine, beside;
  const Machine::Alone alone(machine);
  const Machine::Alone inner(machine);
  const Machine::Alone second(beside);
  SUCCEED() << "nothing waits for itself";
}

TEST_F(TheMachine, IsNotWaitedForWhereThereIsNoFolder) {
  ::setenv("TMPDIR", (folder_ / "absent").string().c_str(), 1);
  Machine machine;
  const Machine::Alone alone(machine);
  SUCCEED();
}

}  // namespace
}  // namespace nlmech::scene
