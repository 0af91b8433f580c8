/// @file
/// State of the process: standard streams, cleanup and exit. The thread of a time limit may end the process
/// (time_limit.hpp); critical sections and cleanups keep files and child processes consistent then.
#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <string_view>

namespace nlmech::scene {

/// Exit codes of failures.
struct ExitCode {
  static constexpr int failed = 1;       ///< failed computation or check, or exceeded time limit
  static constexpr int wrong_usage = 2;  ///< wrong command line, or invalid input
};

/// Scope in which no other thread ends the process, for short operations that must not be interrupted: to
/// print a result, to rename a file, to start and register a child. Critical sections do not nest.
class CriticalSection {
 public:
  CriticalSection();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Registered cleanup of a temporary file or a child, for an early end of the process. It is registered and
/// unregistered within a CriticalSection, so that it exists exactly as long as its object.
class CleanupOnExit {
 public:
  /// @param clear removes the object; called at most once, by the thread that ends the process
  CleanupOnExit(const CriticalSection& /*section*/, std::function<void()> clear);
  CleanupOnExit(const CleanupOnExit&) = delete;
  CleanupOnExit& operator=(const CleanupOnExit&) = delete;
  /// Unregisters the cleanup: the object is removed or has its final place.
  void dismiss(const CriticalSection& section);

 private:
  std::list<std::function<void()>>::iterator place_;
};

/// Scope of an activity of the process for progress messages: "reading standard input".
class ProgressScope {
 public:
  /// @param what text that replaces the previous one until the destructor restores it
  /// @param silent shows no progress meanwhile, because the user is typing on the same terminal
  explicit ProgressScope(std::string what, bool silent = false);
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
  ~ProgressScope();

 private:
  std::string before_;
  bool silent_before_;
};

/// Current activity of the process; "computing" by default.
[[nodiscard]] std::string doing_now();

/// Writes a complete result to standard output. @throws Failure if it could not be written (a full disk, a
/// closed pipe)
void print_result(std::string_view text);

/// print_result() of the last result: no time limit ends the process after it.
void print_last_result(std::string_view text);

/// Writes printable_message() to standard error, with a line end if it has none. It removes a progress line
/// first.
void print_message(std::string_view message);

/// Replaces the progress line on standard error, unless something is being printed or the user is typing.
/// Call it only for terminals.
void show_progress(std::string_view line);

/// Removes the progress line, if there is one.
void wipe_progress();

/// Waits for the current CriticalSection, runs all cleanups, prints @p message and ends the process without
/// destructors, because other threads are still running. Returns only if that section was
/// print_last_result().
void end_process(int exit_code, std::string_view message);

}  // namespace nlmech::scene
