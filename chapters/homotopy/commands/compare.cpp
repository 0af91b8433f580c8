#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "chapters/homotopy/commands/commands.hpp"
#include "chapters/homotopy/commands/commands_typed.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using algebraic::TypedSolution;
using algebraic::TypedSolver;
using algebraic::TypedSystem;

struct CompareOptions {
  TypedRoots roots;
  std::string methods = "all", box, plot;
  int starts = 0;
};

void declare(scene::Options& options, CompareOptions& typed) {
  declare_roots(options, typed.roots);
  options.add("--methods", typed.methods,
              "solvers: all, or names separated by commas; an unknown name lists all");
  options
      .add("--starts", typed.starts,
           "number of pseudo-random starts, the same in each run (default 0: from --start alone)")
      .range(0, 100'000);
  options.add(
      "--box", typed.box,
      "where the starts lie: \"x=-5:5, y=0:2\" (default: within 10 times the size of each start value)");
  options.add(
      "--plot", typed.plot,
      "NAME.svg: digits against evaluations; with --starts, for two unknowns, the starts that lead to a "
      "root, for the first six methods");
}

/// Runs of one solver from all starts, at least one.
using Runs = std::vector<TypedSolution>;

double iterations_of(const TypedSolution& run) {
  return static_cast<double>(run.report.statistics.steps + run.report.statistics.rejected);
}
double evaluations_of(const TypedSolution& run) {
  return static_cast<double>(run.report.statistics.right_hand_sides);
}

/// Median of a quantity of the successful runs, as text; empty without one.
std::string median_text(const Runs& runs, double (*quantity)(const TypedSolution&)) {
  std::vector<double> values;
  for (const TypedSolution& run : runs) {
    if (run.status.ok()) values.push_back(quantity(run));
  }
  return values.empty() ? "" : fmt::format("{:.3g}", median(values));
}

std::vector<Eigen::VectorXd> starts_of(const CompareOptions& typed, const TypedSystem& system) {
  if (typed.starts == 0) return {system.start("--start", typed.roots.start)};
  if (typed.box.empty())
    return starts_around(system, system.start("--start", typed.roots.start), 10, typed.starts);
  const algebraic::Box box = box_of(system, typed.box);
  std::vector<Eigen::VectorXd> all =
      starts_around(system, Eigen::VectorXd::Zero(system.size()), 1, typed.starts);
  for (Eigen::VectorXd& x : all) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const program::Interval& side = box[static_cast<std::size_t>(i)];
      x[i] = side.low + side.width() * (x[i] + 1) / 2;
    }
    x = x.cwiseMax(system.lower()).cwiseMin(system.upper()).eval();
  }
  return all;
}

/// One run; a short one is repeated for its time.
TypedSolution timed_run(const TypedSolver& solver, const TypedSystem& system, const Eigen::VectorXd& start,
                        const TypedRoots& roots) {
  TypedSolution run = solve_by(solver, system, start, roots.tolerance, roots.iterations);
  for (int k = 0; k < 4 && run.seconds < 1e-3; ++k)
    run.seconds =
        std::min(run.seconds, solve_by(solver, system, start, roots.tolerance, roots.iterations).seconds);
  return run;
}

std::string single_rows(const std::vector<Runs>& all) {
  std::string text = "method,outcome,root,digits,iterations,evaluations,jacobians,seconds\n";
  for (const Runs& runs : all) {
    const TypedSolution& run = runs.front();
    text +=
        fmt::format("{},{},{},{},{},{},{},{:.2g}\n", run.solver, to_string(run.status.outcome()),
                    to_string(run.root.kind), run.status.ok() ? fmt::format("{:.1f}", run.digits) : "",
                    iterations_of(run), evaluations_of(run), run.report.statistics.jacobians, run.seconds);
  }
  return text;
}

std::string share_rows(const std::vector<Runs>& all) {
  std::string text = "method,starts,arrived,share,iterations,evaluations,seconds\n";
  for (const Runs& runs : all) {
    const auto arrived =
        std::ranges::count_if(runs, [](const TypedSolution& run) { return run.status.ok(); });
    text += fmt::format("{},{},{},{:.3g},{},{},{}\n", runs.front().solver, runs.size(), arrived,
                        static_cast<double>(arrived) / static_cast<double>(runs.size()),
                        median_text(runs, iterations_of), median_text(runs, evaluations_of),
                        median_text(runs, [](const TypedSolution& run) { return run.seconds; }));
  }
  return text;
}

