/// Future work of chapter 6: adaptive nodes and shapes, redundant nodes with least squares, refinement by
/// residuals. Also the claim of section 4.5 that radial functions need no Lobatto nodes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/runs.hpp"
#include "chapters/rbf_ivp/nodes/node_variants.hpp"

namespace nlmech::chapters::rbf_ivp::node_study {
namespace {

using collocation::NodeFamily;
using Eigen::VectorXd;

constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto, radau = NodeFamily::left_end_and_radau;

// Names of variants in the order of the table columns.
constexpr const char *equal = "LGL, equal shapes", *right = "Radau nodes", *residual = "nodes by residual",
                     *own = "own shapes", *inserted = "inserted nodes", *squares = "least squares",
                     *split = "Radau polynomials, split at kinks";
constexpr std::array variants = {equal, right, residual, own, inserted, squares, split};

/// Errors at the end, and largest in the interval.
struct Errors {
  double end = HUGE_VAL, largest = HUGE_VAL;
};
/// Errors of the variants for an interval, number of nodes and shape.
struct Comparison {
  std::string problem;
  Arc arc;
  int nodes;
  double shape;  ///< c h
  std::map<std::string, Errors> errors = {};
};

VectorXd equal_shapes(const VectorXd& nodes, double shape) { return VectorXd::Constant(nodes.size(), shape); }

/// Nodes inserted from half the number on, in about four rounds; the shape grows in proportion to their
/// number.
VectorXd grown_nodes(const Arc& arc, int count, double shape) {
  VectorXd nodes = family_nodes(lobatto, (count + 1) / 2);
  const int batch = std::max(1, (count - static_cast<int>(nodes.size()) + 3) / 4);
  while (nodes.size() < count) {
    const double c = shape * static_cast<double>(nodes.size() - 1) / (count - 1);
    const TrialSpace space = gaussians(nodes, equal_shapes(nodes, c));
    const Fit fit = collocate(arc, space);
    if (!fit.converged) return {};
    const auto missing = count - static_cast<int>(nodes.size());
    const VectorXd more = with_inserted(nodes, space.checks, fit.residuals, std::min(batch, missing));
    if (more.size() == nodes.size()) return {};
    nodes = more;
  }
  return nodes;
}

/// Errors of Radau polynomials with steps split at the kinks of the force, for no more unknowns in three
/// steps.
Errors split_at_kinks(const Arc& arc, int count) {
  const Case& c = *arc.example;
  const ivp::PolynomialCollocation method = {.step = arc.h, .nodes = (count - 1) / 3 + 1, .points = radau};
  const Record recorded = record(c, arc.t0 + arc.h, throughout(method));
  Errors errors = {0, 0};
  for (const Record::Value& value : recorded.values) {
    errors.end = value.error.cwiseQuotient(c.amplitude).cwiseAbs().maxCoeff();
    errors.largest = std::max(errors.largest, errors.end);
  }
  return errors;
}

void compare(Comparison& c) {
  const auto add = [&](const char* name, const Fit& fit) {
    c.errors[name] = {fit.end_error, fit.largest_error};
  };
  const auto collocated = [&](const VectorXd& nodes) {
    return collocate(c.arc, gaussians(nodes, equal_shapes(nodes, c.shape)));
  };
  const VectorXd lgl = family_nodes(lobatto, c.nodes);
  const TrialSpace space = gaussians(lgl, equal_shapes(lgl, c.shape));
  const Fit fit = collocate(c.arc, space);
  add(equal, fit);
  add(right, collocated(family_nodes(radau, c.nodes)));
  if (fit.converged) add(residual, collocated(placed_nodes(lgl, space.checks, fit.residuals)));
  add(own, collocate(c.arc, gaussians(lgl, own_shapes(lgl, c.shape))));
  const VectorXd grown = grown_nodes(c.arc, c.nodes, c.shape);
  if (grown.size() == c.nodes) add(inserted, collocated(grown));
  add(squares, least_squares(c.arc, space));
  if (!c.arc.example->system.discontinuities(c.arc.t0, c.arc.t0 + c.arc.h).empty())
    c.errors[split] = split_at_kinks(c.arc, c.nodes);
}

/// Compares on intervals of smooth motion, and on one that contains the whole impact.
std::vector<Comparison> compute(bool quick) {
  const double P = duffing_period();
  std::vector<Comparison> all = {{"duffing", {&free_duffing_case(), 0, P / 2}, 20, 2.375},
                                 {"duffing", {&free_duffing_case(), 0, P}, 35, 8.5},
                                 {"three masses", {&three_mass_case(), 0, 5}, 20, 2.375},
                                 {"three masses", {&three_mass_case(), 0, 20}, 35, 7.8},
                                 {"impact inside", {&impact_case(), 0, 1.6}, 20, 2.375}};
  if (quick) std::erase_if(all, [](const Comparison& c) { return c.nodes > 20; });
  for (Comparison& c : all) compare(c);
  return all;
}

/// Table cell "end / largest" of a variant; empty if it was not tried.
scene::Cell errors_cell(const Comparison& c, const char* variant) {
  const auto found = c.errors.find(variant);
  if (found == c.errors.end()) return {};
  if (!std::isfinite(found->second.largest)) return "fails";
  return fmt::format("{} / {}", scene::format_number(found->second.end, 2),
                     scene::format_number(found->second.largest, 2));
}

const Comparison& row(const std::vector<Comparison>& all, const std::string& problem, int nodes) {
  return *std::ranges::find_if(all,
                               [&](const Comparison& c) { return c.problem == problem && c.nodes == nodes; });
}

void check_smooth(const std::vector<Comparison>& all, scene::Show& show) {
  constexpr auto at_end = &Errors::end, anywhere = &Errors::largest;
  const auto gain = [&](const char* variant, const char* problem, int nodes, double Errors::*where) {
    const auto& errors = row(all, problem, nodes).errors;
    return errors.at(equal).*where / std::max(errors.at(variant).*where, where == at_end ? 1e-16 : 0);
  };
  const auto check = [&](const char* words, const char* variant, const char* problem, int nodes,
                         double Errors::*where, double low, double high, const char* reason) {
    show.between(fmt::format("gain of {} {}, {}, N = {}", words, where == at_end ? "at the end" : "anywhere",
                             problem, nodes),
                 gain(variant, problem, nodes, where), low, high, reason);
  };
  const int most = show.quick() ? 20 : 35;
  for (const char* problem : {"duffing", "three masses"}) {
    check("least squares", squares, problem, most, at_end, 10, HUGE_VAL,
          "a digit at least: the least-squares error at the end is of twice the order of that between");
    check("least squares", squares, problem, most, anywhere, 1, HUGE_VAL, "must not lose");
  }
  check("Radau nodes", right, "duffing", 20, at_end, 1e3, HUGE_VAL, "quadrature of order 2 N - 3 for N - 1");
  check("nodes by residual", residual, "duffing", 20, anywhere, 0.1, 10, "no digit either way");
  check("own shapes", own, "duffing", 20, anywhere, 0, 1,
        "functions that are narrow where nodes are dense lose the accuracy of wide ones");
  check("inserted nodes", inserted, "duffing", 20, anywhere, 0, show.quick() ? 10 : 1.5,
        "smooth motion: no part of the interval deserves more nodes than its ends");
  if (show.quick()) return;
  check("nodes by residual", residual, "duffing", 35, anywhere, 1, 10, "narrow functions gain, no digit");
  show.between("loss of nodes by residual at the end, duffing, N = 35",
               1 / gain(residual, "duffing", 35, at_end), 10, HUGE_VAL,
               "moved nodes are no quadrature of high order: the end is as inexact as the rest");
}

void put(const std::vector<Comparison>& all, scene::Show& show) {
  scene::ColumnsOf<std::vector<Comparison>> columns = {{"interval", &Comparison::problem},
                                                       {"N", &Comparison::nodes},
                                                       {"h (s)", [](const Comparison& c) { return c.arc.h; }},
                                                       {"c h", &Comparison::shape, 4}};
  for (const char* variant : variants)
    columns.push_back({variant, [variant](const Comparison& c) { return errors_cell(c, variant); }});
  show.table(all, columns);
  check_smooth(all, show);
  double least = HUGE_VAL;
  const auto& inside = row(all, "impact inside", 20).errors;
  for (const auto& [name, e] : inside) {
    if (name != split) least = std::min(least, e.largest);
  }
  show.between("error of the best variant that is not split, impact inside, N = 20", least, 1e-4, 1e-2,
               "the kink: h^2/N^2 times the jump of the third derivative, or so");
  show.at_most("error of Radau polynomials split at the kinks, N = 20", inside.at(split).largest, 1e-6,
               "order 7 at the nodes on half a second: 6 unknown nodes a piece");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result comparisons(
      "placed-nodes",
      "one interval; Gaussians in 50 digits, rounded to double afterwards; errors of components "
      "by their amplitudes, at the end / at all nodes and 3 (N - 1) points between",
      compute);
  return {
      {.name = "node-study",
       .title =
           "Placed nodes, individual shapes, least squares and refinement with the same number of unknowns",
       .place = "our own, for the claim of section 4.5 and the future work of chapter 6",
       .content = scene::Content(put, comparisons)}};
}

}  // namespace nlmech::chapters::rbf_ivp::node_study
