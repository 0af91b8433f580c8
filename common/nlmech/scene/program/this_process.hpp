/// @file
/// What a process has only one of: its standard streams, what it leaves lying about while it works, and its
/// end. A time limit ends the process from a thread of its own (time_limit.hpp); what is to be in order then
/// is kept here.
#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <string_view>

namespace nlmech::scene {

/// How a process ends that does not succeed.
struct ExitCode {
  static constexpr int failed = 1;       ///< a computation, a check or a time limit
  static constexpr int wrong_usage = 2;  ///< of the command line, or input that cannot be used
};

/// While one lives, no other thread ends the process: for a short act that is done whole or not at all (a
/// result printed, a file renamed, a child started and noted). Acts do not nest.
class CriticalSection {
 public:
  CriticalSection();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Something that is to be cleared away if the process is ended early: a temporary file, a child. Made and
/// given up within a CriticalSection, so that it is noted exactly as long as it is there.
class CleanupOnExit {
 public:
  /// @param clear removes it; called at most once, by the thread that ends the process
  CleanupOnExit(const CriticalSection& /*act*/, std::function<void()> clear);
  CleanupOnExit(const CleanupOnExit&) = delete;
  CleanupOnExit& operator=(const CleanupOnExit&) = delete;
  /// It is gone, or in its place.
  void gone(const CriticalSection& act);

 private:
  std::list<std::function<void()>>::iterator place_;
};

/// What the process is doing, in words for its user, until this goes: "reading standard input".
class ProgressScope {
 public:
  /// @param what instead of what was said before, which holds again afterwards
  /// @param silent no progress is shown meanwhile: the user is typing on the same terminal
  explicit ProgressScope(std::string what, bool silent = false);
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
  ~ProgressScope();

 private:
  std::string before_;
  bool silent_before_;
};

/// What is being done now; "computing" if nobody has said.
[[nodiscard]] std::string doing_now();

/// Writes a result to standard output, whole. @throws Failure if it could not be written (a full disk, a
/// closed pipe)
void print_result(std::string_view text);

/// print_result() of all that is left to print: no limit of time ends the process from then on.
void print_last_result(std::string_view text);

/// Writes a message to standard error: printable_message(), and a line end if it has none. A line of progress
/// is wiped away first.
void print_message(std::string_view message);

/// Shows one line of progress on standard error in place of the last one, unless something is being printed
/// or the user is typing. To be called for terminals only.
void show_progress(std::string_view line);

/// Wipes the line of progress away, if there is one.
void wipe_progress();

/// Waits for the act under way, clears all traces away, says @p message and ends the process: at once, with
/// no destructor run, since other threads are still at work. Returns only if that act was
/// print_last_result().
void end_process(int exit_code, std::string_view message);

}  // namespace nlmech::scene
