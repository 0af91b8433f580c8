/// @file
/// `homotopy_bench`: energy trust region against KINSOL's line search and against path following on toggles
/// of many elements, a path of 1000 elements through its limit points, and the default of `homotopy solve`
/// against KINSOL and GSL, by Google Benchmark. Exit code 1 if a claim does not hold.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/commands/commands_typed.hpp"
#include "chapters/homotopy/solvers/test_systems.hpp"
#include "chapters/speed.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/paths/path_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/peers/algebraic/gsl_hybrid.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"

namespace {

using namespace nlmech;
using Eigen::VectorXd;

std::string name_of(const std::string& method, int elements, double height, double load) {
  return fmt::format("{}, {} elements, {} in, {} lb", method, elements, height, load);
}

/// Adds the solution of a toggle from rest under the given load. A line search solves the toggle of 0.32 in
/// under 27.11 lb, but none past its limit load.
template <class Method>
void add_solver(chapters::Speed& all, const std::string& name, int elements, double height, double load,
                const Method& method) {
  all.add(name_of(name, elements, height, load), [=] {
    const frames::ToggleFrame t = make_frame(frames::Toggle{.height = height, .elements = elements});
    frames::Equilibrium equations(t.frame, t.load, load);
    VectorXd x = VectorXd::Zero(t.frame.size());
    return find_root(method, equations, x).status.ok();
  });
}

std::string path_of(int elements) {
  return fmt::format("path through both limit points, {} elements", elements);
}

/// Adds the path from rest through both limit points, which are located to rounding.
void add_path(chapters::Speed& all, int elements) {
  all.add(path_of(elements), [=] {
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
  });
}

struct Start {
  algebraic::TypedSystem system;
  VectorXd at;
};

/// Adds the default of `homotopy solve` and the peers on those classical systems that all of them solve from
/// the standard start; every solver's end is checked alike.
void add_test_set(chapters::Speed& all) {
  const double tolerance = 1e-10;
  const int iterations = 300;
  const std::string by_default = "classical systems, automatic";
  const std::vector<std::pair<std::string, double>> peers = {{"kinsol", 1}, {"gsl-hybrid", 1.5}};
  const auto solves = [=](const Start& start, const std::string& name) {
    const auto solver = chapters::homotopy::solvers_of(start.system, "--method", {name}).front();
    return solve_by(solver, start.system, start.at, tolerance, iterations).status.ok();
  };
  std::vector<Start> starts;
  for (const chapters::homotopy::TestSystem& test : chapters::homotopy::test_systems()) {
    const algebraic::TypedSystem system(program::SourceText(test.name, test.text));
    Start start{system, system.start("--start", "")};
    if (std::ranges::all_of(peers, [&](const auto& peer) { return solves(start, peer.first); }))
      starts.push_back(std::move(start));
  }
  all.add(by_default, [=] {
    return std::ranges::all_of(starts, [&](const Start& start) {
      int tried = 0;
      return solve_by_several(start.system, start.at, tolerance, iterations, tried).status.ok();
    });
  });
  for (const auto& [name, least] : peers) {
    const std::string row = "classical systems, " + name;
    all.add(row, [=, peer = name] {
      return std::ranges::all_of(starts, [&](const Start& start) { return solves(start, peer); });
    });
    all.claim(
        by_default, row, least,
        fmt::format("solve by default against {}, {} classical systems that all solve", name, starts.size()));
  }
}

void rows(chapters::Speed& all) {
  if (peers::kinsol_available() && peers::gsl_hybrid_available()) add_test_set(all);
  const algebraic::EnergyTrustRegion energy;
  const char *const method = "energy-trust-region", *const seconds = "two seconds";
  for (const int elements : {10, 100, 1000}) add_path(all, elements);
  add_solver(all, method, 1000, 0.44, 44, energy);
  add_solver(all, "riks", 1000, 0.44, 44, algebraic::ArcLength{});
  all.add_budget(seconds, 2e6);
  all.claim(path_of(1000), seconds, 1, "1000 elements traced through both limit points in two seconds");
  const peers::Kinsol kinsol{.tolerance = 1e-6, .iterations = 10'000};
  for (const auto& [elements, least] : {std::pair{4, 1.2}, std::pair{64, 2.5}}) {
    add_solver(all, method, elements, 0.32, 27.11, energy);
    if (peers::kinsol_available()) add_solver(all, "kinsol", elements, 0.32, 27.11, kinsol);
    all.claim(name_of(method, elements, 0.32, 27.11), name_of("kinsol", elements, 0.32, 27.11), least,
              fmt::format("energy trust region against KINSOL's line search, {} elements", elements));
  }
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("homotopy", &rows, argc, argv); }