/// Digits against evaluations for tolerances of 1e-1 to 1e-13.
scene::Figure work_picture(const std::vector<TypedSolver>& solvers, const TypedSystem& system,
                           const CompareOptions& typed) {
  scene::Show show(false);
  scene::Panel& panel = show.plot("Digits of the root against evaluations of F", "evaluations of F", "digits")
                            .log_x()
                            .key("outside right");
  show.figure().size(1240, 560);
  const Eigen::VectorXd start = system.start("--start", typed.roots.start);
  for (const TypedSolver& solver : solvers) {
    std::vector<double> work, digits;
    for (double tolerance = 0.1; tolerance > 1e-14; tolerance /= 100) {
      const TypedSolution run = solve_by(solver, system, start, tolerance, typed.roots.iterations);
      if (!run.report.status.ok() || run.root.kind == algebraic::CheckedRoot::Kind::none) continue;
      work.push_back(std::max(evaluations_of(run), 1.));
      digits.push_back(run.digits);
    }
    if (!work.empty()) panel.curve(solver.name, work, digits, scene::linespoints());
  }
  return *show.take().figure;
}

/// The starts that lead to each root, a panel a method.
scene::Figure basin_picture(const std::vector<Runs>& all, const std::vector<Eigen::VectorXd>& starts,
                            const TypedSystem& system) {
  scene::Show show(false);
  scene::Plot& plot = show.plots("Starts by the root to which they lead");
  const std::size_t count = std::min<std::size_t>(all.size(), 6);
  plot.size(static_cast<int>(200 + 320 * count), 420).columns({"panel", "curve", "x", "y"});
  std::vector<Eigen::VectorXd> roots;
  for (std::size_t k = 0; k < count; ++k) {
    const Runs& runs = all[k];
    std::map<std::size_t, std::array<std::vector<double>, 2>> groups;  // 0: no root
    for (std::size_t i = 0; i < starts.size(); ++i) {
      std::size_t group = 0;
      if (runs[i].status.ok()) {
        const auto same = std::ranges::find_if(roots, [&](const Eigen::VectorXd& root) {
          return (root - runs[i].root.x).norm() <= 1e-5 * (root.norm() + runs[i].root.x.norm());
        });
        group = static_cast<std::size_t>(same - roots.begin()) + 1;
        if (same == roots.end()) roots.push_back(runs[i].root.x);
      }
      groups[group][0].push_back(starts[i][0]);
      groups[group][1].push_back(starts[i][1]);
    }
    scene::Panel& panel =
        plot.panel(scene::without_markup(system.names()[0]), scene::without_markup(system.names()[1]))
            .caption(scene::without_markup(runs.front().solver))
            .key("off");
    for (const auto& [group, x] : groups)
      panel.curve("", x[0], x[1], scene::points(group == 0 ? 8 : static_cast<int>((group - 1) % 7) + 1));
  }
  return *show.take().figure;
}

void compare_solvers(const CompareOptions& typed) {
  const TypedSystem system = system_of(typed.roots, names_in_box(typed.box));
  if (!typed.box.empty() && typed.starts == 0)
    throw input_error("--box {}: needs a number of --starts", typed.box);
  const std::vector<TypedSolver> solvers =
      solvers_of(system, "--methods",
                 typed.methods == "all" ? std::vector<std::string>{} : scene::split(typed.methods, ','));
  const std::vector<Eigen::VectorXd> starts = starts_of(typed, system);
  const scene::Picture picture(typed.plot);
  if (picture.wanted() && typed.starts > 0 && system.size() != 2)
    throw input_error("--plot {}: the starts of {} unknowns have no picture; it takes two", typed.plot,
                      system.size());
  std::vector<Runs> all;
  for (const TypedSolver& solver : solvers) {
    Runs& runs = all.emplace_back();
    for (const Eigen::VectorXd& start : starts)
      runs.push_back(typed.starts == 0
                         ? timed_run(solver, system, start, typed.roots)
                         : solve_by(solver, system, start, typed.roots.tolerance, typed.roots.iterations));
  }
  scene::print_result(typed.starts == 0 ? single_rows(all) : share_rows(all));
  if (!picture.wanted()) return;
  picture.draw([&] {
    return typed.starts == 0 ? work_picture(solvers, system, typed) : basin_picture(all, starts, system);
  });
}

}  // namespace

void add_compare_command(scene::Commands& all) {
  all.add(
      "compare",
      "Run solvers on typed equations F(x) = 0; prints a row for each as CSV: method,outcome,root,digits (of "
      "its end, against the root near it),iterations,evaluations,jacobians,seconds; with --starts method,"
      "starts,arrived,share and medians of the runs that arrive: iterations,evaluations,seconds",
      declare, compare_solvers);
}

}  // namespace nlmech::chapters::homotopy
