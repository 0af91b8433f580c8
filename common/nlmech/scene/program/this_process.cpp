#include "nlmech/scene/program/this_process.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech::scene {
namespace {

struct State {
  std::mutex mutex;
  std::list<std::function<void()>> cleanups;
  std::string doing = "computing";
  bool silent = false;
  bool progress_shown = false;
  bool done = false;  // the last result is printed
};

/// The one state of the process.
State& state() {
  static State one;
  return one;
}

constexpr std::string_view wipe = "\r\x1b[K";

/// Writes to standard error. A failure is ignored, because it cannot be reported.
void write_error(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
  static_cast<void>(std::fflush(stderr));
}

void clear_line_locked() {
  if (std::exchange(state().progress_shown, false)) write_error(wipe);
}

void print_locked(std::string_view text) {
  clear_line_locked();
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Failure("standard output: cannot be written: " + std::generic_category().message(errno));
  }
}

std::string line_of(std::string_view message) {
  std::string line = printable_message(message);
  if (!line.ends_with('\n')) line += '\n';
  return line;
}

}  // namespace

CriticalSection::CriticalSection() : lock_(state().mutex) {}

CleanupOnExit::CleanupOnExit(const CriticalSection& /*section*/, std::function<void()> clear)
    : place_(state().cleanups.insert(state().cleanups.end(), std::move(clear))) {}

void CleanupOnExit::dismiss(const CriticalSection& /*section*/) { state().cleanups.erase(place_); }

ProgressScope::ProgressScope(std::string what, bool silent) {
  const CriticalSection section;
  before_ = std::exchange(state().doing, std::move(what));
  silent_before_ = std::exchange(state().silent, silent);
}

ProgressScope::~ProgressScope() {
  const CriticalSection section;
  state().doing = std::move(before_);
  state().silent = silent_before_;
}

std::string doing_now() {
  const CriticalSection section;
  return state().doing;
}

void print_result(std::string_view text) {
  const CriticalSection section;
  print_locked(text);
}

void print_last_result(std::string_view text) {
  const CriticalSection section;
  print_locked(text);
  state().done = true;
}

void print_message(std::string_view message) {
  const std::string line = line_of(message);
  const CriticalSection section;
  clear_line_locked();
  write_error(line);
}

void show_progress(std::string_view line) {
  const std::unique_lock lock(state().mutex, std::try_to_lock);
  if (!lock || state().silent) return;
  write_error(std::string(wipe).append(line));
  state().progress_shown = true;
}

void wipe_progress() {
  const CriticalSection section;
  clear_line_locked();
}

void end_process(int exit_code, std::string_view message) {
  const std::string line = line_of(message);
  const CriticalSection section;
  if (state().done) return;
  clear_line_locked();
  for (const auto& clear : state().cleanups) clear();
  write_error(line);
  ::_exit(exit_code);
}

}  // namespace nlmech::scene
