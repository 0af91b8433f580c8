#include "nlmech/scene/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>
#include <vector>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/support/errors.hpp"

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
  if (std::ferror(in) != 0)
    throw InputError(fmt::format("{}: cannot be read to its end: {}", name, reason()));
  return text;
}
}  // namespace

std::string read_whole(const fs::path& path) {
  if (path == "-") return read_to_end(stdin, "standard input");
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw InputError(fmt::format("{}: is a folder, not a file", path.string()));
  const std::unique_ptr<std::FILE, Close> in(std::fopen(path.c_str(), "rb"));
  if (!in) throw InputError(fmt::format("{}: {}", path.string(), reason()));
  return read_to_end(in.get(), path.string());
}

void write_whole(const fs::path& path, std::string_view text) {
  if (has_content(path, text)) return;
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) throw Failure(fmt::format("{}: {}", path.parent_path().string(), error.message()));

  const fs::path temporary = path.parent_path() / fmt::format(".{}.{}", path.filename().string(), ::getpid());
  const auto fail = [&](const std::string& why) {
    fs::remove(temporary, error);
    throw Failure(fmt::format("{}: cannot be written: {}", path.string(), why));
  };
  std::unique_ptr<std::FILE, Close> out(std::fopen(temporary.c_str(), "wb"));
  if (!out) fail(reason());
  if (std::fwrite(text.data(), 1, text.size(), out.get()) != text.size()) fail(reason());
  if (std::fflush(out.get()) != 0 || ::fsync(::fileno(out.get())) != 0) fail(reason());
  if (std::fclose(out.release()) != 0) fail(reason());
  fs::rename(temporary, path, error);
  if (error) fail(error.message());
}

std::vector<fs::path> files_with(const fs::path& folder, std::string_view extension) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  if (error) throw InputError(fmt::format("{}: {}", folder.string(), error.message()));
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
