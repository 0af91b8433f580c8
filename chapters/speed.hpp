/// @file
/// Common part of the programs of `make bench`: each adds work and claims to a `Speed`, which measures them,
/// checks the claims and writes the results. Included by these programs alone; only they need Google
/// Benchmark.
#pragma once

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/scene/evidence/ratios.hpp"
#include "nlmech/support/instruction_set.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {

/// A measured computation.
struct Work {
  std::string name;           ///< of the series of times
  std::function<void()> run;  ///< runs the computation once
  double points = 0;          ///< converted by one run; 0: time is given per run, otherwise per point
  double seconds = 0;         ///< per run, set by fastest()
};

/// Wraps a function so that the compiler cannot remove the computation of its result.
template <class Run>
[[nodiscard]] std::function<void()> keep_result(Run run) {
  return [run = std::move(run)]() mutable {
    if constexpr (std::is_void_v<std::invoke_result_t<Run&>>) {
      run();
    } else {
      auto result = run();
      benchmark::DoNotOptimize(result);
    }
    benchmark::ClobberMemory();
  };
}

/// Powers of ten from 10^(-from/2) to 10^(-to/2); the exponents differ by stride/2.
[[nodiscard]] inline std::vector<double> half_decades(int from, int to, int stride = 1) {
  std::vector<double> all;
  for (int half = from; half <= to; half += stride) all.push_back(std::pow(10, -0.5 * half));
  return all;
}

/// Median error of runs to several end times; nothing if a run fails.
/// @param error_at returns the error of the run to the i-th time, or nothing if it fails
template <class ErrorAt>
[[nodiscard]] std::optional<double> median_error(std::size_t times, const ErrorAt& error_at) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < times; ++i) {
    const std::optional<double> error = error_at(i);
    if (!error) return std::nullopt;
    errors.push_back(*error);
  }
  return median(errors);
}

/// The fastest setting whose error is at most @p wanted; nothing if there is none.
/// @param settings cheapest first; the search stops when a time exceeds twice the least one
/// @param error of a setting; nothing if it fails
/// @param run timed with the setting
template <class Setting, class Error, class Run>
[[nodiscard]] std::optional<Work> fastest(const std::string& name, const std::vector<Setting>& settings,
                                          double wanted, const Error& error, const Run& run) {
  std::optional<Work> best;
  for (const Setting& setting : settings) {
    const std::optional<double> here = error(setting);
    if (!here || !(*here <= wanted)) continue;
    Work work{name, keep_result([run, setting] { return run(setting); })};
    work.seconds = time_repeats(work.run, 5).smallest;
    if (best && work.seconds > 2 * best->seconds) break;
    if (!best || work.seconds < best->seconds) best = std::move(work);
  }
  if (best)
    fmt::print("{}: {:.1f} us\n", name, 1e6 * best->seconds);
  else
    fmt::print("{}: {:.0e} is not reached\n", name, wanted);
  return best;
}

/// Records the CPU time of every repetition, in microseconds per run.
class TimeKeeper : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration)
        times[run.run_name.function_name].push_back(run.GetAdjustedCPUTime());
    }
  }
  std::map<std::string, std::vector<double>> times;
};

/// All measurements and claims of one program.
class Speed {
 public:
  /// Adds work. A run that returns bool is tried once and left out if it returns false.
  template <class Run>
  void add(const std::string& name, Run run) {
    if constexpr (std::is_same_v<std::invoke_result_t<Run&>, bool>) {
      if (!run()) return fmt::print("{}: fails\n", name);
    }
    add(Work{name, keep_result(std::move(run))});
  }
  /// Adds work if there is any and its name is new.
  void add(std::optional<Work> work) {
    if (work && !has(work->name)) all_.push_back(std::move(*work));
  }
  /// Adds times measured elsewhere.
  void add(scene::BenchSeries series) { others_.push_back(std::move(series)); }
  /// Adds a time limit as a series, so that a claim can compare with it.
  void add_budget(const std::string& name, double microseconds) {
    add(scene::BenchSeries{name, "us a run", std::vector<double>(11, microseconds)});
  }

  /// Is there work or a series of this name?
  [[nodiscard]] bool has(const std::string& name) const {
    return std::ranges::count(all_, name, &Work::name) +
               std::ranges::count(others_, name, &scene::BenchSeries::name) >
           0;
  }

  /// Claims that @p method takes at most 1/least of the time of @p peer. Skipped with a message if one of
  /// them was not added.
  /// @param text of the claim; empty: "method against peer"
  void claim(const std::string& method, const std::string& peer, double least, std::string text = {}) {
    if (text.empty()) text = fmt::format("{} against {}", method, peer);
    if (has(method) && has(peer))
      claims_.push_back({std::move(text), method, peer, least});
    else
      fmt::print("not measured here: {}\n", text);
  }

