/// @file
/// `homotopy_bench`: energy trust region against KINSOL's line search and against path following on toggles
/// of many elements, and a path of 1000 elements through its limit points, by Google Benchmark. Exit code 1
/// if a claim does not hold.
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

void rows(chapters::Speed& all) {
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
