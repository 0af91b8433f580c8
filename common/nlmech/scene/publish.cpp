#include "nlmech/scene/publish.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/gnuplot.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech::scene {
using Json = nlohmann::ordered_json;

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string provenance(const Chapter& chapter, const Scene& scene, const Performance& performance,
                       bool quick) {
  const BuildInfo& build = build_info();
  Json json = {{"chapter", chapter.name()},
               {"scene", scene.name},
               {"title", scene.title},
               {"place", scene.place},
               {"command", fmt::format("{} run {}{}", chapter.name(), scene.name, quick ? " --quick" : "")},
               {"effort", quick ? "quick" : "full"},
               {"version", build.version},
               {"commit", build.commit},
               {"dirty", build.dirty},
               {"compiler", build.compiler},
               {"flags", build.flags},
               {"processor", processor_name()},
               {"instruction_set", to_string(best_instruction_set())}};
  json["libraries"] = Json::object();
  for (const LibraryVersion& library : build.libraries) json["libraries"][library.name] = library.version;
  json["runs"] = Json::array();
  for (const AnyRun* run : performance.runs)
    json["runs"].push_back({{"name", run->name()}, {"reading", run->reading()}});
  json["quantities"] = Json::array();
  for (const Quantity& q : performance.showing.quantities) {
    json["quantities"].push_back({{"name", q.name},
                                  {"value", q.value},
                                  {"unit", q.unit},
                                  {"low", q.low},
                                  {"high", q.high},
                                  {"passes", q.passes()},
                                  {"reason", q.reason}});
  }
  return json.dump(2) + "\n";
}

namespace fs = std::filesystem;

namespace {

/// Last line of an SVG: hash of its style, script and data (FNV-1a of Fowler, Noll and Vo, 64 bits).
std::string drawn_from(const std::string& style, const std::string& script, const std::string& data) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&hash](std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    hash = (hash ^ 0xff) * 0x100000001b3;  // separator of the texts: 0xff does not occur in UTF-8
  };
  add(style);
  add(script);
  add(data);
  return fmt::format("<!-- drawn from {:016x} -->\n", hash);
}

bool ends_with(const fs::path& file, const std::string& text) {
  return fs::is_regular_file(file) && read_whole(file).ends_with(text);
}

/// Draws a figure, unless the SVG already has the same hash.
void draw_figure(const std::string& chapter, const std::string& scene, const std::string& answers,
                 const std::string& origin, const Publishing& how) {
  const std::string script = fmt::format("results/{}/{}.gp", chapter, scene);
  const auto draw_as = [&](PictureFormat format) {
    const bool svg = format == PictureFormat::svg;
    const std::string name = scene + (svg ? ".svg" : ".png");
    const fs::path picture = how.out / "figures" / chapter / name;
    if (svg && ends_with(picture, origin)) return;
    try {
      std::string drawn = draw(how.out, script, format);
      if (svg) drawn = with_answers(std::move(drawn), answers);
      write_whole(picture, drawn + (svg ? origin : ""));
    } catch (const Failure& failure) {
      std::error_code ignored;
      fs::remove(picture, ignored);  // it would not match the new data
      throw Failure(fmt::format("figure {} of {} was not drawn: {}; its script is {}", name, chapter,
                                failure.what(), (how.out / script).string()));
    }
  };
  draw_as(PictureFormat::svg);
  if (how.png) draw_as(PictureFormat::png);
}

}  // namespace

std::vector<fs::path> publish(const Chapter& chapter, const Scene& scene, const Performance& performance,
                              bool quick, const Publishing& how) {
  const Showing& showing = performance.showing;
  std::vector<fs::path> files;
  const auto put = [&](const char* folder, const char* extension, const std::string& text) {
    files.push_back(fs::path(folder) / chapter.name() / (scene.name + extension));
    write_whole(how.out / files.back(), text);
  };
  std::string origin;
  if (showing.figure) {
    const std::string data = showing.figure->data.csv(),
                      name = fmt::format("results/{}/{}", chapter.name(), scene.name),
                      remark = fmt::format("# {}: {}\n#\n#   gnuplot {}.gp > {}.svg\n\n", scene.place,
                                           scene.title, name, scene.name),
                      script = remark + gnuplot_script(*showing.figure, name + ".csv");
    put("results", ".csv", data);
    put("results", ".gp", script);
    origin = drawn_from(put_style(how.out) + answers_of(*showing.figure), script, data);
  }
  if (showing.table) {
    put("tables", ".csv", showing.table->csv());
    put("tables", ".md", showing.table->markdown());
  }
  put("results", ".json", provenance(chapter, scene, performance, quick));
  if (showing.figure && how.plots) {
    draw_figure(chapter.name(), scene.name, answers_of(*showing.figure), origin, how);
    for (const char* extension : {".svg", ".png"}) {
      if (extension == std::string_view(".svg") || how.png)
        files.push_back(fs::path("figures") / chapter.name() / (scene.name + extension));
    }
  }
  return files;
}

}  // namespace nlmech::scene
