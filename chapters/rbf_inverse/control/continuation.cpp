#include "nlmech/bvp/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"

namespace nlmech::chapters::rbf_inverse::continuation {
namespace {

using bvp::DuffingCase;

/// A point of a branch, without its solution.
struct Spot {
  double parameter, cost, lambda1;
};
struct Line {
  DuffingCase which;
  bool in_beta;  ///< else in T
  std::vector<Spot> points, folds;
  std::string end;  ///< how the branch ended
};

Line follow(DuffingCase which, const bvp::Multistart& from, bool in_beta, bool quick) {
  bvp::DuffingSettings settings = printed_settings(which);
  settings.continued = in_beta ? bvp::Continued::parameter : bvp::Continued::final_time;
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  bvp::Start start = start_from(cheapest_of(from).solution);
  start.parameters = problem.own_parameters();
  bvp::ContinuationOptions options;
  options.first_step = in_beta ? 0.05 : 0.02;
  options.low = in_beta ? 0.05 : 0.4;
  options.high = in_beta ? 25 : 8;
  options.folds = quick ? 1 : 4;
  options.points = quick ? 60 : 200;
  options.solve.tolerance = 1e-8;
  options.solve.verification = bvp::Verification::none;
  const bvp::Branch branch = continue_branch(problem, start, options);
  const auto spots = [&](const std::vector<bvp::BranchPoint>& points) {
    std::vector<Spot> all;
    for (const bvp::BranchPoint& p : points)
      all.push_back({p.parameter, cost_of(problem, p.solution), p.solution.first()[2]});
    return all;
  };
  return {which, in_beta, spots(branch.points), spots(branch.folds),
          branch.status.ok() ? "as asked" : std::string(branch.status.sentence())};
}

std::vector<Line> compute(const bvp::Multistart& free, const bvp::Multistart& fixed, bool quick) {
  return {follow(DuffingCase::free, free, false, quick), follow(DuffingCase::fixed, fixed, false, quick),
          follow(DuffingCase::free, free, true, quick), follow(DuffingCase::fixed, fixed, true, quick)};
}

void draw(const std::vector<Line>& lines, scene::Show& show) {
  scene::Plot& plot = show.plots("Branches turn back: larger T and beta are on others");
  plot.size(900, 480).columns({"panel", "curve", "x", "y"});
  scene::Panel& in_time = plot.panel("{/:Italic T} (s), {/:Italic β} = 0.9", "cost {/:Italic J}");
  scene::Panel& in_beta = plot.panel("{/:Italic β}, {/:Italic T} = 2", "").key("off");
  for (const Line& line : lines) {
    scene::Panel& panel = (line.in_beta ? in_beta : in_time);
    const bool is_free = line.which == DuffingCase::free;
    const int style = is_free ? 1 : 5;
    panel.curve(is_free ? "free final state" : "final state given", line.points, &Spot::parameter,
                &Spot::cost, scene::lines(style));
    if (!line.folds.empty())
      panel.curve("its folds", line.folds, &Spot::parameter, &Spot::cost, {"points pointsize 1.2", style});
  }
  in_time.log_y(1, 1e6);
  in_beta.log_y(1, 1e6);
}

/// A fold, or where a branch ended.
struct Row {
  const Line* line;
  std::string place;
  Spot at;
  std::string remark = {};
};

void put(const std::vector<Line>& lines, scene::Show& show) {
  draw(lines, show);
  std::vector<Row> rows;
  for (const Line& line : lines) {
    for (std::size_t k = 0; k < line.folds.size(); ++k)
      rows.push_back({&line, fmt::format("fold {}", k + 1), line.folds[k]});
    if (!line.points.empty()) rows.push_back({&line, "end", line.points.back(), line.end});
  }
  show.table(rows, {{"case", [](const Row& r) { return to_string(r.line->which); }},
                    {"parameter", [](const Row& r) { return r.line->in_beta ? "beta" : "T"; }},
                    {"place", &Row::place},
                    {"at", [](const Row& r) { return r.at.parameter; }, 8},
                    {"cost there", [](const Row& r) { return r.at.cost; }, 6},
                    {"lambda1(0)", [](const Row& r) { return r.at.lambda1; }, 6},
                    {"how the branch ended", &Row::remark}});
  const auto first = [&](const char* name, DuffingCase which, bool in_beta, double known, double off) {
    const auto row = std::ranges::find_if(
        rows, [&](const Row& r) { return r.line->which == which && r.line->in_beta == in_beta; });
    show.between(name, {row == rows.end() ? NAN : row->at.parameter, in_beta ? "1" : "s"}, known - off,
                 known + off, "recorded; it steps up to the turn or meets it by arclength");
  };
  first("first fold in T, free", DuffingCase::free, false, 2.9635, 0.006);
  first("first fold in T, fixed", DuffingCase::fixed, false, 2.678, 0.004);
  first("end of the branch in beta, free", DuffingCase::free, true, 18.375, 0.2);
  first("first fold in beta, fixed", DuffingCase::fixed, true, 1.756, 0.01);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result lines(
      "branches", "from the cheapest extremals at T = 2 upward in T, and in beta; four folds at most",
      compute, extremals(DuffingCase::free), extremals(DuffingCase::fixed));
  return {{.name = "continuation",
           .title = "Branches of extremals in T and beta, with their folds",
           .content = scene::Content(put, lines)}};
}

}  // namespace nlmech::chapters::rbf_inverse::continuation
