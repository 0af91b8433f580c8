/// @file
/// `geodesy_bench`: times of all contenders by Google Benchmark, and the claims about them. Writes
/// results/bench/geodesy.json under the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "chapters/geodesy/contenders.hpp"
#include "chapters/speed.hpp"
#include "nlmech/scene/program/command_line.hpp"
#include "nlmech/support/errors.hpp"

namespace {

using namespace nlmech;
using chapters::geodesy::Contender;
using chapters::geodesy::Points;

/// Keeps the CPU time of every repetition, in nanoseconds a point.
class Keeper : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      times[run.run_name.function_name].push_back(run.counters.at("ns/point"));
    }
  }
  [[nodiscard]] std::vector<scene::BenchSeries> series() const {
    std::vector<scene::BenchSeries> all;
    for (const auto& [name, values] : times) all.push_back({name, "ns a point", values});
    return all;
  }

 private:
  std::map<std::string, std::vector<double>> times;
};

std::string series_name(const std::string& contender, const Points& points) {
  return fmt::format("{} / {}", contender, points.x.size());
}

void register_passes(const std::vector<Contender>& all, Points& points) {
  const auto n = static_cast<double>(points.x.size());
  for (const Contender& contender : all) {
    const auto run = [&contender, &points, n](benchmark::State& state) {
      for (auto _ : state) {
        contender.pass(points);
        benchmark::ClobberMemory();
      }
      state.counters["ns/point"] =
          benchmark::Counter(static_cast<double>(state.iterations()) * n * 1e-9,
                             benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    };
    benchmark::RegisterBenchmark(series_name(contender.name(), points).c_str(), run);
  }
}

/// What the chapter promises, as far as this machine and this build can measure it.
std::vector<scene::SpeedClaim> claims(const std::vector<Contender>& all, const Points& points) {
  const auto has = [&all](const std::string& name) {
    return std::any_of(all.begin(), all.end(), [&](const Contender& c) { return c.name() == name; });
  };
  std::vector<scene::SpeedClaim> out;
  const auto add = [&](const std::string& ours, const std::string& theirs, double least) {
    if (!has(ours) || !has(theirs)) return;
    out.push_back({fmt::format("{} against {}, {} points", ours, theirs, points.x.size()),
                   series_name(ours, points), series_name(theirs, points), least});
  };
  const std::string peer = "GeographicLib, one point";
  add("fast, one point", peer, 3);
  add("fast, baseline only, one point", peer, 3);
  add("fast, batch avx2", peer, 15);
  add("fast, batch avx512", peer, 25);
  for (const std::string set : {"baseline", "avx2", "avx512"}) {
    for (const std::string method :
         {"Bowring 1976, 2 iterations", "Bowring 1985, 2 iterations", "Fukushima 2006, 2 iterations"}) {
      // In the baseline as fast on one processor that was tried, and a third faster on another.
      add("fast, batch " + set, method + ", batch " + set, set == "baseline" ? 0.9 : 1);
    }
  }
  return out;
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv, "0.01");

  const geodesy::Ellipsoid earth = geodesy::Ellipsoid::wgs84();
  const std::vector<Contender> all = chapters::geodesy::contenders(earth);
  Points small = chapters::geodesy::sample_points(4096, earth),
         large = chapters::geodesy::sample_points(1000000, earth);
  register_passes(all, small);  // second-level cache
  register_passes(all, large);  // memory
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);

  std::vector<scene::SpeedClaim> promised = claims(all, small);
  for (const scene::SpeedClaim& claim : claims(all, large)) promised.push_back(claim);
  return chapters::judge_speed("geodesy", promised, keeper.series());
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("geodesy_bench", &bench, argc, argv); }
