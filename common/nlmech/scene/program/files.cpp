#include "nlmech/scene/program/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {
std::string reason() { return std::generic_category().message(errno); }

bool has_content(const fs::path& path, std::string_view text) {
  std::error_code ignored;
  if (fs::file_size(path, ignored) != text.size() || ignored) return false;
  std::ifstream in(path, std::ios::binary);
  const std::string now{std::istreambuf_iterator<char>(in), {}};
  return in.good() && now == text;
}

struct Close {
  void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};

std::string read_to_end(std::FILE* in, const std::string& name) {
  std::string text;
  std::vector<char> buffer(1 << 16);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), in))
    text.append(buffer.data(), count);
  if (std::ferror(in) != 0) throw input_error("{}: cannot be read to its end: {}", name, reason());
  return text;
}

/// A temporary file in the folder of the final one. Unless renamed, it is removed by the destructor or at an
/// early end of the process.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path) : path_(std::move(path)) {
    const CriticalSection section;
    file_.reset(std::fopen(path_.c_str(), "wb"));
    if (file_) cleanup_.emplace(section, [this] { ::unlink(path_.c_str()); });
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!cleanup_) return;
    const CriticalSection section;
    cleanup_->dismiss(section);
    ::unlink(path_.c_str());
  }
  /// Writes the text to the disk. @returns false with errno set on failure
  bool write(std::string_view text) {
    if (!file_) return false;
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) return false;
    if (std::fflush(file_.get()) != 0 || ::fsync(::fileno(file_.get())) != 0) return false;
    return std::fclose(file_.release()) == 0;
  }
  /// Renames the file. @returns false with errno set on failure
  bool rename_to(const fs::path& path) {
    const CriticalSection section;
    if (std::rename(path_.c_str(), path.c_str()) != 0) return false;
    cleanup_->dismiss(section);
    cleanup_.reset();
    return true;
  }

 private:
  fs::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<CleanupOnExit> cleanup_;
};
}  // namespace

std::string read_whole(const fs::path& path) {
  if (path == "-") {
    const ProgressScope reading("reading standard input", ::isatty(STDIN_FILENO) == 1);
    return read_to_end(stdin, "standard input");
  }
  const std::string name = echoed_path(path.string());
  const ProgressScope reading("reading " + name);
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw input_error("{}: is a folder, not a file", name);
  const std::unique_ptr<std::FILE, Close> in(std::fopen(path.c_str(), "rb"));
  if (!in) throw input_error("{}: {}", name, reason());
  return read_to_end(in.get(), name);
}

void write_whole(const fs::path& path, std::string_view text) {
  if (has_content(path, text)) return;
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) throw Failure(fmt::format("{}: {}", echoed_path(path.parent_path().string()), error.message()));
  TemporaryFile temporary(path.parent_path() / fmt::format(".{}.{}", path.filename().string(), ::getpid()));
  if (!temporary.write(text) || !temporary.rename_to(path))
    throw Failure(fmt::format("{}: cannot be written: {}", echoed_path(path.string()), reason()));
}

std::vector<fs::path> files_with(const fs::path& folder, std::string_view extension) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  if (error) throw input_error("{}: {}", echoed_path(folder.string()), error.message());
  std::sort(files.begin(), files.end());
  return files;
}

fs::path data_folder() {
  if (const char* chosen = std::getenv("NLMECH_DATA")) return chosen;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path().parent_path() / "share" / "nlmech";
  for (const fs::path& candidate : {installed, fs::path(build_info().source_folder)}) {
    if (fs::exists(candidate / "figures" / "style.gp", ignored)) return candidate;
  }
  throw Failure(fmt::format("no folder with figures/style.gp: looked in {} and {}; set NLMECH_DATA",
                            installed.string(), build_info().source_folder));
}

}  // namespace nlmech::scene
