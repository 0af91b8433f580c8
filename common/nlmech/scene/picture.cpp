#include "nlmech/scene/picture.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <string_view>
#include <utility>

#include "nlmech/scene/gnuplot.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

/// What such pictures end with. A file without it is never overwritten.
constexpr std::string_view drawn_here = "<!-- drawn by nlmech --plot -->\n";

/// A folder for the data of a drawing, gone with it and with the process.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / fmt::format("nlmech-plot-{}", ::getpid())) {
    const WholeAct act;
    trace_.emplace(act, [path = path_] { clear(path); });
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    const WholeAct act;
    clear(path_);
    trace_->gone(act);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  static void clear(const fs::path& path) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path_;
  std::optional<Trace> trace_;
};

}  // namespace

std::string without_markup(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (std::string_view("^_{}@&~\\").find(c) != std::string_view::npos) plain += '\\';
    plain += c;
  }
  return plain;
}

Picture::Picture(fs::path file) : file_(std::move(file)) {
  if (!wanted()) return;
  const std::string name = echoed(file_.string());
  if (file_.extension() != ".svg") throw InputError(fmt::format("--plot {}: needs a name.svg", name));
  std::error_code none;
  const fs::file_status there = fs::symlink_status(file_, none);
  if (!fs::exists(there)) return;
  if (!fs::is_regular_file(there) || !read_whole(file_).ends_with(drawn_here))
    throw InputError(fmt::format("--plot {}: is there and is no picture of such a command, which overwrites "
                                 "nothing else; give another name, or move it",
                                 name));
}

void Picture::draw(const Figure& figure) const {
  try {
    const Scratch folder;
    write_whole(folder.path() / "data.csv", figure.data.csv());
    write_whole(folder.path() / "picture.gp", gnuplot_script(figure, "data.csv"));
    put_style(folder.path());
    write_whole(file_, scene::draw(folder.path(), "picture.gp").append(drawn_here));
  } catch (const Failure& failure) {
    throw Failure(fmt::format("all numbers are written, but {} is not drawn: {}", file_.string(),
                              failure.what()));
  }
}

}  // namespace nlmech::scene
