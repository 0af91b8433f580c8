/// @file
/// `rbf_ivp_bench`: collocation against the best of the other libraries at equal accuracy, and what the
/// type-erased System costs, by Google Benchmark. Writes results/bench/rbf_ivp.json and tables/BENCH.md under
/// the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/sweeps.hpp"
#include "nlmech/comparison/accuracy.hpp"
#include "nlmech/ivp/explicit_runge_kutta.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/scene/bench.hpp"

namespace {

using namespace nlmech;
using chapters::Case;
using comparison::Contender;
using comparison::Setting;

constexpr double wanted = 1e-6;  // six digits, which most methods reach

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

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

template <int n>
Work work_of(const Case<n>& c, const Contender& contender, const Setting& setting) {
  return {fmt::format("{}, {}", c.name, contender.label()),
          [&c, run = comparison::integrator<n>(contender, setting)] {
            auto end = run(c.system, c.x0, c.t0, c.t1, {}, {});
            benchmark::DoNotOptimize(end);
          }};
}

/// The fastest setting of the sweep that has the wanted digits; nothing if none has.
template <int n>
std::optional<Work> fastest(const Case<n>& c, const Contender& contender) {
  std::optional<Work> best;
  double least = HUGE_VAL;
  for (const Setting& setting : contender.settings) {
    const ivp::Limits limits{.steps = 2'000'000};
    const auto accuracy = comparison::accuracy_of(c, comparison::integrator<n>(contender, setting), limits);
    if (!accuracy.error || *accuracy.error > wanted) continue;
    Work work = work_of(c, contender, setting);
    const double seconds = time_repeats(work.run, 3).smallest;
    if (seconds < least) {
      least = seconds;
      best = std::move(work);
    }
  }
  return best;
}

/// Ours of one problem, and the fastest library on it as "best library".
template <int n>
std::vector<Work> rivals(const Case<n>& c, const chapters::StepScales& scales,
                         const std::vector<std::string>& ours) {
  std::vector<Work> all;
  std::optional<Work> best;
  double least = HUGE_VAL;
  for (const Contender& contender : chapters::contenders(scales, false)) {
    const bool mine = std::find(ours.begin(), ours.end(), contender.label()) != ours.end();
    const bool library = contender.kind == comparison::Kind::explicit_ && contender.name != "ode45";
    if (!mine && !library) continue;
    const auto work = fastest(c, contender);
    if (!work) continue;
    if (mine) {
      all.push_back(*work);
    } else if (const double seconds = time_repeats(work->run, 3).smallest; seconds < least) {
      least = seconds;
      best = work;
    }
  }
  if (best) {
    fmt::print("best library: {}\n", best->name);
    all.push_back({c.name + ", best library", best->run});
  }
  return all;
}

/// The same method on the same problem, behind the virtual interface and inlined.
std::vector<Work> erasure() {
  const auto run = [](const auto& system) {
    auto end = ivp::integrate(system, problems::Duffing::initial_state(), 0, 500, ivp::Rk4{.step = 0.02});
    benchmark::DoNotOptimize(end);
  };
  return {{"rk4 through System", [run, system = ivp::System(problems::Duffing{})] { run(system); }},
          {"rk4 inlined", [run, system = ivp::Direct(problems::Duffing{})] { run(system); }}};
}

/// What the chapter says of speed: that collocation as the dissertation writes it does not win, and what
/// nodes alone would change.
std::vector<scene::SpeedClaim> claims(const std::vector<Work>& all) {
  const auto has = [&all](const std::string& name) {
    return std::any_of(all.begin(), all.end(), [&](const Work& w) { return w.name == name; });
  };
  std::vector<scene::SpeedClaim> out;
  const auto add = [&](const std::string& fast, const std::string& slow, double least) {
    if (has(fast) && has(slow)) out.push_back({fmt::format("{} against {}", fast, slow), fast, slow, least});
  };
  add("duffing, best library", "duffing, lgl-coll, N = 35", 5);
  add("three-masses, best library", "three-masses, lgl-coll, N = 35", 20);
  add("three-masses, best library", "three-masses, rbf-coll, N = 35", 20);
  add("duffing, radau-coll, N = 17", "duffing, lgl-coll, N = 35", 1.5);
  add("three-masses, radau-coll, N = 17", "three-masses, lgl-coll, N = 35", 1.5);
  add("rk4 through System", "rk4 inlined", 0.5);  // at most twice the time
  return out;
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

  const std::vector<std::string> ours = {"rbf-coll, N = 35", "lgl-coll, N = 35", "radau-coll, N = 17",
                                         "mcpi, N = 17", "rk6"};
  std::vector<Work> all = rivals(chapters::free_duffing_case(), chapters::free_duffing_steps(), ours);
  for (const Work& w : rivals(chapters::three_mass_case(), chapters::three_mass_steps(), ours))
    all.push_back(w);
  for (const Work& w : erasure()) all.push_back(w);
  for (const Work& w : all) {
    benchmark::RegisterBenchmark(w.name.c_str(), [&w](benchmark::State& state) {
      for (auto _ : state) w.run();
    })->Unit(benchmark::kMicrosecond);
  }
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);

  std::vector<scene::SpeedResult> results;
  bool held = true;
  for (const scene::SpeedClaim& claim : claims(all)) {
    results.push_back(scene::judge_claim(claim, keeper.series()));
    const scene::SpeedResult& r = results.back();
    held = held && r.held;
    fmt::print("{:4} {}: {:.2f} ({:.2f} to {:.2f}), promised {:g}\n", r.held ? "" : "NOT", claim.text,
               r.ratio, r.low, r.high, claim.least);
  }
  scene::write_bench("rbf_ivp", keeper.series(), results, ".");
  return held ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return bench(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rbf_ivp_bench: {}\n", error.what());
    return 1;
  }
}
