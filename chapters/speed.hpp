/// @file
/// What the programs of `make bench` share: options, times kept, claims judged and written. Included by them
/// alone, since Google Benchmark is looked for only there.
#pragma once

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "nlmech/scene/evidence/bench.hpp"
#include "nlmech/scene/evidence/ratios.hpp"

namespace nlmech::chapters {

/// Keeps the CPU time of every repetition, in microseconds a run.
class TimeKeeper : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration)
        times[run.run_name.function_name].push_back(run.GetAdjustedCPUTime());
    }
  }
  [[nodiscard]] std::vector<scene::BenchSeries> series() const {
    std::vector<scene::BenchSeries> all;
    for (const auto& [name, values] : times) all.push_back({name, "us a run", values});
    return all;
  }

 private:
  std::map<std::string, std::vector<double>> times;
};

/// Hands the options of the command line to Google Benchmark, behind ours.
/// @param least_time of a repetition, in seconds
inline void begin_speed(int argc, char** argv, const char* least_time = "0.02") {
  // Interleaved in random order, so that a disturbance of the machine does not fall on one method.
  std::vector<std::string> defaults = {"--benchmark_repetitions=11",
                                       "--benchmark_enable_random_interleaving=true",
                                       std::string("--benchmark_min_time=") + least_time};
  std::vector<char*> options(argv, argv + argc);
  for (std::string& option : defaults) options.insert(options.begin() + 1, option.data());
  int count = static_cast<int>(options.size());
  benchmark::Initialize(&count, options.data());
}

/// Measures pieces of work with a name and a function run().
template <class Work>
[[nodiscard]] std::vector<scene::BenchSeries> measure_speed(const std::vector<Work>& all) {
  for (const Work& w : all) {
    benchmark::RegisterBenchmark(w.name.c_str(), [&w](benchmark::State& state) {
      for (auto _ : state) w.run();
    })->Unit(benchmark::kMicrosecond);
  }
  TimeKeeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);
  return keeper.series();
}

/// Judges the claims, prints a line each, and writes results/bench/<name>.json.
/// @return the exit code: 1 if a claim is not held
inline int judge_speed(const std::string& name, const std::vector<scene::SpeedClaim>& claims,
                       const std::vector<scene::BenchSeries>& series) {
  bool held = true;
  std::vector<scene::SpeedResult> results;
  for (const scene::SpeedClaim& claim : claims) {
    results.push_back(scene::judge_claim(claim, series));
    const scene::SpeedResult& r = results.back();
    held = held && r.held;
    fmt::print("{:4} {}: {:.2f} ({:.2f} to {:.2f}), promised {:g}\n", r.held ? "" : "NOT", claim.text,
               r.ratio, r.low, r.high, claim.least);
  }
  scene::write_bench(name, series, results, ".");
  return held ? 0 : 1;
}

/// Prints a line for each ratio, and writes results/ratios/<name>.json.
/// @return the exit code: 0, because a ratio that does not hold is a finding and no promise of ours
inline int tell_ratios(const std::string& name, const scene::TimeRatios& ratios) {
  const auto tell = [](const std::string& what, const scene::RatioVerdict& v) {
    fmt::print("{:4} {}: {:.3g} printed, {:.3g} ({:.3g} to {:.3g})\n", v.holds ? "" : "NOT", what, v.printed,
               v.ours.middle, v.ours.low, v.ours.high);
  };
  for (const scene::TimeRatio& r : ratios.rows) {
    if (!r.is_reference()) tell(fmt::format("{}, {} over {}", r.place, r.row, r.reference), r.verdict);
  }
  for (const scene::RatioClaim& c : ratios.claims)
    tell(fmt::format("{}, {}, {}", c.place, c.row, c.quantity), c.verdict);
  scene::write_ratios(name, ratios, ".");
  return 0;
}

/// The body of main(): a failure is a sentence and exit code 1.
inline int speed_main(const char* program, int (*bench)(int, char**), int argc, char** argv) {
  try {
    return bench(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program, error.what());
    return 1;
  }
}

}  // namespace nlmech::chapters
