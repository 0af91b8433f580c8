#include "nlmech/scene/evidence/bench.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/provenance.hpp"
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
  write_whole(out / "results" / "bench" / (name + ".json"), to_json(series, results).dump(2) + "\n");
}

}  // namespace nlmech::scene
