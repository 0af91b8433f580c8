/// @file
/// Wall time of a command: a limit that holds whatever the command is doing, and a word on progress.
#pragma once

#include <optional>
#include <string>
#include <thread>

namespace nlmech::scene {

/// Watches over a command, from its making to its end, by a thread of its own.
///
/// After some seconds of silence, and then every second, it shows on standard error what is being done, if
/// that is a terminal. At the limit it ends the process with exit code 1 and a sentence: files that are half
/// written are removed, children ended, and an act under way (CriticalSection) is finished first. So a result
/// is printed whole or not at all, and time in which nobody takes it does not count.
class TimeLimit {
 public:
  /// What is watched over.
  struct Command {
    std::string program;            ///< "gss_control"
    std::string name;               ///< "poles"
    std::optional<double> seconds;  ///< wall time, positive; none: it may take as long as it takes
    double grace = 0;               ///< s beyond, for a command that heeds the limit by itself and says more
    double silence = 2;             ///< s before the first word on progress
  };
  /// The time begins now. Without a limit, and with no terminal to show progress on, there is no thread.
  explicit TimeLimit(Command command);

 private:
  std::jthread watch_;  // asked to stop, and waited for, when this goes
};

}  // namespace nlmech::scene
