#include "nlmech/scene/program/time_limit.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "nlmech/scene/program/this_process.hpp"

namespace nlmech::scene {
namespace {

using Clock = std::chrono::steady_clock;

Clock::time_point later(Clock::time_point from, double seconds) {
  constexpr double longest = 1e9;  // 30 years: more does not fit the clock
  return from + std::chrono::duration_cast<Clock::duration>(
                    std::chrono::duration<double>(std::min(seconds, longest)));
}

/// Sleeps until a time or until the command has ended.
class Sleep {
 public:
  explicit Sleep(std::stop_token stop) : stop_(std::move(stop)) {}
  /// Sleeps; true if the time was reached, false if the command has ended.
  bool until(Clock::time_point moment) {
    std::unique_lock lock(mutex_);
    condition_.wait_until(lock, stop_, moment, [] { return false; });
    return !stop_.stop_requested();
  }

 private:
  std::stop_token stop_;
  std::mutex mutex_;
  std::condition_variable_any condition_;
};

std::string progress(const TimeLimit::Command& command, Clock::duration since) {
  std::string line = fmt::format("{} {}: {}, {} s", command.program, command.name, doing_now(),
                                 std::chrono::duration_cast<std::chrono::seconds>(since).count());
  if (command.seconds) line += fmt::format(" (--limit {:g})", *command.seconds);
  return line;
}

std::string sentence(const TimeLimit::Command& command) {
  return fmt::format(
      "{}: time_limit: {}: not done within --limit {:g} s (it was {}); give a larger --limit, or ask for "
      "less",
      command.program, command.name, *command.seconds, doing_now());
}

// A thread ends the process, because checks inside loops do not cover every case: a loop without a check, a
// call of a library or a wait for standard input would exceed the limit.
void watch(const std::stop_token& stop, const TimeLimit::Command& command, Clock::time_point start) {
  using namespace std::chrono_literals;
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  const Clock::time_point end =
      command.seconds ? later(start, *command.seconds + command.grace) : Clock::time_point::max();
  Clock::time_point next = terminal ? later(start, command.silence) : Clock::time_point::max();
  Sleep sleep(stop);
  while (sleep.until(std::min(next, end))) {
    const Clock::time_point now = Clock::now();
    if (now >= end) {
      // sentence() waits for the current critical section, which may be the last one of the command.
      const std::string said = sentence(command);
      if (sleep.until(Clock::now() + 50ms)) end_process(ExitCode::failed, said);
      return;
    }
    show_progress(progress(command, now - start));
    next += 1s;
  }
}

}  // namespace

TimeLimit::TimeLimit(Command command) {
  if (!command.seconds && ::isatty(STDERR_FILENO) != 1) return;
  watch_ = std::jthread([command = std::move(command), start = Clock::now()](const std::stop_token& stop) {
    watch(stop, command, start);
    wipe_progress();
  });
}

}  // namespace nlmech::scene
