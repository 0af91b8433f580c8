#include "nlmech/scene/program/machine.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <thread>

namespace nlmech::scene {
namespace {

/// Locks or unlocks one byte of the file.
bool lock(int file, int byte, short kind, int command) {
  struct flock one {};
  one.l_type = kind;
  one.l_whence = SEEK_SET;
  one.l_start = byte;
  one.l_len = 1;
  int result = 0;
  while ((result = ::fcntl(file, command, &one)) != 0 && errno == EINTR) {
  }
  return result == 0;
}

/// Byte 0 is locked by the next program in the queue, byte k by the program that holds processor k.
constexpr int queue = 0;

}  // namespace

Machine::Machine(int processors)
    : processors_(processors > 0 ? processors
                                 : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) return;
  const std::string name = (folder / fmt::format("nlmech-{}.lock", ::getuid())).string();
  file_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
}

Machine::~Machine() {
  if (file_ >= 0) ::close(file_);
}

// Only the first program of the queue looks for a processor, so that one which releases its processor and
// waits again comes later.
Machine::Processor::Processor(Machine& machine) : machine_(machine) {
  if (machine.file_ < 0 || !lock(machine.file_, queue, F_WRLCK, F_SETLKW)) return;
  while (number_ == 0) {
    for (int k = 1; k <= machine.processors_ && number_ == 0; ++k) {
      if (lock(machine.file_, k, F_WRLCK, F_SETLK)) number_ = k;
    }
    if (number_ == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  lock(machine.file_, queue, F_UNLCK, F_SETLK);
}

Machine::Processor::~Processor() {
  if (number_ > 0) lock(machine_.file_, number_, F_UNLCK, F_SETLK);
}

}  // namespace nlmech::scene
