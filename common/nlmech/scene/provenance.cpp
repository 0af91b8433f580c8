#include "nlmech/scene/provenance.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "nlmech/scene/build_info.hpp"
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

}  // namespace nlmech::scene
