/// @file
/// A headless Chromium that is told what to do through its DevTools protocol.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nlmech::tests {

/// The browser did not answer in time, or has ended: it is of no more use.
struct BrowserLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A point of time after which nobody waits any longer.
using Deadline = std::chrono::steady_clock::time_point;

/// So many seconds from now.
[[nodiscard]] inline Deadline in_seconds(double seconds) {
  using namespace std::chrono;
  return steady_clock::now() + duration_cast<steady_clock::duration>(duration<double>(seconds));
}

/// The program of an installed Chromium, or nothing.
[[nodiscard]] std::optional<std::string> find_chromium();

/// A running browser, with a folder of its own for its data and temporary files. Nothing that it does reaches
/// the network; it is gone, with all its processes, when this object is.
///
/// Commands go to the descriptor 3 of its process and answers and events come from its descriptor 4, as JSON
/// that ends with a zero byte (option --remote-debugging-pipe).
class Browser {
 public:
  /// Starts it. @throws std::runtime_error if the process cannot be started
  explicit Browser(const std::string& program);
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser();

  /// One command and its result. Events that come meanwhile are kept for next_event().
  /// @param session of a page; empty: of the browser
  /// @throws BrowserLost if there is no answer until the deadline
  /// @throws std::runtime_error if the answer is an error
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters, const std::string& session,
                      Deadline deadline);

  /// The next event, in the order in which they came. @throws BrowserLost if there is none until the deadline
  nlohmann::json next_event(Deadline deadline);

  /// All events that are there and have not been handed out.
  [[nodiscard]] std::vector<nlohmann::json> take_events();

 private:
  nlohmann::json read_message(Deadline deadline);
  void write_message(const std::string& text, Deadline deadline);

  std::filesystem::path folder_;
  pid_t process_ = -1;
  int to_ = -1, from_ = -1;
  int calls_ = 0;
  std::string received_;
  std::vector<nlohmann::json> events_;
};

}  // namespace nlmech::tests
