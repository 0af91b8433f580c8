#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"

namespace nlmech::chapters::rbf_inverse::shape_study_control {
namespace {

using bvp::DerivativeMatrix;
using bvp::DuffingCase;

/// How D is made, and how its curve is drawn.
struct Basis {
  DerivativeMatrix derivative;
  const char* legend;
  int style;
};
constexpr std::array bases = {Basis{DerivativeMatrix::gaussian, "Gaussian, double", 5},
                              Basis{DerivativeMatrix::stable_gaussian, "Gaussian, all digits", 1},
                              Basis{DerivativeMatrix::polynomial, "polynomial", 3}};
constexpr const Basis &in_double = bases[0], &all_digits = bases[1], &polynomial = bases[2];

/// What is varied: the shape of 40 nodes, the nodes with the printed shape, or the rows of the conditions.
enum class Varied : std::uint8_t { shape, nodes, rows };

/// The largest error of states and co-states with one setting.
struct Row {
  Varied varied;
  DuffingCase which;
  double final_time;
  int nodes;
  double shape;  ///< c T
  const Basis* basis;
  std::string how;  ///< its legend, or which rows the conditions stand in
  double error;     ///< at the nodes; infinite if there is no root
};

/// Begun at the cheapest extremal.
double error_of(const bvp::ExtremalProblem& problem, const bvp::GlobalMethod& method,
                const bvp::Multistart& from) {
  const bvp::GlobalResult r = solve_global(problem, method, start_from(cheapest_of(from).solution));
  const NodeErrors e = node_errors(r);
  const bool root = r.report.status.ok() && std::isfinite(e.states + e.costates);
  return root ? std::max(e.states, e.costates) : HUGE_VAL;
}

void vary_shape_and_nodes(std::vector<Row>& rows, DuffingCase which, const bvp::Multistart& from,
                          bool quick) {
  std::vector<double> shapes = {1, 1.5, 2, 3, 4, 5, 6, 7, 7.5, 8, 9, 9.75, 11, 13};
  std::vector<int> counts = {10, 14, 20, 28, 40, 56, 80, 112, 200};
  if (quick) {
    shapes = {2, 4, 5, 7.5, 9.75, 13};
    counts = {10, 20, 40, 80};
  }
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(which));
  const auto add = [&](Varied varied, const Basis& basis, int nodes, double shape) {
    const bvp::GlobalMethod method{.nodes = nodes,
                                   .relative_shape = shape,
                                   .derivative = basis.derivative,
                                   .rows = printed_rows(problem)};
    rows.push_back(
        {varied, which, inferred, nodes, shape, &basis, basis.legend, error_of(problem, method, from)});
  };
  for (const Basis& basis : bases) {
    for (const double shape : shapes) add(Varied::shape, basis, 40, shape);  // polynomials have none
    for (const int n : counts) {
      // The stable basis has no need of more: its errors have ended by then.
      if (&basis != &all_digits || n <= 80) add(Varied::nodes, basis, n, (n - 1) / 4.);
    }
  }
}

/// Which rows the four conditions of the fixed case stand in, at both ends.
void vary_rows(std::vector<Row>& all, const bvp::Multistart& from) {
  struct Placement {
    const char* name;
    int first, second;
  };
  const Placement placements[] = {{"x2 and lambda1 (Eq. 5.28)", 1, 2},
                                  {"x2 and lambda2", 1, 3},
                                  {"x1 and x2", 0, 1},
                                  {"lambda1 and lambda2", 2, 3}};
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(DuffingCase::fixed, 1));
  for (const double shape : {9.75, 7.5})
    for (const auto& [name, a, b] : placements) {
      const bvp::GlobalMethod method{.relative_shape = shape,
                                     .rows = {{0, a, false}, {1, b, false}, {2, a, true}, {3, b, true}}};
      all.push_back({Varied::rows, DuffingCase::fixed, 1, 40, shape, &in_double,
                     std::string("rows of ") + name, error_of(problem, method, from)});
    }
}

std::vector<Row> compute(const bvp::Multistart& fixed_1, const bvp::Multistart& free,
                         const bvp::Multistart& fixed, bool quick) {
  std::vector<Row> all;
  vary_shape_and_nodes(all, DuffingCase::free, free, quick);
  vary_shape_and_nodes(all, DuffingCase::fixed, fixed, quick);
  vary_rows(all, fixed_1);
  return all;
}

