/// @file
/// `geodesy_bench`: times of all contenders by Google Benchmark, and the claims about them. Writes
/// results/bench/geodesy.json and tables/BENCH.md under the current folder; exit code 1 if a claim is not
/// held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "chapters/geodesy/contenders.hpp"
#include "nlmech/scene/bench.hpp"
#include "nlmech/scene/command_line.hpp"
#include "nlmech/support/errors.hpp"

namespace {

using namespace nlmech;
using chapters::Contender;
using chapters::Points;

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
      add("fast, batch " + set, method + ", batch " + set, 1);
    }
  }
  return out;
}

int bench(int argc, char** argv) {
  // Interleaved in random order, so that a disturbance of the machine does not fall on one method.
  std::vector<std::string> defaults = {"--benchmark_repetitions=11",
                                       "--benchmark_enable_random_interleaving=true",
                                       "--benchmark_min_time=0.01"};
  std::vector<char*> options(argv, argv + argc);
  for (std::string& option : defaults) options.insert(options.begin() + 1, option.data());
  int count = static_cast<int>(options.size());
  benchmark::Initialize(&count, options.data());

  const geodesy::Ellipsoid earth = geodesy::Ellipsoid::wgs84();
  const std::vector<Contender> all = chapters::contenders(earth);
  Points small = chapters::sample_points(4096, earth), large = chapters::sample_points(1000000, earth);
  register_passes(all, small);  // second-level cache
  register_passes(all, large);  // memory
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);

  std::vector<scene::SpeedResult> results;
  bool held = true;
  for (const Points* points : {&small, &large}) {
    for (const scene::SpeedClaim& claim : claims(all, *points)) {
      results.push_back(scene::judge_claim(claim, keeper.series()));
      const scene::SpeedResult& r = results.back();
      held = held && r.held;
      fmt::print("{:4} {}: {:.2f} ({:.2f} to {:.2f}), promised {:g}\n", r.held ? "" : "NOT", claim.text,
                 r.ratio, r.low, r.high, claim.least);
    }
  }
  scene::write_bench("geodesy", keeper.series(), results, ".");
  return held ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return bench(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "geodesy_bench: {}\n", error.what());
    return 1;
  }
}
