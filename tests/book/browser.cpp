#include "tests/book/browser.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace nlmech::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Two ends of a channel that a child inherits only where it is told to, with numbers out of the way of 3
/// and 4. A socket and no pipe: writing to one whose reader has ended is an error then, and no signal.
std::pair<int, int> make_channel() {
  std::array<int, 2> low{}, high{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, low.data()) != 0) fail("socketpair", errno);
  for (std::size_t i = 0; i < 2; ++i) {
    high[i] = ::fcntl(low[i], F_DUPFD_CLOEXEC, 10);
    if (high[i] < 0) fail("fcntl", errno);
    ::close(low[i]);
  }
  return {high[0], high[1]};
}

int milliseconds_until(Deadline deadline) {
  using namespace std::chrono;
  const auto left = duration_cast<milliseconds>(deadline - steady_clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 600'000));
}

/// Waits until a descriptor can be read or written.
void wait_for(int descriptor, short what, Deadline deadline) {
  for (;;) {
    pollfd one{descriptor, what, 0};
    const int ready = ::poll(&one, 1, milliseconds_until(deadline));
    if (ready > 0) return;
    if (ready == 0) throw BrowserLost("the browser does not answer");
    if (errno != EINTR) fail("poll", errno);
  }
}

/// As the kernel wants lists of words.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Our environment, but for the folder of temporary files.
std::vector<std::string> environment_with_temporary_files_in(const std::string& folder) {
  std::vector<std::string> settings = {"TMPDIR=" + folder};
  for (char** setting = environ; *setting != nullptr; ++setting) {
    if (!std::string_view(*setting).starts_with("TMPDIR=")) settings.emplace_back(*setting);
  }
  return settings;
}

pid_t start(std::vector<std::string> words, std::vector<std::string> settings, int commands, int answers) {
  const std::vector<char*> arguments = pointers_to(words), environment = pointers_to(settings);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, commands, 3);
  posix_spawn_file_actions_adddup2(&actions, answers, 4);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // a group of its own, to be ended as one
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t process = -1;
  const int error =
      ::posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) fail("cannot start " + words.front(), error);
  return process;
}

}  // namespace

std::optional<std::string> find_chromium() {
  const char* path = std::getenv("PATH");
  if (path == nullptr) return std::nullopt;
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"}) {
    std::istringstream folders(path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const fs::path program = fs::path(folder) / name;
      if (::access(program.c_str(), X_OK) == 0) return program.string();
    }
  }
  return std::nullopt;
}

Browser::Browser(const std::string& program) {
  std::string name = (fs::temp_directory_path() / "nlmech-browser-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) fail("mkdtemp", errno);
  folder_ = name;
  const auto [commands_end, to] = make_channel();
  const auto [from, answers_end] = make_channel();
  to_ = to;
  from_ = from;
  // Without a sandbox, so that it runs as root too, as it does in containers: it shows our own pages only.
  process_ = start(
      {program, "--headless", "--hide-scrollbars", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
       "--remote-debugging-pipe", "--user-data-dir=" + name, "--no-first-run", "--disable-extensions",
       "--disable-sync", "--disable-component-update", "--disable-background-networking",
       "--host-resolver-rules=MAP * ~NOTFOUND", "--no-proxy-server", "about:blank"},
      environment_with_temporary_files_in(name), commands_end, answers_end);
  ::close(commands_end);
  ::close(answers_end);
}

Browser::~Browser() {
  ::close(to_);
  ::close(from_);
  ::kill(-process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  // The browser's other processes are not our children: one that is still ending may write a last file.
  const Deadline deadline = in_seconds(10);
  std::error_code error;
  while (fs::remove_all(folder_, error), error && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

void Browser::write_message(const std::string& text, Deadline deadline) {
  std::size_t done = 0;
  while (done <= text.size()) {  // with the zero byte at the end
    wait_for(to_, POLLOUT, deadline);
    const ssize_t count =
        ::send(to_, text.c_str() + done, text.size() + 1 - done, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EAGAIN && errno != EINTR) {
      throw BrowserLost("the browser takes no commands: it has ended");
    }
  }
}

json Browser::read_message(Deadline deadline) {
  for (;;) {
    const std::size_t end = received_.find('\0');
    if (end != std::string::npos) {
      json message = json::parse(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(end));
      received_.erase(0, end + 1);
      return message;
    }
    wait_for(from_, POLLIN, deadline);
    std::array<char, 65536> piece;
    const ssize_t count = ::read(from_, piece.data(), piece.size());
    if (count > 0) {
      received_.append(piece.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      throw BrowserLost("the browser has ended");
    }
  }
}

json Browser::call(const std::string& method, const json& parameters, const std::string& session,
                   Deadline deadline) {
  const int id = ++calls_;
  json command = {{"id", id}, {"method", method}, {"params", parameters}};
  if (!session.empty()) command["sessionId"] = session;
  write_message(command.dump(), deadline);
  for (;;) {
    json message = read_message(deadline);
    if (!message.contains("id")) {
      events_.push_back(std::move(message));
    } else if (message["id"] == id) {
      if (message.contains("error"))
        throw std::runtime_error(method + ": " + message["error"].value("message", std::string("refused")));
      return message["result"];
    }
  }
}

json Browser::next_event(Deadline deadline) {
  while (events_.empty()) {
    json message = read_message(deadline);
    if (!message.contains("id")) events_.push_back(std::move(message));
  }
  json event = std::move(events_.front());
  events_.erase(events_.begin());
  return event;
}

std::vector<json> Browser::take_events() { return std::exchange(events_, {}); }

}  // namespace nlmech::tests
