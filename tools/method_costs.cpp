/// @file
/// Makes the evidence by which `integrators choose` chooses: what digits cost with every method that chooses
/// its steps, on every problem of the problem set, and what a look shows of these problems.
///
///     method_costs tables/reference        some minutes, on an idle machine
///     method_costs tables/reference looks  what looks show alone, for method_problems.csv

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "chapters/integrators/problem_set.hpp"
#include "chapters/integrators/sweep.hpp"
#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/scene/program/files.hpp"

namespace {

using namespace nlmech;
using namespace nlmech::chapters::integrators;

constexpr double close = 4;  // times the fastest, somewhere: else a method is left out

std::vector<std::string> methods() {
  std::vector<std::string> names;
  for (const std::string& name : comparison::built_method_names()) {
    if (!comparison::any_method(name).info.fixed_step()) names.push_back(name);
  }
  return names;
}

/// Of every method, the factor behind the fastest where it is least behind.
double least_behind(const std::vector<ProblemTrials>& all, std::size_t method) {
  double least = std::numeric_limits<double>::infinity();
  for (const ProblemTrials& p : all) {
    for (const double digits : {3., 6., 9., 12.}) {
      double best = std::numeric_limits<double>::infinity();
      for (const MethodTrials& m : p.methods) best = std::min(best, m.seconds_for(digits).value_or(best));
      if (const auto own = p.methods[method].seconds_for(digits); own && p.has_solution)
        least = std::min(least, *own / best);
    }
  }
  return least;
}

std::string costs(const std::vector<ProblemTrials>& all) {
  std::string text = "problem,method,tolerance,digits,steps,right-hand sides,cost\n";
  const double unit = comparison::unit_seconds();
  for (const ProblemTrials& p : all) {
    if (!p.has_solution) continue;
    for (std::size_t m = 0; m < p.methods.size(); ++m) {
      if (least_behind(all, m) > close) continue;
      for (const Trial& t : p.methods[m].trials) {
        if (!t.success()) continue;
        text += fmt::format("{},{},{:.0e},{:.2f},{},{},{:.4g}\n", p.problem, p.methods[m].method, t.tolerance,
                            t.digits(), t.work.steps + t.work.rejected, t.work.right_hand_sides,
                            t.time.smallest / unit);
      }
    }
  }
  return text;
}

std::string looks() {
  std::string text =
      "problem,form,components,switches,operations,stiffness,decay,variation,condition of tolerances\n";
  for (const SetProblem& p : problem_set()) {
    if (!p.has_solution()) continue;
    const comparison::Features f = comparison::look_at_problem(p.system, p.x0, p.t0, p.t1).features;
    text +=
        fmt::format("{},{},{},{:d},{},{:.2f},{:.2f},{:.2f},{:.3g}\n", p.name, to_string(f.form), f.components,
                    f.switches, f.operations, f.stiffness, f.decay, f.variation, p.tolerance_condition);
  }
  return text;
}

int make(const std::vector<std::string>& words) {
  if (words.empty()) {
    fmt::print(stderr, "method_costs: give the folder\n");
    return 2;
  }
  const std::filesystem::path folder = words[0];
  scene::write_whole(folder / "method_problems.csv", looks());
  if (words.size() > 1) return 0;
  const Effort effort{.loosest = 3,
                      .tightest = 13,
                      .by = 1,
                      .steps = 0,
                      .enough = std::numeric_limits<std::int64_t>::max(),
                      .seconds = 0.4,
                      .timing = 0.02};
  scene::write_whole(folder / "method_costs.csv", costs(trials_of_all(methods(), effort)));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return make({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "method_costs: {}\n", error.what());
    return 1;
  }
}
