/// @file
/// `homotopy_bench`: the energy trust region against KINSOL's line search and against paths on toggles of
/// many elements, and a path of 1000 elements through its limit points, by Google Benchmark. Writes
/// results/bench/homotopy.json under the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/speed.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/paths/path_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"

namespace {

using namespace nlmech;
using Eigen::VectorXd;

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
  chapters::begin_speed(argc, argv);

  std::vector<Work> all;
  for (Work& w : all_work()) {
    if (w.run())
      all.push_back(std::move(w));
    else
      fmt::print("{}: fails\n", w.name);
  }

  // A second to compare with, so that the promise about 1000 elements is a ratio as the others.
  std::vector<scene::BenchSeries> series = chapters::measure_speed(all);
  series.push_back({second, "us a run", std::vector<double>(11, 1e6)});
  std::vector<scene::SpeedClaim> claims = {
      {"1000 elements traced through both limit points in a second", trace(1000).name, second, 2}};
  for (const auto& [elements, least] : {std::pair{4, 1.2}, std::pair{64, 2.5}}) {
    if (!peers::kinsol_available()) break;
    const std::string where = fmt::format(", {} elements, 0.32 in, 27.11 lb", elements);
    claims.push_back({fmt::format("energy trust region against KINSOL's line search, {} elements", elements),
                      "energy-trust-region" + where, "kinsol" + where, least});
  }
  return chapters::judge_speed("homotopy", claims, series);
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("homotopy_bench", &bench, argc, argv); }
