#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/homotopy/commands/commands_typed.hpp"
#include "chapters/homotopy/solvers/test_systems.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy::test_set {
namespace {

using algebraic::TypedSolution;
using Eigen::VectorXd;

constexpr std::array scales = {1., 10., 100.};
constexpr double tolerance = 1e-10;
constexpr std::int64_t iterations = 300;

/// One solver on one system from one start.
struct Trial {
  bool has_arrived = false;
  bool is_false_claim = false;  ///< the solver claims success, and there is no root
  bool is_far = false;          ///< a success far from every root, where all are known
  double evaluations = 0;
};

/// Trials of a solver, by system and scale of the start.
struct SolverTrials {
  std::string name;
  std::vector<std::array<Trial, scales.size()>> trials;

  [[nodiscard]] int arrived(std::size_t scale) const {
    return static_cast<int>(
        std::ranges::count_if(trials, [&](const auto& row) { return row[scale].has_arrived; }));
  }
  [[nodiscard]] int false_claims() const { return count(&Trial::is_false_claim); }
  [[nodiscard]] int far() const { return count(&Trial::is_far); }
  [[nodiscard]] double evaluations() const {
    std::vector<double> all;
    for (const auto& row : trials) {
      if (row[0].has_arrived) all.push_back(row[0].evaluations);
    }
    return all.empty() ? 0 : median(all);
  }

 private:
  [[nodiscard]] int count(bool Trial::*what) const {
    int all = 0;
    for (const auto& row : trials) all += static_cast<int>(std::ranges::count(row, true, what));
    return all;
  }
};

struct TestSet {
  std::vector<TestSystem> systems;
  std::vector<SolverTrials> solvers;

  /// Null if the build has no such solver.
  [[nodiscard]] const SolverTrials* find(const std::string& name) const {
    const auto found = std::ranges::find(solvers, name, &SolverTrials::name);
    return found == solvers.end() ? nullptr : &*found;
  }
};

/// The start, multiplied by @p scale; a start of zeros is replaced by @p scale.
VectorXd scaled_start(const VectorXd& start, double scale) {
  if (scale == 1) return start;
  return start.isZero(0) ? VectorXd::Constant(start.size(), scale) : VectorXd(scale * start);
}

bool is_far_from(const TestSystem& system, const VectorXd& x) {
  return system.is_complete && std::ranges::none_of(system.roots, [&](const std::vector<double>& root) {
           const Eigen::Map<const VectorXd> known(root.data(), x.size());
           return (x - known).norm() <= 1e-6 * (1 + known.norm());
         });
}

Trial trial_of(const TestSystem& system, const TypedSolution& run) {
  return {run.status.ok(), run.status.outcome() == Outcome::spurious_root,
          run.status.ok() && (!system.has_root || is_far_from(system, run.root.x)),
          static_cast<double>(run.report.statistics.right_hand_sides)};
}

TestSet compute() {
  TestSet set;
  set.systems = test_systems();
  for (std::size_t i = 0; i < set.systems.size(); ++i) {
    const TestSystem& test = set.systems[i];
    const algebraic::TypedSystem system(program::SourceText(test.name, test.text));
    const VectorXd start = system.start("--start", "");
    for (std::size_t k = 0; k < scales.size(); ++k) {
      const VectorXd from = scaled_start(start, scales[k]);
      const auto put = [&](const std::string& name, const TypedSolution& run) {
        auto row = std::ranges::find(set.solvers, name, &SolverTrials::name);
        if (row == set.solvers.end())
          row = set.solvers.insert(row,
                                   {name, std::vector<std::array<Trial, scales.size()>>(set.systems.size())});
        row->trials[i][k] = trial_of(test, run);
      };
      int tried = 0;
      put("automatic", solve_by_several(system, from, tolerance, iterations, tried));
      for (const algebraic::TypedSolver& solver : solvers_of(system))
        if (solver.name != "energy-trust-region")  // for two of the systems
          put(solver.name, solve_by(solver, system, from, tolerance, iterations));
    }
  }
  return set;
}

void put(const TestSet& set, scene::Show& show) {
  show.table(set.solvers, {{"solver", &SolverTrials::name},
                           {"standard start", [](const SolverTrials& s) { return s.arrived(0); }},
                           {"10 times", [](const SolverTrials& s) { return s.arrived(1); }},
                           {"100 times", [](const SolverTrials& s) { return s.arrived(2); }},
                           {"claims refused", &SolverTrials::false_claims},
                           {"evaluations, median", &SolverTrials::evaluations}});
  scene::Panel& panel =
      show.plot(fmt::format("Systems solved of {}: several solvers in turn solve most", set.systems.size()),
                "", "systems solved");
  std::string tics;
  for (std::size_t i = 0; i < set.solvers.size(); ++i)
    tics += fmt::format("{}\"{}\" {}", i == 0 ? "" : ", ", set.solvers[i].name, i + 1);
  panel.set("xtics rotate by -50 (" + tics + ")")
      .key("top right")
      .place(0.09, 0.91, 0.28, 0.9)
      .x_range(0, static_cast<double>(set.solvers.size() + 1))
      .y_range(0, static_cast<double>(set.systems.size() + 5));
  for (std::size_t k = 0; k < scales.size(); ++k) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < set.solvers.size(); ++i) {
      x.push_back(static_cast<double>(i + 1));
      y.push_back(set.solvers[i].arrived(k));
    }
    panel.curve(k == 0 ? "standard start" : fmt::format("start times {}", scales[k]), x, y, scene::points());
  }
  const auto count = static_cast<double>(set.systems.size()),
             roots = static_cast<double>(std::ranges::count(set.systems, true, &TestSystem::has_root));
  int far = 0;
  for (const SolverTrials& solver : set.solvers) far += solver.far();
  show.equals("successes away from all known roots", far, 0,
              "systems without a root, or whose roots are known in closed form: none");
  show.equals("systems that automatic solves, standard starts", set.find("automatic")->arrived(0), roots,
              "all that have a root");
  const SolverTrials &newton = *set.find("newton"), &fixed_point = *set.find("fixed-point"),
                     &homotopy = *set.find("newton-homotopy");
  int beyond = 0;
  for (std::size_t i = 0; i < set.systems.size(); ++i) {
    for (std::size_t k = 0; k < scales.size(); ++k)
      beyond += !newton.trials[i][k].has_arrived &&
                (fixed_point.trials[i][k].has_arrived || homotopy.trials[i][k].has_arrived);
  }
  for (const SolverTrials* solver : {&newton, &fixed_point, &homotopy})
    show.between(fmt::format("systems that {} solves, standard starts", solver->name), solver->arrived(0), 0,
                 count, "a count of the systems");
  show.between("cases of a scalar homotopy where newton fails", beyond, 0, 3 * count,
               "a count of systems and starts");
  for (const std::string peer : {"kinsol", "gsl-hybrid"}) {
    if (const SolverTrials* const row = set.find(peer))
      show.between(fmt::format("systems that {} solves, standard starts", peer), row->arrived(0), 0,
                   set.find("automatic")->arrived(0), "no more than automatic");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result trials("solvers-on-test-systems",
                             "classical systems from their standard start, and from 10 and 100 times it; "
                             "tolerance 1e-10, 300 iterations; "
                             "a success is a root that check_root() confirms",
                             compute);
  return {{.name = "solvers-on-test-set",
           .title = "Classical systems: which solver finds a root from which start",
           .place = "our own, for two claims of chapter 2",
           .content = scene::Content(put, trials)}};
}

}  // namespace nlmech::chapters::homotopy::test_set
