#include "nlmech/scene/evidence/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/provenance.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

const std::vector<double>& find(const std::string& name, const std::vector<BenchSeries>& series) {
  for (const BenchSeries& s : series) {
    if (s.name == name && !s.repetition.empty()) return s.repetition;
  }
  throw std::invalid_argument("judge_claim: no timings of " + name);
}

Json to_json(const std::vector<BenchSeries>& series, const std::vector<SpeedResult>& results) {
  const BuildInfo& build = build_info();
  Json json = {{"processor", processor_name()},
               {"commit", build.commit},
               {"dirty", build.dirty},
               {"compiler", build.compiler},
               {"flags", build.flags}};
  for (const SpeedResult& r : results) {
    json["claims"].push_back({{"claim", r.claim.text},
                              {"ours", r.claim.ours},
                              {"theirs", r.claim.theirs},
                              {"promised", r.claim.least},
                              {"ratio", r.ratio},
                              {"low", r.low},
                              {"high", r.high},
                              {"held", r.held}});
  }
  for (const BenchSeries& s : series) {
    json["series"].push_back({{"name", s.name},
                              {"unit", s.unit},
                              {"median", median(s.repetition)},
                              {"repetitions", s.repetition}});
  }
  return json;
}

std::string section(const std::string& name, const Json& json) {
  Table claims({{"claim"}, {"promised"}, {"measured"}, {"from"}, {"to"}, {"held"}});
  for (const Json& c : json.value("claims", Json::array())) {
    claims.add({c["claim"].get<std::string>(), c["promised"].get<double>(), c["ratio"].get<double>(),
                c["low"].get<double>(), c["high"].get<double>(),
                std::string(c["held"].get<bool>() ? "yes" : "NO")});
  }
  Table times({{"work"}, {"median"}, {"from"}, {"to"}, {"unit"}});
  for (const Json& s : json.value("series", Json::array())) {
    const auto repetitions = s["repetitions"].get<std::vector<double>>();
    const auto [low, high] = std::minmax_element(repetitions.begin(), repetitions.end());
    times.add(
        {s["name"].get<std::string>(), s["median"].get<double>(), *low, *high, s["unit"].get<std::string>()});
  }
  return fmt::format("\n## {}\n\n{}, {}, commit {}{}.\n\n{}\n{}", name, json["processor"].get<std::string>(),
                     json["compiler"].get<std::string>(), json["commit"].get<std::string>(),
                     json["dirty"].get<bool>() ? " with changes" : "", claims.markdown(), times.markdown());
}

}  // namespace

SpeedResult judge_claim(const SpeedClaim& claim, const std::vector<BenchSeries>& series) {
  const std::vector<double>&ours = find(claim.ours, series), &theirs = find(claim.theirs, series);
  SpeedResult result{claim, median(theirs) / median(ours), 0, 0, false};
  result.low = result.high = theirs[0] / ours[0];
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    result.low = std::min(result.low, theirs[i] / ours[i]);
    result.high = std::max(result.high, theirs[i] / ours[i]);
  }
  result.held = result.ratio >= claim.least;
  return result;
}

void write_bench(const std::string& name, const std::vector<BenchSeries>& series,
                 const std::vector<SpeedResult>& results, const fs::path& out) {
  const fs::path folder = out / "results" / "bench";
  write_whole(folder / (name + ".json"), to_json(series, results).dump(2) + "\n");

  std::string page =
      "# Speed\n\nRatios of medians to a peer in the same process: how many times less time ours takes. "
      "*From* "
      "and *to* are the smallest and the largest ratio of single repetitions. Integrators of other libraries "
      "run as their manuals write it: in their own loop over steps, on their own state, with nothing of ours "
      "around them. Behind our interface, which adds a status, observers and checks, they take longer: lines "
      "*in our walk* say by how much. Lines *multiply-adds alone* are the floor under lanes: as many "
      "multiply-adds as the series need, with all numbers in registers. Written by `make bench`.\n";
  for (const fs::path& file : files_with(folder, ".json"))
    page += section(file.stem().string(), Json::parse(read_whole(file)));
  write_whole(out / "tables" / "BENCH.md", page);
}

}  // namespace nlmech::scene
