#include "nlmech/scene/machine.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace nlmech::scene {
namespace {

/// A lock of the whole file; one of another kind that the process holds is given up first.
bool lock(int file, short kind, int command) {
  struct flock whole {};
  whole.l_type = kind;
  whole.l_whence = SEEK_SET;
  int result = 0;
  while ((result = ::fcntl(file, command, &whole)) != 0 && errno == EINTR) {
  }
  return result == 0;
}

}  // namespace

Machine::Machine() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) return;
  const std::string name = (folder / fmt::format("nlmech-{}.lock", ::getuid())).string();
  file_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file_ >= 0) lock(file_, F_RDLCK, F_SETLKW);
}

Machine::~Machine() {
  if (file_ >= 0) ::close(file_);
}

// Two programs that both kept their share while they wait for the whole would wait for ever.
Machine::Alone::Alone(Machine& machine) : machine_(machine), outermost_(!machine.taken_) {
  if (machine.file_ < 0 || !outermost_) return;
  machine.taken_ = true;
  lock(machine.file_, F_UNLCK, F_SETLK);
  if (lock(machine.file_, F_WRLCK, F_SETLK)) return;
  if (::isatty(STDERR_FILENO) == 1)
    fmt::print(stderr, "to measure times: waiting for other programs to end\n");
  lock(machine.file_, F_WRLCK, F_SETLKW);
}

Machine::Alone::~Alone() {
  if (machine_.file_ < 0 || !outermost_) return;
  machine_.taken_ = false;
  lock(machine_.file_, F_RDLCK, F_SETLKW);
}

}  // namespace nlmech::scene
