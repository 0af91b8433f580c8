/// @file
/// `integrators_ensemble_bench`: Rk4 on Lorenz' equations for many initial states, in registers against one
/// by one, compiled as this program is; by Google Benchmark. Writes results/bench/integrators_ensemble.json
/// and tables/BENCH.md under the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "chapters/speed.hpp"
#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace {

using namespace nlmech;

constexpr int count = 256, steps = 1000;

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  std::vector<ivp::State<3>> starts;
  for (int i = 0; i < count; ++i) starts.emplace_back(0.01 * i, 1, 0.02 * i);
  const ivp::Rk4 method{.step = 0.01};
  const double until = method.step * steps;
  const problems::Lorenz lorenz;
  const std::vector<Work> all = {
      {fmt::format("lorenz, rk4, {} starts, registers of {}", count, ivp::register_lanes),
       [&] {
         auto ends = ivp::integrate_all(lorenz, std::span<const ivp::State<3>>(starts), 0, until, method, 1);
         benchmark::DoNotOptimize(ends);
       }},
      {fmt::format("lorenz, rk4, {} starts, one by one", count), [&] {
         for (const ivp::State<3>& start : starts) {
           auto end = ivp::integrate(ivp::Direct(lorenz), start, 0, until, method);
           benchmark::DoNotOptimize(end);
         }
       }}};
  for (const Work& work : all) {
    fmt::print("{}: {:.2f} ns a step and trajectory\n", work.name,
               1e9 * time_repeats(work.run, 9).median / count / steps);
  }
  return chapters::judge_speed(
      "integrators_ensemble",
      {{fmt::format("{} against one by one", all[0].name), all[0].name, all[1].name, 4}},
      chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("integrators_ensemble_bench", &bench, argc, argv);
}
