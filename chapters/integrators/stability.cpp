#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "chapters/integrators/heat_map.hpp"
#include "chapters/integrators/sweep.hpp"

namespace nlmech::chapters::integrators::stability {
namespace {

/// Outcome of a method on a problem.
struct Ending {
  const Trial* best = nullptr;    ///< the success with the most digits; null if none
  const Trial* last = nullptr;    ///< the last run of the sweep
  const Trial* silent = nullptr;  ///< the silent failure with the tightest setting; null if none
};

Ending ending_of(const ProblemTrials& p, const MethodTrials& m) {
  Ending e;
  for (const Trial& t : m.trials) {
    e.last = &t;
    if (!t.success()) continue;
    if (p.silent_failure(t))
      e.silent = &t;
    else if (e.best == nullptr || t.digits() > e.best->digits())
      e.best = &t;
  }
  return e;
}

std::string mark(const ProblemTrials& p, const Ending& e) {
  if (e.silent != nullptr) return "!";
  if (e.best != nullptr) return "";
  const std::string& status = e.last->status;
  if (!p.has_solution) return status == "refused" ? "—" : "✓";
  const std::pair<const char*, const char*> marks[] = {
      {"refused", "—"},        {"time_limit", "…"},    {"step_limit", "…"},     {"non_finite", "∞"},
      {"step_underflow", "↓"}, {"not_converged", "×"}, {"newton_diverged", "×"}};
  for (const auto& [name, sign] : marks) {
    if (status == name) return sign;
  }
  return "×";
}

void put(const std::vector<ProblemTrials>& all, scene::Show& show) {
  HeatMap map{"Outcome and digits of each method on each problem",
              "digits",
              "! silent failure  ✓ fails as it must  — refused  … too slow  × not converged  ∞ blows up  "
              "↓ underflow",
              {"most digits of a success"},
              {},
              {},
              {}};
  for (const ProblemTrials& p : all) map.problems.push_back(p.problem);
  for (const MethodTrials& m : all.front().methods) map.methods.push_back(m.method);
  map.cell = [&](std::size_t, std::size_t problem, std::size_t method) -> HeatCell {
    const Ending e = ending_of(all[problem], all[problem].methods[method]);
    HeatCell cell{{}, mark(all[problem], e)};
    if (e.best != nullptr) cell.colour = std::min(15., e.best->digits());
    return cell;
  };
  show_heat_map(map, show);

  int ends = 0, noticed = 0;
  for (const ProblemTrials& p : all) {
    for (const MethodTrials& m : p.methods) {
      const Ending e = ending_of(p, m);
      if (p.has_solution || m.peer || !m.chooses || e.last->status == "refused") continue;
      ++ends;
      noticed += e.silent != nullptr && e.silent->tolerance < 5e-5 ? 0 : 1;
    }
  }
  show.equals(
      "our methods that choose their steps and notice where a solution ends, at tolerances below 5e-5",
      noticed, ends, "a success there is wrong; looser tolerances may step across the end of dead-end");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "stability",
           .title = "Outcome and digits of each method on each problem",
           .content = scene::Content(put, sweep())}};
}

}  // namespace nlmech::chapters::integrators::stability
