#include "nlmech/scene/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "nlmech/scene/process.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

/// A gnuplot string in single quotes, inside which only the quote itself is special and is doubled.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

std::string shortened(const std::string& text) {
  constexpr std::size_t most = 600;
  const std::string tidy = text.substr(std::min(text.find_first_not_of(" \n\t"), text.size()));
  return tidy.size() <= most ? tidy : tidy.substr(0, most) + "...";
}

}  // namespace

std::string draw(const fs::path& templates, const std::string& template_name, const fs::path& folder,
                 const std::string& data, const std::map<std::string, std::string>& variables,
                 PictureFormat format) {
  const fs::path drawing = templates / "templates" / (template_name + ".gp");
  if (!fs::exists(drawing)) throw Failure(fmt::format("{}: no such template", drawing.string()));
  std::string settings = "data=" + quoted(data);
  if (format == PictureFormat::png) settings += "; png=1";
  for (const auto& [name, value] : variables) settings += "; " + name + "=" + quoted(value);

  const Finished gnuplot =
      run_program({"gnuplot", "-e", settings, fs::absolute(templates / "style.gp").string(),
                   fs::absolute(drawing).string()},
                  folder, {"LC_ALL=C.UTF-8"});  // labels are UTF-8, numbers have points
  if (gnuplot.exit_code != 0) {
    throw Failure(fmt::format("gnuplot ended with {}: {}", gnuplot.exit_code, shortened(gnuplot.errors)));
  }
  // gnuplot goes on after a warning ("Skipping data file with no valid points") and draws an empty frame
  if (!gnuplot.errors.empty()) throw Failure(fmt::format("gnuplot warns: {}", shortened(gnuplot.errors)));
  const char* mark =
      format == PictureFormat::svg ? "</svg>" : "IEND";  // both stand at the end of a whole picture
  if (gnuplot.output.find(mark) == std::string::npos) throw Failure("gnuplot drew nothing");
  return gnuplot.output;
}

}  // namespace nlmech::scene
