#include "nlmech/scene/picture.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "nlmech/scene/gnuplot.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

/// Last line of these pictures; a file without it is never overwritten. (XML comments must not contain two
/// hyphens.)
constexpr std::string_view drawn_here = "<!-- drawn by a command of nlmech -->\n";

/// Temporary folder for the data of a drawing, removed by the destructor or at an early end of the process.
class Scratch {
 public:
  Scratch() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "nlmech-plot-XXXXXX").string();
    const CriticalSection section;
    if (error || ::mkdtemp(name.data()) == nullptr)
      throw Failure(fmt::format("no temporary folder {}: {}", name, std::generic_category().message(errno)));
    path_ = name;
    cleanup_.emplace(section, [path = path_] { clear(path); });
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    const CriticalSection section;
    clear(path_);
    cleanup_->dismiss(section);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  static void clear(const fs::path& path) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path_;
  std::optional<CleanupOnExit> cleanup_;
};

}  // namespace

std::string without_markup(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (std::string_view("^_{}@&~\\").find(c) != std::string_view::npos) plain += '\\';
    if (c == '\'')
      plain += "\u2032";  // gnuplot cannot quote two apostrophes in a row
    else
      plain += c;
  }
  return plain;
}

Picture::Picture(fs::path file) : file_(std::move(file)) {
  if (!wanted()) return;
  const std::string name = echoed_path(file_.string());
  if (file_.extension() != ".svg") throw input_error("--plot {}: must end in .svg", name);
  std::error_code none;
  const fs::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
  if (!fs::is_directory(folder, none)) throw input_error("--plot {}: there is no such folder", name);
  const fs::file_status there = fs::symlink_status(file_, none);
  if (there.type() == fs::file_type::none) throw input_error("--plot {}: {}", name, none.message());
  if (!fs::exists(there)) return;
  if (!fs::is_regular_file(there) || !read_whole(file_).ends_with(drawn_here))
    throw input_error(
        "--plot {}: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move "
        "it",
        name);
}

void Picture::draw(const std::function<Figure()>& make) const {
  try {
    const ProgressScope doing("drawing");
    const Figure figure = make();
    const Scratch folder;
    write_whole(folder.path() / "data.csv", figure.data.csv());
    write_whole(folder.path() / "picture.gp", gnuplot_script(figure, "data.csv"));
    put_style(folder.path());
    const std::string svg = with_answers(scene::draw(folder.path(), "picture.gp"), answers_of(figure));
    write_whole(file_, svg + std::string(drawn_here));
  } catch (const std::exception& failure) {
    throw Failure(fmt::format("all numbers are written, but {} is not drawn: {}", echoed_path(file_.string()),
                              failure.what()));
  }
}

}  // namespace nlmech::scene
