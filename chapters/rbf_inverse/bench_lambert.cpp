/// @file
/// `rbf_inverse_bench_lambert`: a Lambert solve by Izzo's method against its promise of half a microsecond
/// and against collocation, and a grid of 2000 x 2000 cells, by Google Benchmark.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <vector>

#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/porkchop.hpp"
#include "nlmech/orbit/transfer.hpp"

namespace {

using namespace nlmech;

/// Problems of all kinds: ellipses, hyperbolas, short and long ways.
const std::vector<orbit::LambertProblem>& problems() {
  static const std::vector<orbit::LambertProblem> all = [] {
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    std::vector<orbit::LambertProblem> made(4096);
    for (orbit::LambertProblem& p : made) {
      p.from = {normal(engine), normal(engine), normal(engine)};
      p.to = {normal(engine), normal(engine), normal(engine)};
      p.time = std::pow(10, 2 * uniform(engine) - 1);
    }
    return made;
  }();
  return all;
}

/// One solve an item; the claim is at most 0.5 us of CPU time.
void izzo(benchmark::State& state) {
  bool long_way = false;
  for (auto _ : state) {
    long_way = !long_way;
    for (const orbit::LambertProblem& p : problems())
      benchmark::DoNotOptimize(orbit::solve_lambert(p, {long_way, 0, orbit::LambertBranch::low}).v1);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(problems().size()));
}
BENCHMARK(izzo)->Unit(benchmark::kMicrosecond);

orbit::TransferProblem printed() {
  return {{2.87e6, 5.19e6, 2.85e6}, {2.09e6, 7.82e6, 0}, 4320, {.mu = 3.986e14}};
}

void collocation_full(benchmark::State& state) {
  const orbit::TransferCollocation method{.equations = orbit::TransferEquations::positions_and_velocities};
  for (auto _ : state) benchmark::DoNotOptimize(orbit::collocate(printed(), method).v1);
}
BENCHMARK(collocation_full)->Unit(benchmark::kMicrosecond);

void collocation_positions(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(orbit::collocate(printed()).v1);
}
BENCHMARK(collocation_positions)->Unit(benchmark::kMicrosecond);

/// 2000 x 2000 cells between orbits like those of Earth and Mars; the claim is at most 5 s on two processors.
void porkchop(benchmark::State& state) {
  constexpr double mu = 1.32712440018e20, au = 1.495978707e11, day = 86400;
  orbit::PorkchopProblem p;
  p.mu = mu;
  p.from.state = orbit::state_of(orbit::from_axis(au, 0.0167, 0, 0, 1.8, 0), mu);
  p.to.state = orbit::state_of(orbit::from_axis(1.523679 * au, 0.0934, 0.0323, 0.865, 5.0, 0.3), mu);
  p.departures = {0, 780 * day, 2000};
  p.arrivals = {100 * day, 1500 * day, 2000};
  for (auto _ : state)
    benchmark::DoNotOptimize(orbit::porkchop(p, {.threads = static_cast<int>(state.range(0))}).cells.data());
}
BENCHMARK(porkchop)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
