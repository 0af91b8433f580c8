#include "nlmech/scene/gnuplot.hpp"

#include <fmt/format.h>

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
  const std::string tidy = text.substr(text.find_first_not_of(" \n\t") == std::string::npos ? text.size()
                                                                                            : text.find_first_not_of(" \n\t"));
  return tidy.size() <= most ? tidy : tidy.substr(0, most) + "...";
}

}  // namespace

std::string draw(const fs::path& templates, const std::string& template_name, const fs::path& folder,
                 const std::string& data, const std::map<std::string, std::string>& variables) {
  const fs::path drawing = templates / "templates" / (template_name + ".gp");
  if (!fs::exists(drawing)) throw Failure(fmt::format("{}: no such template", drawing.string()));
  std::string settings = "data=" + quoted(data);
  for (const auto& [name, value] : variables) settings += "; " + name + "=" + quoted(value);

  const Finished gnuplot = run_program({"gnuplot", "-e", settings, fs::absolute(templates / "style.gp").string(),
                                        fs::absolute(drawing).string()},
                                       folder);
  if (gnuplot.exit_code != 0) {
    throw Failure(fmt::format("gnuplot ended with {}: {}", gnuplot.exit_code, shortened(gnuplot.errors)));
  }
  // gnuplot goes on after a warning ("Skipping data file with no valid points") and draws an empty frame
  if (!gnuplot.errors.empty()) throw Failure(fmt::format("gnuplot warns: {}", shortened(gnuplot.errors)));
  if (gnuplot.output.find("</svg>") == std::string::npos) throw Failure("gnuplot drew nothing");
  return gnuplot.output;
}

std::string to_png(const fs::path& svg) {
  Finished convert = run_program({"rsvg-convert", "--zoom=2", fs::absolute(svg).string()}, {});
  if (convert.exit_code != 0) {
    throw Failure(fmt::format("rsvg-convert ended with {}: {}", convert.exit_code, shortened(convert.errors)));
  }
  return std::move(convert.output);
}

}  // namespace nlmech::scene
