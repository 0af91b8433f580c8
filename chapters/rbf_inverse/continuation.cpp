#include "nlmech/bvp/continuation.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;
using scene::Workshop;

/// A point of a branch, without its solution.
struct Spot {
  double parameter, cost, x2, lambda1;
};
struct Line {
  DuffingCase which;
  bool in_beta;
  std::vector<Spot> points, folds;
  std::string status;
};

Spot spot(const bvp::ExtremalProblem& problem, const bvp::BranchPoint& p) {
  const Eigen::VectorXd z = p.solution.first();
  return {p.parameter, cost_of(problem, p.solution), z[1], z[2]};
}

Line follow(const DuffingRuns& runs, DuffingCase which, bool in_beta, Workshop& w) {
  bvp::DuffingSettings settings = printed_settings(which, 2);
  settings.continued = in_beta ? bvp::Continued::parameter : bvp::Continued::final_time;
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  bvp::Start start = start_from(best_of(runs, w, which).solution);
  start.parameters = problem.own_parameters();
  bvp::ContinuationOptions options;
  options.first_step = in_beta ? 0.05 : 0.02;
  options.low = in_beta ? 0.05 : 0.4;
  options.high = in_beta ? 25 : 8;
  options.folds = w.quick() ? 1 : 4;
  options.points = w.quick() ? 60 : 200;
  options.solve.tolerance = 1e-8;
  options.solve.reflight = bvp::Reflight::none;
  const bvp::Branch branch = continue_branch(problem, start, options);
  Line line{which, in_beta, {}, {}, branch.status.ok() ? "" : std::string(branch.status.sentence())};
  for (const bvp::BranchPoint& p : branch.points) line.points.push_back(spot(problem, p));
  for (const bvp::BranchPoint& p : branch.folds) line.folds.push_back(spot(problem, p));
  return line;
}

using Lines = std::vector<Line>;

Lines compute(const DuffingRuns& runs, Workshop& w) {
  Lines lines;
  for (const bool in_beta : {false, true})
    for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed})
      lines.push_back(follow(runs, which, in_beta, w));
  return lines;
}

scene::Figure draw(const Lines& lines) {
  ControlCurves figure("Branches turn back: larger T and beta are on others");
  for (const bool in_beta : {false, true}) {
    figure.panel(in_beta ? "{/:Italic β}, {/:Italic T} = 2" : "{/:Italic T} (s), {/:Italic β} = 0.9",
                 in_beta ? "" : "cost {/:Italic J}");
    for (const Line& line : lines) {
      if (line.in_beta != in_beta) continue;
      const bool is_free = line.which == DuffingCase::free;
      figure.begin(is_free ? "free final state" : "final state given", is_free ? "l1" : "l5");
      for (const Spot& p : line.points) figure.add(p.parameter, p.cost);
      if (line.folds.empty()) continue;
      figure.begin("its folds", is_free ? "o1" : "o5");
      for (const Spot& p : line.folds) figure.add(p.parameter, p.cost);
    }
    figure.with("logy", "1").with("yrange", "[1:1e6]").with("key", in_beta ? "off" : "top right");
  }
  figure.overall("width", "900");
  return figure.take();
}

scene::Table tabulate(const Lines& lines) {
  scene::Table table({{"case"},
                      {"parameter"},
                      {"place"},
                      {"at", 8},
                      {"cost there", 6},
                      {"lambda1(0)", 6},
                      {"how the branch ended"}});
  for (const Line& line : lines) {
    const auto row = [&](const std::string& place, const Spot& p, const std::string& remark) {
      table.add({std::string(to_string(line.which)), std::string(line.in_beta ? "beta" : "T"), place,
                 p.parameter, p.cost, p.lambda1, remark});
    };
    for (std::size_t k = 0; k < line.folds.size(); ++k) row(fmt::format("fold {}", k + 1), line.folds[k], "");
    if (!line.points.empty()) row("end", line.points.back(), line.status.empty() ? "as asked" : line.status);
  }
  return table;
}

std::vector<scene::Quantity> promises(const Lines& lines) {
  const auto first = [&](DuffingCase which, bool in_beta) {
    for (const Line& line : lines)
      if (line.which == which && line.in_beta == in_beta && !line.points.empty())
        return line.folds.empty() ? line.points.back().parameter : line.folds.front().parameter;
    return std::nan("");
  };
  const auto fold = [&](const char* name, DuffingCase which, bool in_beta, double known, double digits) {
    return scene::Quantity{
        name,           in_beta ? "1" : "s", first(which, in_beta),
        known - digits, known + digits,      "recorded; it steps up to the turn or meets it by arclength"};
  };
  return {fold("first fold in T, free", DuffingCase::free, false, 2.9635, 0.006),
          fold("first fold in T, fixed", DuffingCase::fixed, false, 2.678, 0.004),
          fold("end of the branch in beta, free", DuffingCase::free, true, 18.375, 0.2),
          fold("first fold in beta, fixed", DuffingCase::fixed, true, 1.756, 0.01)};
}

}  // namespace

void add_continuation(scene::Chapter& chapter, const DuffingRuns& runs) {
  const auto& run = chapter.add_run<Lines>(
      "branches", "from the cheapest extremals at T = 2 upward in T, and in beta; four folds at most",
      {&run_of(runs.extremals, DuffingCase::free), &run_of(runs.extremals, DuffingCase::fixed)},
      [runs](Workshop& w) { return compute(runs, w); });
  chapter.add({.name = "continuation",
               .title = "Branches of extremals in T and beta, with their folds",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) {
                 const Lines& lines = w.result(run);
                 return scene::Showing{draw(lines), tabulate(lines), promises(lines)};
               }});
}

}  // namespace nlmech::chapters
