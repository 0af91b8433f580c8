#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DerivativeMatrix;
using bvp::DuffingCase;
using scene::Workshop;

/// The largest error at the nodes from the cheapest extremal as start; infinite if there is no root.
double error_of(const bvp::ExtremalProblem& problem, const bvp::GlobalMethod& method,
                const bvp::Start& start) {
  const bvp::GlobalResult r = solve_global(problem, method, start);
  const NodeErrors e = node_errors(r);
  const bool root = r.report.status.ok() && std::isfinite(e.states + e.costates);
  return root ? std::max(e.states, e.costates) : HUGE_VAL;
}

constexpr std::array derivatives = {DerivativeMatrix::gaussian, DerivativeMatrix::stable_gaussian,
                                    DerivativeMatrix::polynomial};
constexpr std::array looks = {"b5", "b1", "b3"};
const char* legend_of(DerivativeMatrix d) {
  switch (d) {
    case DerivativeMatrix::gaussian: return "Gaussian, double";
    case DerivativeMatrix::stable_gaussian: return "Gaussian, all digits";
    default: return "polynomial";
  }
}

/// [derivative][setting] of one case.
using Sweep = std::array<std::vector<double>, derivatives.size()>;
struct Study {
  std::vector<double> shapes;                    ///< c T, 40 nodes
  std::vector<double> counts;                    ///< N, c = (N - 1)/(4 T)
  std::array<Sweep, 2> by_shape, by_count;       ///< free, fixed
  std::array<std::array<double, 4>, 2> by_rows;  ///< fixed, T = 1; c T = 9.75 and 7.5; four placements
};
constexpr std::array cases = {DuffingCase::free, DuffingCase::fixed};

/// Which rows the four conditions of the fixed case stand in, at both ends.
struct Placement {
  const char* name;
  int first, second;
};
constexpr std::array placements = {Placement{"x2 and lambda1 (Eq. 5.28)", 1, 2},
                                   Placement{"x2 and lambda2", 1, 3}, Placement{"x1 and x2", 0, 1},
                                   Placement{"lambda1 and lambda2", 2, 3}};

Study compute(const DuffingRuns& runs, Workshop& w) {
  Study s;
  s.shapes = {1, 1.5, 2, 3, 4, 5, 6, 7, 7.5, 8, 9, 9.75, 11, 13};
  s.counts = {10, 14, 20, 28, 40, 56, 80, 112, 200};
  if (w.quick()) {
    s.shapes = {2, 4, 5, 7.5, 9.75, 13};
    s.counts = {10, 20, 40, 80};
  }
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const bvp::ExtremalProblem problem = duffing_problem(printed_settings(cases[c], 2));
    const bvp::Start start = start_from(best_of(runs, w, cases[c]).solution);
    const auto rows = printed_rows(problem);
    for (std::size_t d = 0; d < derivatives.size(); ++d) {
      const auto at_shape = [&](double shape) {
        return error_of(problem, {.relative_shape = shape, .derivative = derivatives[d], .rows = rows},
                        start);
      };
      std::vector<double>& by_shape = s.by_shape[c][d];
      if (derivatives[d] == DerivativeMatrix::polynomial)
        by_shape.assign(s.shapes.size(), at_shape(s.shapes.front()));  // polynomials have no shape
      else
        std::transform(s.shapes.begin(), s.shapes.end(), std::back_inserter(by_shape), at_shape);
      for (const double n : s.counts) {
        // The stable basis has no need of more: its errors have ended by then.
        const bool skipped = derivatives[d] == DerivativeMatrix::stable_gaussian && n > 80;
        s.by_count[c][d].push_back(skipped ? std::nan("")
                                           : error_of(problem,
                                                      {.nodes = static_cast<int>(n),
                                                       .relative_shape = (n - 1) / 4,
                                                       .derivative = derivatives[d],
                                                       .rows = rows},
                                                      start));
      }
    }
  }
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(DuffingCase::fixed, 1));
  const bvp::Start start = start_from(best_of(runs, w, DuffingCase::fixed, 0).solution);
  for (std::size_t shape = 0; shape < 2; ++shape)
    for (std::size_t p = 0; p < placements.size(); ++p) {
      const int a = placements[p].first, b = placements[p].second;
      s.by_rows[shape][p] = error_of(problem,
                                     {.relative_shape = shape == 0 ? 9.75 : 7.5,
                                      .rows = {{0, a, false}, {1, b, false}, {2, a, true}, {3, b, true}}},
                                     start);
    }
  return s;
}

