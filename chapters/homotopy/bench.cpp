/// @file
/// `homotopy_bench`: the energy trust region against KINSOL's line search and against paths on toggles of
/// many elements, and a path of 1000 elements through its limit points, by Google Benchmark. Writes
/// results/bench/homotopy.json and tables/BENCH.md under the current folder; exit code 1 if a claim is not
/// held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/algebraic/energy_trust_region.hpp"
#include "nlmech/algebraic/path_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/bench.hpp"

namespace {

using namespace nlmech;
using Eigen::VectorXd;

/// Keeps the CPU time of every repetition, in microseconds a run.
class Keeper : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
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

/// A piece of work that is measured; false if it fails.
struct Work {
  std::string name;
  std::function<bool()> run;
};

/// A toggle from rest: at a height of 0.32 in under 27.11 lb, which a line search manages too, or past its
/// limit load.
template <class Method>
Work solve(const std::string& name, int elements, double height, double load, const Method& method) {
  return {fmt::format("{}, {} elements, {} in, {} lb", name, elements, height, load), [=] {
            const frames::ToggleFrame t = make_frame(frames::Toggle{.height = height, .elements = elements});
            frames::Equilibrium equations(t.frame, t.load, load);
            VectorXd x = VectorXd::Zero(t.frame.size());
            const bool done = find_root(method, equations, x).status.ok();
            benchmark::DoNotOptimize(x.data());
            return done;
          }};
}

/// The path from rest through both limit points, each to rounding.
Work trace(int elements) {
  return {fmt::format("path through both limit points, {} elements", elements), [=] {
            const frames::ToggleFrame t = make_frame(frames::Toggle{.height = 0.44, .elements = elements});
            frames::LoadedFrame equations(t.frame, t.load);
            algebraic::Path path({.first = 4}, equations, VectorXd::Zero(t.frame.size()), 0);
            std::vector<algebraic::PathPoint> here;
            std::size_t found = 0;
            bool done = path.start().ok();
            while (done && found < 2) {
              done = path.advance().ok() && path.folds(here) == Outcome::success;
              found += here.size();
            }
            return done;
          }};
}

/// A second of processor time: what a path of 1000 elements is compared with.
constexpr const char* second = "one second";

std::vector<Work> all_work() {
  const algebraic::EnergyTrustRegion energy;
  const algebraic::ArcLength path;
  std::vector<Work> all = {trace(10), trace(100), trace(1000),
                           solve("energy-trust-region", 1000, 0.44, 44., energy),
                           solve("riks", 1000, 0.44, 44., path)};
  for (const int elements : {4, 64}) {
    all.push_back(solve("energy-trust-region", elements, 0.32, 27.11, energy));
    if (peers::kinsol_available())
      all.push_back(
          solve("kinsol", elements, 0.32, 27.11, peers::Kinsol{.tolerance = 1e-6, .iterations = 10'000}));
  }
  return all;
}

int bench(int argc, char** argv) {
  // Interleaved in random order, so that a disturbance of the machine does not fall on one method.
  std::vector<std::string> defaults = {"--benchmark_repetitions=11",
                                       "--benchmark_enable_random_interleaving=true",
                                       "--benchmark_min_time=0.02"};
  std::vector<char*> options(argv, argv + argc);
  for (std::string& option : defaults) options.insert(options.begin() + 1, option.data());
  int count = static_cast<int>(options.size());
  benchmark::Initialize(&count, options.data());

  std::vector<Work> all;
  for (Work& w : all_work()) {
    if (w.run())
      all.push_back(std::move(w));
    else
      fmt::print("{}: fails\n", w.name);
  }
  for (const Work& w : all) {
    benchmark::RegisterBenchmark(w.name.c_str(), [&w](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(w.run());
    })->Unit(benchmark::kMicrosecond);
  }
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);

  // A second to compare with, so that the promise about 1000 elements is a ratio as the others.
  std::vector<scene::BenchSeries> series = keeper.series();
  series.push_back({second, "us a run", std::vector<double>(11, 1e6)});
  std::vector<scene::SpeedClaim> claims = {
      {"1000 elements traced through both limit points in a second", trace(1000).name, second, 2}};
  for (const auto& [elements, least] : {std::pair{4, 1.2}, std::pair{64, 2.5}}) {
    if (!peers::kinsol_available()) break;
    const std::string where = fmt::format(", {} elements, 0.32 in, 27.11 lb", elements);
    claims.push_back({fmt::format("energy trust region against KINSOL's line search, {} elements", elements),
                      "energy-trust-region" + where, "kinsol" + where, least});
  }
  bool held = true;
  std::vector<scene::SpeedResult> results;
  for (const scene::SpeedClaim& claim : claims) {
    results.push_back(scene::judge_claim(claim, series));
    const scene::SpeedResult& r = results.back();
    held = held && r.held;
    fmt::print("{:4} {}: {:.2f} ({:.2f} to {:.2f}), promised {:g}\n", r.held ? "" : "NOT", claim.text,
               r.ratio, r.low, r.high, claim.least);
  }
  scene::write_bench("homotopy", series, results, ".");
  return held ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return bench(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "homotopy_bench: {}\n", error.what());
    return 1;
  }
}
