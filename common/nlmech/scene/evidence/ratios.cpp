#include "nlmech/scene/evidence/ratios.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/publish.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::scene {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

const std::vector<double>& find(const std::string& name, const std::vector<BenchSeries>& series) {
  for (const BenchSeries& s : series) {
    if (s.name == name && !s.repetition.empty()) return s.repetition;
  }
  throw std::invalid_argument("check_claim: no timings of " + name);
}

/// Machine and build of the timings.
Json origin() {
  const BuildInfo& build = build_info();
  return {{"processor", processor_name()},
          {"commit", build.commit},
          {"dirty", build.dirty},
          {"compiler", build.compiler},
          {"flags", build.flags}};
}

Json to_json(const std::vector<BenchSeries>& series, const std::vector<SpeedResult>& results) {
  Json json = origin();
  for (const SpeedResult& r : results) {
    json["claims"].push_back({{"claim", r.claim.text},
                              {"method", r.claim.method},
                              {"peer", r.claim.peer},
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

SpeedResult check_claim(const SpeedClaim& claim, const std::vector<BenchSeries>& series) {
  const std::vector<double>&method = find(claim.method, series), &peer = find(claim.peer, series);
  SpeedResult result{claim, median(peer) / median(method), 0, 0, false};
  result.low = result.high = peer[0] / method[0];
  for (std::size_t i = 0; i < std::min(method.size(), peer.size()); ++i) {
    result.low = std::min(result.low, peer[i] / method[i]);
    result.high = std::max(result.high, peer[i] / method[i]);
  }
  result.held = result.ratio >= claim.least;
  return result;
}

void write_bench(const std::string& name, const std::vector<BenchSeries>& series,
                 const std::vector<SpeedResult>& results, const fs::path& out) {
  write_whole(out / "results" / "bench" / (name + ".json"), to_json(series, results).dump(2) + "\n");
}

namespace {

/// Quantile of sorted values, interpolated between the two next to the rank.
double quantile(const std::vector<double>& sorted, double share) {
  const double rank = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - std::floor(rank)) * (sorted[above] - sorted[below]);
}

const std::vector<double>& repetitions(const std::vector<BenchSeries>& series, const std::string& name) {
  for (const BenchSeries& s : series) {
    if (s.name == name && s.unit == "us a run" && !s.repetition.empty()) return s.repetition;
  }
  throw std::invalid_argument("compare_times: no timings of " + name);
}

const PublishedValue& find(const std::vector<PublishedValue>& values, const std::string& row) {
  for (const PublishedValue& value : values) {
    if (value.row == row) return value;
  }
  throw std::invalid_argument("compare_times: no seconds are printed for " + row);
}

const TimeRatio& find(const std::vector<TimeRatio>& rows, const std::string& place, const std::string& row) {
  for (const TimeRatio& r : rows) {
    if (r.place == place && r.row == row) return r;
  }
  throw invalid_argument("mean_claim: {} has no row {}", place, row);
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("spread_of: no value");
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

Spread ratio_of(const Spread& over, const Spread& under) {
  return {over.middle / under.middle, over.low / under.high, over.high / under.low};
}

RatioVerdict compare_ratio(double printed, const Spread& reproduced) {
  for (const double ratio : {printed, reproduced.middle, reproduced.low, reproduced.high}) {
    if (!std::isfinite(ratio) || ratio <= 0)
      throw invalid_argument("compare_ratio: {} is not a ratio of times", ratio);
  }
  RatioVerdict v{.printed = printed, .reproduced = reproduced};
  v.apart = std::max(reproduced.middle / printed, printed / reproduced.middle);
  v.same_faster = (printed > 1) == (reproduced.middle > 1);
  v.holds = v.same_faster && v.apart <= allowed_factor;
  return v;
}

std::vector<PublishedValue> printed_seconds(const std::vector<PublishedValue>& published,
                                            const std::string& place) {
  std::vector<PublishedValue> all;
  for (const PublishedValue& value : published) {
    if (value.place != place || value.kind != "time") continue;
    if (value.unit != "s")
      throw invalid_argument("printed_seconds: {} is in {}, not in s", value.name(), value.unit);
    all.push_back(value);
  }
  if (all.empty()) throw std::invalid_argument("printed_seconds: no times are printed in " + place);
  return all;
}

std::vector<TimeRatio> compare_times(const std::vector<PublishedValue>& published, const std::string& place,
                                     const std::map<std::string, std::string>& reference_of,
                                     const std::vector<BenchSeries>& series) {
  const std::vector<PublishedValue> printed = printed_seconds(published, place);
  std::vector<TimeRatio> all;
  for (const PublishedValue& value : printed) {
    const auto named = reference_of.find(value.row);
    if (named == reference_of.end())
      throw std::invalid_argument("compare_times: no reference for " + value.name());
    const std::string& reference = named->second;
    const Spread own = spread_of(repetitions(series, place + ", " + value.row)),
                 reference_time = spread_of(repetitions(series, place + ", " + reference));
    all.push_back(
        {place, value.row, reference, value.value, 1e-6 * own.middle,
         compare_ratio(value.value / find(printed, reference).value, ratio_of(own, reference_time))});
  }
  return all;
}

RatioClaim mean_claim(const PublishedValue& claim, const std::string& place,
                      const std::vector<std::string>& over, const std::vector<TimeRatio>& rows) {
  if (over.empty()) throw std::invalid_argument("mean_claim: the mean of no rows");
  const double share = 1 / static_cast<double>(over.size());
  Spread mean;
  for (const std::string& name : over) {
    const Spread& one = find(rows, place, name).verdict.reproduced;
    mean = {mean.middle + share * one.middle, mean.low + share * one.low, mean.high + share * one.high};
  }
  return {claim.place, claim.row, claim.quantity, over, compare_ratio(claim.value, mean)};
}

namespace {

Json to_json(const RatioVerdict& v) {
  return {{"printed", v.printed},    {"reproduced", v.reproduced.middle},
          {"low", v.reproduced.low}, {"high", v.reproduced.high},
          {"apart", v.apart},        {"holds", v.holds},
          {"lost", v.lost()},        {"same_faster", v.same_faster}};
}

Json to_json(const TimeRatios& ratios) {
  Json json = origin();
  json["allowed_factor"] = allowed_factor;
  json["rows"] = Json::array();
  json["claims"] = Json::array();
  for (const TimeRatio& r : ratios.rows) {
    json["rows"].push_back({{"place", r.place},
                            {"row", r.row},
                            {"reference", r.reference},
                            {"printed_seconds", r.printed_seconds},
                            {"seconds", r.seconds},
                            {"verdict", to_json(r.verdict)}});
  }
  for (const RatioClaim& c : ratios.claims) {
    json["claims"].push_back({{"place", c.place},
                              {"row", c.row},
                              {"quantity", c.quantity},
                              {"over", c.over},
                              {"verdict", to_json(c.verdict)}});
  }
  return json;
}

}  // namespace

void write_ratios(const std::string& name, const TimeRatios& ratios, const fs::path& out) {
  write_whole(out / "results" / "ratios" / (name + ".json"), to_json(ratios).dump(2) + "\n");
}

}  // namespace nlmech::scene
