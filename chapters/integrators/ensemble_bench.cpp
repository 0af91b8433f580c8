/// @file
/// `integrators_ensemble_bench`: Lorenz equations for many initial states by Series, in SIMD registers
/// against one by one; by Google Benchmark. Exit code 1 if a claim does not hold.
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "chapters/floor.hpp"
#include "chapters/speed.hpp"
#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/problems/texts.hpp"

namespace {

using namespace nlmech;

/// Adaptive steps, with equations given at run time.
void add_series(chapters::Speed& all, double tolerance) {
  static const ivp::System system(problems::TextProblem("lorenz"));
  constexpr int count = 512;
  constexpr double until = 5;
  const ivp::Series method{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
  std::vector<ivp::Start> starts;
  double steps = 0;
  for (int i = 0; i < count; ++i) {
    starts.push_back({&system, {0.01 * i, 1, 0.02 * i}, 0, until, {}, {}});
    steps += static_cast<double>(ivp::detail::alone(starts.back(), method).statistics.steps);
  }
  const std::string name = fmt::format("lorenz, series to {:g}, {} starts, ", tolerance, count);
  all.add(name + "one by one", [=] {
    for (const auto& start : starts) {
      auto end = ivp::detail::alone(start, method);
      benchmark::DoNotOptimize(end);
    }
  });
  // AVX-512 is promised 2.5 times: a single run has vector registers itself and shares machine code.
  // Processors that split a register of eight lanes in two have the same lower bound for both sets.
  // Multiply-adds: two products of series, and some ten more per order.
  const double n = ivp::series_order(tolerance), operations = steps * (n * n + 10 * n);
  for (const auto& [lanes, least] : {std::pair{InstructionSet::avx2, 2.0}, {InstructionSet::avx512, 2.5}}) {
    const InstructionSet set = lanes;
    if (!available(set)) continue;
    const std::string in_lanes = fmt::format("{}lanes of {}", name, to_string(set));
    all.add(in_lanes,
            [=] { return ivp::integrate_all(std::span<const ivp::Start>(starts), method, 1, set); });
    all.add(in_lanes + ", multiply-adds alone", [=] { return chapters::multiply_adds(set, operations); });
    all.claim(in_lanes, name + "one by one", least, in_lanes + " against one by one");
  }
}

void rows(chapters::Speed& all) {
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) add_series(all, tolerance);
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("integrators_ensemble", &rows, argc, argv);
}
