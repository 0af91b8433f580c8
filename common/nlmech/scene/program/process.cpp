#include "nlmech/scene/program/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <optional>
#include <string_view>
#include <system_error>

#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace {

/// Both ends of a pipe; the destructor closes the open ones.
struct Pipe {
  Pipe() {
    if (::pipe2(end.data(), O_CLOEXEC) != 0)
      throw Failure("no pipe: " + std::generic_category().message(errno));
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close(0);
    close(1);
  }
  void close(std::size_t i) {
    if (end[i] >= 0) ::close(end[i]);
    end[i] = -1;
  }
  std::array<int, 2> end{-1, -1};
};

struct SpawnActions {
  SpawnActions() { ::posix_spawn_file_actions_init(&actions); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  ~SpawnActions() { ::posix_spawn_file_actions_destroy(&actions); }
  posix_spawn_file_actions_t actions{};
};

/// Null-terminated array of C strings; posix_spawn's signature wants them without const.
std::vector<char*> c_strings(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// Environment of this process with some variables replaced.
std::vector<std::string> environment_with(const std::vector<std::string>& settings) {
  std::vector<std::string> all = settings;
  for (char** variable = ::environ; *variable != nullptr; ++variable) {
    const std::string_view name =
        std::string_view(*variable).substr(0, std::string_view(*variable).find('=') + 1);
    const bool replaced = std::any_of(settings.begin(), settings.end(),
                                      [&](const std::string& s) { return s.starts_with(name); });
    if (!replaced) all.emplace_back(*variable);
  }
  return all;
}

pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
            const std::vector<std::string>& settings, int out, int err) {
  SpawnActions spawn;
  ::posix_spawn_file_actions_addopen(&spawn.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&spawn.actions, out, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&spawn.actions, err, STDERR_FILENO);
  if (!folder.empty()) ::posix_spawn_file_actions_addchdir_np(&spawn.actions, folder.c_str());
  const std::vector<std::string> environment = environment_with(settings);
  const std::vector<char*> argv = c_strings(arguments), envp = c_strings(environment);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, argv[0], &spawn.actions, nullptr, argv.data(), envp.data());
  if (error != 0) {
    throw Failure(
        fmt::format("{}: cannot be started: {}", arguments[0], std::generic_category().message(error)));
  }
  return child;
}

/// A running child process, killed at an early end of this process.
class Child {
 public:
  Child(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
        const std::vector<std::string>& settings, const std::array<Pipe, 2>& pipes) {
    const CriticalSection section;
    id_ = start(arguments, folder, settings, pipes[0].end[1], pipes[1].end[1]);
    cleanup_.emplace(section, [this] { ::kill(id_, SIGKILL); });
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (cleanup_) static_cast<void>(wait());
  }
  /// Waits for its end. @returns its status, or none with errno set if the system has discarded it
  std::optional<int> wait() {
    siginfo_t ended{};  // WNOWAIT keeps the process id reserved until the cleanup entry is removed
    while (::waitid(P_PID, static_cast<id_t>(id_), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    const CriticalSection section;
    cleanup_->dismiss(section);
    cleanup_.reset();
    int status = 0;
    return ::waitpid(id_, &status, 0) == id_ ? std::optional(status) : std::nullopt;
  }

 private:
  pid_t id_ = 0;
  std::optional<CleanupOnExit> cleanup_;
};

/// Reads both pipes as they fill, so that a program which writes much to one of them does not block.
void drain(std::array<Pipe, 2>& pipes, std::array<std::string*, 2> texts) {
  std::array<char, 65536> buffer{};
  while (pipes[0].end[0] >= 0 || pipes[1].end[0] >= 0) {
    std::array<pollfd, 2> waiting{{{pipes[0].end[0], POLLIN, 0}, {pipes[1].end[0], POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
    for (std::size_t i = 0; i < 2; ++i) {
      if (waiting[i].revents == 0) continue;
      const ssize_t count = ::read(waiting[i].fd, buffer.data(), buffer.size());
      if (count > 0)
        texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
      else if (count == 0 || errno != EINTR)
        pipes[i].close(0);
    }
  }
}

}  // namespace

Finished run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                     const std::vector<std::string>& settings) {
  std::array<Pipe, 2> pipes;
  Child child(arguments, folder, settings, pipes);
  pipes[0].close(1);
  pipes[1].close(1);
  Finished finished;
  drain(pipes, {&finished.output, &finished.errors});
  const std::optional<int> status = child.wait();
  if (!status) {  // SIGCHLD is ignored
    throw Failure(fmt::format("{}: how it ended is not known: {}", arguments[0],
                              std::generic_category().message(errno)));
  }
  finished.exit_code = WIFEXITED(*status) ? WEXITSTATUS(*status) : 128 + WTERMSIG(*status);
  return finished;
}

}  // namespace nlmech::scene
