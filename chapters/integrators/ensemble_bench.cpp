/// @file
/// `integrators_ensemble_bench`: Lorenz' equations for many initial states by Series, in registers against
/// one by one; by Google Benchmark. Writes results/bench/integrators_ensemble.json under the current folder;
/// exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "chapters/floor.hpp"
#include "chapters/speed.hpp"
#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace {

using namespace nlmech;

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

std::vector<ivp::State> states(int count) {
  std::vector<ivp::State> all;
  for (int i = 0; i < count; ++i) all.push_back({0.01 * i, 1, 0.02 * i});
  return all;
}

void tell(const Work& work, double steps) {
  fmt::print("{}: {:.2f} ns a step and trajectory\n", work.name,
             1e9 * time_repeats(work.run, 9).median / steps);
}

/// Steps of chosen length, of equations that the compiler has not seen, as typed ones.
/// @param system outlives the measurement
void add_series(const ivp::System& system, std::vector<Work>& all, std::vector<scene::SpeedClaim>& claims,
                double tolerance) {
  constexpr int count = 512;
  constexpr double until = 5;
  const ivp::Series method{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
  std::vector<ivp::Start> starts;
  for (const auto& x0 : states(count)) starts.push_back({&system, x0, 0, until, {}, {}});
  double steps = 0;
  for (const auto& start : starts)
    steps += static_cast<double>(ivp::detail::alone(start, method).statistics.steps);
  const Work alone{fmt::format("lorenz, series to {:g}, {} starts, one by one", tolerance, count), [=] {
                     for (const auto& start : starts) {
                       auto end = ivp::detail::alone(start, method);
                       benchmark::DoNotOptimize(end);
                     }
                   }};
  tell(alone, steps);
  all.push_back(alone);
  const auto add = [&](InstructionSet set, double least) {
    if (!available(set)) return;
    const Work together{
        fmt::format("lorenz, series to {:g}, {} starts, lanes of {}", tolerance, count, to_string(set)), [=] {
          auto ends = ivp::integrate_all(std::span<const ivp::Start>(starts), method, 1, set);
          benchmark::DoNotOptimize(ends);
        }};
    tell(together, steps);
    all.push_back(together);
    // Two products of series, and some ten multiply-adds an order besides.
    const double n = ivp::series_order(tolerance), operations = steps * (n * n + 10 * n);
    all.push_back({together.name + ", multiply-adds alone", [set, operations] {
                     double sum = chapters::multiply_adds(set, operations);
                     benchmark::DoNotOptimize(sum);
                   }});
    claims.push_back({fmt::format("{} against one by one", together.name), together.name, alone.name, least});
  };
  add(InstructionSet::avx2, 2);
  add(InstructionSet::avx512, 4);
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  std::vector<Work> all;
  std::vector<scene::SpeedClaim> claims;
  const ivp::System system(problems::TextProblem("lorenz"));
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) add_series(system, all, claims, tolerance);
  return chapters::judge_speed("integrators_ensemble", claims, chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("integrators_ensemble_bench", &bench, argc, argv);
}
