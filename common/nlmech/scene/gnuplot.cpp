#include "nlmech/scene/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;

namespace {

std::string shortened(const std::string& text) {
  constexpr std::size_t most = 600;
  const std::string trimmed = text.substr(std::min(text.find_first_not_of(" \n\t"), text.size()));
  return trimmed.size() <= most ? trimmed : trimmed.substr(0, most) + "...";
}

/// Text of a template without its leading comments, which explain its variables.
std::string body_of(const std::string& name) {
  const fs::path file = data_folder() / "figures" / "templates" / (name + ".gp");
  if (!fs::exists(file)) throw Failure(fmt::format("{}: no such template", file.string()));
  const std::string text = read_whole(file);
  std::size_t at = 0;
  while (at < text.size() && (text[at] == '#' || text[at] == '\n')) at = text.find('\n', at) + 1;
  return text.substr(at);
}

}  // namespace

std::string gnuplot_script(const Figure& figure, const std::string& data) {
  std::string script = "data = " + gnuplot_quoted(data) + "\n";
  for (const auto& [name, value] : figure.variables) script += name + " = " + gnuplot_quoted(value) + "\n";
  script += figure.prelude + "load 'figures/style.gp'\n\n";
  return script + (figure.template_name.empty() ? figure.script : body_of(figure.template_name));
}

std::string put_style(const fs::path& out) {
  std::string style = read_whole(data_folder() / "figures" / "style.gp");
  const fs::path copy = out / "figures" / "style.gp";
  if (!fs::exists(copy) || read_whole(copy) != style) write_whole(copy, style);
  return style;
}

std::string answers_of(const Figure& figure) {
  const auto found = figure.variables.find("answers");
  return found == figure.variables.end() ? ""
                                         : read_whole(data_folder() / "figures" / (found->second + ".xml"));
}

std::string with_answers(std::string svg, const std::string& answers) {
  return answers.empty() ? svg : svg.insert(svg.rfind("</svg>"), answers);
}

std::string draw(const fs::path& folder, const std::string& script, PictureFormat format) {
  // gnuplot writes to standard output and write_whole() writes the file, so that a failure or a killed
  // program leaves no partial picture.
  std::vector<std::string> command = {"gnuplot"};
  if (format == PictureFormat::png) command.insert(command.end(), {"-e", "png=1"});
  command.push_back(script);
  const Finished gnuplot =
      run_program(command, folder, {"LC_ALL=C.UTF-8"});  // labels are UTF-8, numbers have points
  if (gnuplot.exit_code != 0) {
    throw Failure(fmt::format("gnuplot ended with {}: {}", gnuplot.exit_code, shortened(gnuplot.errors)));
  }
  // after a warning ("Skipping data file with no valid points") gnuplot draws an empty frame
  if (!gnuplot.errors.empty()) throw Failure(fmt::format("gnuplot warns: {}", shortened(gnuplot.errors)));
  const char* mark = format == PictureFormat::svg ? "</svg>" : "IEND";  // end marks of a complete picture
  if (gnuplot.output.find(mark) == std::string::npos) throw Failure("gnuplot drew nothing");
  return gnuplot.output;
}

}  // namespace nlmech::scene