/// A curve for each way to make D, of the free case.
template <class X>
void draw(scene::Panel& panel, const std::vector<Row>& all, Varied varied, X x) {
  panel.log_y(1e-15, 1e3);
  for (const Basis& basis : bases) {
    const auto solved = [&](const Row& r) {
      return r.varied == varied && r.which == DuffingCase::free && r.basis == &basis && r.error > 0 &&
             std::isfinite(r.error);
    };
    panel.curve(basis.legend, all | std::views::filter(solved), x, &Row::error,
                scene::linespoints(basis.style));
  }
}

void tabulate(std::vector<Row> rows, scene::Show& show) {
  std::erase_if(rows, [](const Row& r) { return r.varied == Varied::shape && r.basis == &polynomial; });
  const auto shape = [](const Row& r) {
    return r.basis == &polynomial ? scene::Cell() : scene::Cell(r.shape);
  };
  const auto error = [](const Row& r) {
    return std::isfinite(r.error) ? scene::Cell(r.error) : scene::Cell("no solution");
  };
  show.table(rows, {{"case", [](const Row& r) { return to_string(r.which); }},
                    {"T", &Row::final_time},
                    {"N", &Row::nodes},
                    {"c T", shape, 4},
                    {"derivative matrix or rows", &Row::how},
                    {"largest error", error, 2}});
}

void put(const std::vector<Row>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("The printed shape limits the errors, not the rounding");
  plot.size(900, 480).columns({"panel", "curve", "x", "y"});
  draw(plot.panel("{/:Italic c T}, 40 nodes, free final state", "largest error at the nodes").key("off"), all,
       Varied::shape, &Row::shape);
  draw(plot.panel("nodes {/:Italic N}, {/:Italic c} = ({/:Italic N} - 1)/(4{/:Italic T})", ""), all,
       Varied::nodes, &Row::nodes);
  tabulate(all, show);
  const auto error = [&](Varied varied, const Basis& basis, int nodes, double shape) {
    return std::ranges::find_if(all,
                                [&](const Row& r) {
                                  return r.varied == varied && r.basis == &basis && r.nodes == nodes &&
                                         r.shape == shape;
                                })
        ->error;  // the free case is first
  };
  const auto about = [&](const char* name, double value, double known) {
    show.between(name, value, known / 15, known * 15, "recorded; rounding is a lottery");
  };
  about("free, c T = 9.75, double", error(Varied::shape, in_double, 40, 9.75), 3.2e-5);
  show.near("free, c T = 9.75, all digits", error(Varied::shape, all_digits, 40, 9.75), 2.5e-5, 0.6,
            "recorded, matrix in 60 digits: 2.5e-5 in the states");
  about("free, c T = 5, double", error(Varied::shape, in_double, 40, 5), 6e-8);
  show.at_most("free, c T = 4, all digits", error(Varied::shape, all_digits, 40, 4), 1e-12,
               "recorded, matrix in 60 digits: 3e-15; rounding of Newton's system");
  about("free, 20 nodes, printed shape", error(Varied::nodes, in_double, 20, 4.75), 2.8e-5);
  about("free, 80 nodes, printed shape", error(Varied::nodes, in_double, 80, 19.75), 1.6e-4);
  show.at_most("free, 40 nodes, polynomial", error(Varied::nodes, polynomial, 40, 9.75), 1e-11,
               "recorded: 5e-13");
  show.between("free, 20 nodes, polynomial", error(Varied::nodes, polynomial, 20, 4.75), 4e-9, 4e-7,
               "recorded: 4e-8");
  const auto of_states =
      std::ranges::find(all, "rows of x1 and x2", &Row::how);  // the printed shape is first
  show.between("fixed, T = 1, rows of the states, printed shape", std::min(of_states->error, 1e300), 0.1,
               1e300, "recorded: diverges, or 1 to 100");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result all(
      "shapes-and-rows", "begun at the cheapest extremal; largest error of states and co-states at the nodes",
      compute, extremals(DuffingCase::fixed, 1), extremals(DuffingCase::free), extremals(DuffingCase::fixed));
  return {{.name = "shape-study",
           .title = "Errors by shape, number of nodes, and rows of the end conditions",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::rbf_inverse::shape_study_control