scene::Table tabulate(const Study& s) {
  scene::Table table(
      {{"case"}, {"T"}, {"N"}, {"c T", 4}, {"derivative matrix or rows"}, {"largest error", 2}});
  const auto cell = [](double e) {
    return std::isfinite(e) ? scene::Cell(e) : scene::Cell(std::string("no solution"));
  };
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (std::size_t d = 0; d < derivatives.size(); ++d) {
      const std::string name(to_string(cases[c])), how = legend_of(derivatives[d]);
      for (std::size_t k = 0; k < s.shapes.size(); ++k)
        if (derivatives[d] != DerivativeMatrix::polynomial)
          table.add({name, 2., std::int64_t{40}, s.shapes[k], how, cell(s.by_shape[c][d][k])});
      for (std::size_t k = 0; k < s.counts.size(); ++k)
        if (!std::isnan(s.by_count[c][d][k]))
          table.add({name, 2., static_cast<std::int64_t>(s.counts[k]),
                     derivatives[d] == DerivativeMatrix::polynomial ? scene::Cell()
                                                                    : scene::Cell((s.counts[k] - 1) / 4),
                     how, cell(s.by_count[c][d][k])});
    }
  for (std::size_t shape = 0; shape < 2; ++shape)
    for (std::size_t p = 0; p < placements.size(); ++p)
      table.add({std::string("fixed"), 1., std::int64_t{40}, shape == 0 ? 9.75 : 7.5,
                 std::string("rows of ") + placements[p].name, cell(s.by_rows[shape][p])});
  return table;
}

void draw_sweep(ControlCurves& figure, const std::vector<double>& x, const Sweep& sweep) {
  for (std::size_t d = 0; d < derivatives.size(); ++d) {
    figure.begin(legend_of(derivatives[d]), looks[d]);
    for (std::size_t k = 0; k < x.size(); ++k)
      if (sweep[d][k] > 0 && std::isfinite(sweep[d][k])) figure.add(x[k], sweep[d][k]);
  }
  figure.with("logy", "1").with("yrange", "[1e-15:1e3]");
}

scene::Figure draw(const Study& s) {
  ControlCurves figure("The printed shape limits the errors, not the rounding");
  figure.panel("{/:Italic c T}, 40 nodes, free final state", "largest error at the nodes");
  draw_sweep(figure, s.shapes, s.by_shape[0]);
  figure.with("key", "off");
  figure.panel("nodes {/:Italic N}, {/:Italic c} = ({/:Italic N} - 1)/(4{/:Italic T})", "");
  draw_sweep(figure, s.counts, s.by_count[0]);
  figure.with("key", "top right");
  figure.overall("width", "900");
  return figure.take();
}

std::vector<scene::Quantity> promises(const Study& s) {
  const auto at = [&](const std::vector<double>& x, const Sweep& sweep, std::size_t d, double value) {
    for (std::size_t k = 0; k < x.size(); ++k)
      if (x[k] == value) return sweep[d][k];
    return std::nan("");
  };
  const auto about = [](std::string name, double value, double known) {
    return scene::Quantity{std::move(name), "1",        value,
                           known / 15,      known * 15, "recorded; rounding is a lottery"};
  };
  return {
      about("free, c T = 9.75, double", at(s.shapes, s.by_shape[0], 0, 9.75), 3.2e-5),
      scene::near("free, c T = 9.75, all digits", "1", at(s.shapes, s.by_shape[0], 1, 9.75), 2.5e-5, 0.6,
                  "recorded, matrix in 60 digits: 2.5e-5 in the states"),
      about("free, c T = 5, double", at(s.shapes, s.by_shape[0], 0, 5), 6e-8),
      scene::at_most("free, c T = 4, all digits", "1", at(s.shapes, s.by_shape[0], 1, 4), 1e-12,
                     "recorded, matrix in 60 digits: 3e-15; rounding of Newton's system"),
      about("free, 20 nodes, printed shape", at(s.counts, s.by_count[0], 0, 20), 2.8e-5),
      about("free, 80 nodes, printed shape", at(s.counts, s.by_count[0], 0, 80), 1.6e-4),
      scene::at_most("free, 40 nodes, polynomial", "1", at(s.counts, s.by_count[0], 2, 40), 1e-11,
                     "recorded: 5e-13"),
      {"free, 20 nodes, polynomial", "1", at(s.counts, s.by_count[0], 2, 20), 4e-9, 4e-7, "recorded: 4e-8"},
      {"fixed, T = 1, rows of the states, printed shape", "1", std::min(s.by_rows[0][2], 1e300), 0.1, 1e300,
       "recorded: diverges, or 1 to 100"}};
}

}  // namespace

void add_shape_study(scene::Chapter& chapter, const DuffingRuns& runs) {
  const auto& run = chapter.add_run<Study>(
      "shapes-and-rows", "begun at the cheapest extremal; largest error of states and co-states at the nodes",
      {&run_of(runs.extremals, DuffingCase::fixed, 0), &run_of(runs.extremals, DuffingCase::free),
       &run_of(runs.extremals, DuffingCase::fixed)},
      [runs](Workshop& w) { return compute(runs, w); });
  chapter.add({.name = "shape-study",
               .title = "Errors by shape, number of nodes, and rows of the end conditions",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) {
                 const Study& s = w.result(run);
                 return scene::Showing{draw(s), tabulate(s), promises(s)};
               }});
}

}  // namespace nlmech::chapters