  /// Measures all work; returns these series and the added ones.
  [[nodiscard]] std::vector<scene::BenchSeries> measure() const {
    for (const Work& w : all_) {
      benchmark::RegisterBenchmark(w.name.c_str(), [&w](benchmark::State& state) {
        for (auto _ : state) w.run();
      })->Unit(benchmark::kMicrosecond);
    }
    TimeKeeper keeper;
    benchmark::RunSpecifiedBenchmarks(&keeper);
    std::vector<scene::BenchSeries> series;
    for (auto& [name, times] : keeper.times) {
      const double points = std::ranges::find(all_, name, &Work::name)->points;
      if (points > 0) {
        for (double& t : times) t *= 1e3 / points;
      }
      series.push_back({name, points > 0 ? "ns a point" : "us a run", times});
    }
    series.insert(series.end(), others_.begin(), others_.end());
    return series;
  }

  /// Measures all work, checks and prints the claims, and writes results/bench/<name>.json.
  /// @return exit code: 1 if a claim does not hold
  [[nodiscard]] int check_claims(const std::string& name) const {
    const std::vector<scene::BenchSeries> series = measure();
    bool held = true;
    std::vector<scene::SpeedResult> results;
    for (const scene::SpeedClaim& claim : claims_) {
      const scene::SpeedResult& r = results.emplace_back(scene::check_claim(claim, series));
      held = held && r.held;
      fmt::print("{:4} {}: {:.2f} ({:.2f} to {:.2f}), promised {:g}\n", r.held ? "" : "NOT", claim.text,
                 r.ratio, r.low, r.high, claim.least);
    }
    scene::write_bench(name, series, results, ".");
    return held ? 0 : 1;
  }

 private:
  std::vector<Work> all_;
  std::vector<scene::BenchSeries> others_;
  std::vector<scene::SpeedClaim> claims_;
};

/// Prints the ratios and writes results/ratios/<name>.json.
/// @return exit code 0: a ratio that does not hold is a finding, not a broken claim
inline int print_ratios(const std::string& name, const scene::TimeRatios& ratios) {
  const auto print = [](const std::string& what, const scene::RatioVerdict& v) {
    fmt::print("{:4} {}: {:.3g} printed, {:.3g} ({:.3g} to {:.3g})\n", v.holds ? "" : "NOT", what, v.printed,
               v.reproduced.middle, v.reproduced.low, v.reproduced.high);
  };
  for (const scene::TimeRatio& r : ratios.rows) {
    if (!r.is_reference()) print(fmt::format("{}, {} over {}", r.place, r.row, r.reference), r.verdict);
  }
  for (const scene::RatioClaim& c : ratios.claims)
    print(fmt::format("{}, {}, {}", c.place, c.row, c.quantity), c.verdict);
  scene::write_ratios(name, ratios, ".");
  return 0;
}

/// Initialises Google Benchmark with default options, which the command line can override, and calls @p body
/// with an empty `Speed`. An exception is printed and gives exit code 1.
/// @param least_time of a repetition, s
template <class Body>
int run_bench(const std::string& program, int argc, char** argv, const char* least_time, const Body& body) {
  // Random interleaving spreads disturbances of the machine over all methods.
  std::vector<std::string> defaults = {"--benchmark_repetitions=11",
                                       "--benchmark_enable_random_interleaving=true",
                                       std::string("--benchmark_min_time=") + least_time};
  std::vector<char*> options(argv, argv + argc);
  for (std::string& option : defaults) options.insert(options.begin() + 1, option.data());
  int count = static_cast<int>(options.size());
  benchmark::Initialize(&count, options.data());
  try {
    Speed speed;
    return body(speed);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program, error.what());
    return 1;
  }
}

/// The body of main() of the program `<name>_bench`; writes results/bench/<name>-<instruction set>.json.
/// @param rows adds work and claims
inline int speed_main(const std::string& name, void (*rows)(Speed&), int argc, char** argv,
                      const char* least_time = "0.02") {
  return run_bench(name + "_bench", argc, argv, least_time, [&](Speed& speed) {
    rows(speed);
    return speed.check_claims(fmt::format("{}-{}", name, to_string(best_instruction_set())));
  });
}

/// The body of main() of the program `<name>_ratios_bench`. @param compare adds work, measures and compares
inline int ratios_main(const std::string& name, scene::TimeRatios (*compare)(Speed&), int argc, char** argv) {
  return run_bench(name + "_ratios_bench", argc, argv, "0.02",
                   [&](Speed& speed) { return print_ratios(name, compare(speed)); });
}

}  // namespace nlmech::chapters
