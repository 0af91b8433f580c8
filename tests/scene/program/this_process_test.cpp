#include "nlmech/scene/program/this_process.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "nlmech/scene/program/time_limit.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::scene::this_process_test {
namespace {

namespace fs = std::filesystem;
using tests::put;
using tests::TemporaryFolder;

TEST(ThisProcess, ClearsItsTracesAwayAtItsEnd) {
  const TemporaryFolder folder;
  const fs::path left = folder / "left", gone = folder / "gone";
  put(left, "half of a");
  put(gone, "whole");
  const auto end = [&] {
    {
      const WholeAct act;
      static Trace half(act, [&] { fs::remove(left); });
      static Trace whole(act, [&] { fs::remove(gone); });
      whole.gone(act);
    }
    end_process(3, "no more\x1b[31m time");
  };
  EXPECT_EXIT(end(), ::testing::ExitedWithCode(3), "no more.x1b.31m time");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(gone)) << "its trace was given up";
}

// The act ends the test with 5 if it was cut short.
TEST(ThisProcess, FinishesTheActUnderWay) {
  const auto end = [] {
    auto act = std::make_unique<WholeAct>();
    const std::jthread ender([] { end_process(3, "over"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::fputs("whole ", stderr);
    act.reset();
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
    const Doing outer("drawing");
    {
      const Doing inner("reading");
      EXPECT_EQ(doing_now(), "reading");
    }
    EXPECT_EQ(doing_now(), "drawing");
  }
  EXPECT_EQ(doing_now(), "computing");
}

/// Standard error is a terminal as long as this lives.
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
  /// All that was written; from here on standard error is what it was before.
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
    const TimeLimit limit({"gss_control", "poles", 50., 0, 0.01});
    const Doing doing("looking for poles");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_EQ(terminal.shown(), "\r\x1b[Kgss_control poles: looking for poles, 0 s (--limit 50)\r\x1b[K");
}

TEST(TimeLimit, IsSilentBeforeAndInAPipeAndWhileTheUserTypes) {
  ErrorsOnATerminal terminal;
  {
    const Doing typing("reading standard input", true);
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

}  // namespace
}  // namespace nlmech::scene::this_process_test
