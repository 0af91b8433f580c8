/// @file
/// Wall-time limit of a command, and its progress messages.
#pragma once

#include <optional>
#include <string>
#include <thread>

namespace nlmech::scene {

/// Thread that monitors a command from its constructor to its destructor.
///
/// After `silence` seconds, and then every second, it shows the current activity on standard error if that is
/// a terminal. At the limit it ends the process with exit code 1 and a message. It waits for a running
/// CriticalSection, removes temporary files and ends children. So a result is printed completely or not at
/// all, and the time during which a pipe blocks its output does not count.
class TimeLimit {
 public:
  /// The command and its limits.
  struct Command {
    std::string program;            ///< "gss_control"
    std::string name;               ///< "poles"
    std::optional<double> seconds;  ///< wall time, positive; none: no limit
    double grace = 0;               ///< s beyond the limit, for a command that heeds it and reports more
    double silence = 2;             ///< s before the first progress message
  };
  /// Starts the time. There is no thread without a limit and a terminal for progress.
  explicit TimeLimit(Command command);

 private:
  std::jthread watch_;  // its destructor requests the stop and joins
};

}  // namespace nlmech::scene
