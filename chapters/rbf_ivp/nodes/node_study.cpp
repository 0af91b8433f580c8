#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "chapters/rbf_ivp/nodes/node_variants.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::node_study {
namespace {

using collocation::NodeFamily;
using Eigen::VectorXd;

constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto, radau = NodeFamily::left_end_and_radau;

// Names of variants; columns of the table and curves of the figure.
constexpr const char *equal = "LGL equal shapes", *curved = "nodes by curvature",
                     *residual = "nodes by residual", *own = "own shapes",
                     *both = "nodes by residual and own shapes", *inserted = "inserted nodes",
                     *squares = "least squares", *right = "Gaussians at Radau nodes",
                     *flat = "polynomials LGL", *flat_radau = "polynomials Radau",
                     *flat_squares = "polynomials least squares", *split = "polynomials Radau split at kinks";

/// Errors at the end and anywhere.
struct Errors {
  double end = HUGE_VAL, largest = HUGE_VAL;
};
/// Variants on one interval with one number of nodes and one shape.
struct Comparison {
  std::string problem;
  int nodes = 0;
  double h = 0, shape = 0;  ///< shape: c h
  std::map<std::string, Errors> errors;
};

VectorXd equal_shapes(const VectorXd& nodes, double shape) { return VectorXd::Constant(nodes.size(), shape); }

/// From half the nodes, inserted in four rounds or so; the relative shape grows with their number.
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

Comparison compare(const std::string& problem, const Arc& arc, int count, double shape) {
  Comparison c{problem, count, arc.h, shape, {}};
  const auto keep = [&](const char* name, const Fit& fit) {
    c.errors[name] = {fit.end_error, fit.largest_error};
  };
  const VectorXd lgl = family_nodes(lobatto, count);
  const TrialSpace space = gaussians(lgl, equal_shapes(lgl, shape));
  const Fit fit = collocate(arc, space);
  keep(equal, fit);
  keep(squares, least_squares(arc, space));
  keep(own, collocate(arc, gaussians(lgl, own_shapes(lgl, shape))));
  if (fit.converged) {
    const VectorXd by_curvature = placed_nodes(lgl, space.checks, fit.curvature),
                   by_residual = placed_nodes(lgl, space.checks, envelope(fit.residuals));
    keep(curved, collocate(arc, gaussians(by_curvature, equal_shapes(by_curvature, shape))));
    keep(residual, collocate(arc, gaussians(by_residual, equal_shapes(by_residual, shape))));
    keep(both, collocate(arc, gaussians(by_residual, own_shapes(by_residual, shape))));
  }
  const VectorXd at_radau = family_nodes(radau, count);
  keep(right, collocate(arc, gaussians(at_radau, equal_shapes(at_radau, shape))));
  const VectorXd grown = grown_nodes(arc, count, shape);
  if (grown.size() == count) keep(inserted, collocate(arc, gaussians(grown, equal_shapes(grown, shape))));
  const TrialSpace polynomial = polynomials(lgl);
  keep(flat, collocate(arc, polynomial));
  keep(flat_squares, least_squares(arc, polynomial));
  keep(flat_radau, collocate(arc, polynomials(family_nodes(radau, count))));
  return c;
}

/// Three steps of Radau polynomials between the kinks of the force, with as many unknowns or fewer.
Errors split_at_kinks(const Arc& arc, int count) {
  const Case& c = *arc.example;
  const ivp::PolynomialCollocation method = {.step = arc.h, .nodes = (count - 1) / 3 + 1, .points = radau};
  Errors errors = {0, 0};
  const auto observer = [&](const ivp::Step& step) {
    for (std::size_t k = 0; k < step.times.size(); ++k) {
      const ivp::State e = error_at(c, step.times[k], step.states.col(static_cast<Eigen::Index>(k)).eval());
      errors.end = e.cwiseQuotient(c.amplitude).cwiseAbs().maxCoeff();
      errors.largest = std::max(errors.largest, errors.end);
    }
    return true;
  };
  const auto solution = ivp::integrate(c.system, c.x0, arc.t0, arc.t0 + arc.h, method, observer);
  return solution.status.ok() ? errors : Errors{};
}

/// The intervals: three of smooth motion, and one with the whole impact inside.
Comparison compare_at(int which, int nodes, double shape) {
  const double P = duffing_period();
  const auto pick = [nodes](double seven, double twenty, double more) {
    return nodes == 7 ? seven : nodes == 20 ? twenty : more;
  };
  switch (which) {
    case 0: return compare("duffing", Arc{&free_duffing_case(), 0, pick(P / 10, P / 2, P)}, nodes, shape);
    case 1: return compare("after the impact", Arc{&impact_case(), 1, pick(0.5, 3, 6)}, nodes, shape);
    case 2: return compare("three masses", Arc{&three_mass_case(), 0, pick(0.625, 5, 20)}, nodes, shape);
    default: {
      const Arc arc{&impact_case(), 0, 1.6};
      Comparison c = compare("impact inside", arc, nodes, shape);
      c.errors[split] = split_at_kinks(arc, nodes);
      return c;
    }
  }
}

/// Nodes against error when they are inserted where the residual is greatest, and when they are all new.
struct Growth {
  std::string problem, way;
  int nodes = 0;
  double residual = 0, largest = 0;
};

void grow(std::vector<Growth>& all, const std::string& problem, const Arc& arc, int most) {
  const auto shape = [](int nodes) { return 0.15 * (nodes - 1); };
  VectorXd nodes = family_nodes(lobatto, 8);
  for (int count = 8; count <= most; count += 4) {
    const TrialSpace grown = gaussians(nodes, equal_shapes(nodes, shape(count)));
    const Fit fit = collocate(arc, grown);
    if (fit.converged) {
      all.push_back({problem, "inserted", count, fit.residuals.maxCoeff(), fit.largest_error});
      nodes = with_inserted(nodes, grown.checks, fit.residuals, 4);
    }
    const VectorXd lgl = family_nodes(lobatto, count);
    const TrialSpace fresh = gaussians(lgl, equal_shapes(lgl, shape(count)));
    const Fit a = collocate(arc, fresh), b = least_squares(arc, fresh);
    all.push_back({problem, "LGL", count, a.residuals.maxCoeff(), a.largest_error});
    all.push_back({problem, "least squares", count, b.residuals.maxCoeff(), b.largest_error});
    if (nodes.size() != count + 4) break;
  }
}

struct Study {
  std::vector<Comparison> table;  ///< numbers of nodes and shapes of the dissertation, and one between
  std::vector<Comparison> scan;   ///< 20 nodes (quick: 12), by shape
  std::vector<Growth> growth;
};

Study study_of(bool quick) {
  Study study;
  const std::array<std::array<double, 3>, 4> shapes = {
      {{0.367, 2.375, 8.5}, {0.33, 2.375, 8.5}, {0.219, 2.375, 7.8}, {1.5, 2.375, 8.5}}};
  for (int which = 0; which < 4; ++which) {
    const auto& s = shapes[static_cast<std::size_t>(which)];
    study.table.push_back(compare_at(which, 7, s[0]));
    study.table.push_back(compare_at(which, 20, s[1]));
    if (!quick) study.table.push_back(compare_at(which, 35, s[2]));
  }
  for (const int which : {0, 2, 3}) {
    for (const double part : {0.05, 0.08, 0.12, 0.18, 0.25, 0.35, 0.5}) {
      if (quick && part != 0.12) continue;
      const int nodes = quick ? 12 : 20;
      study.scan.push_back(compare_at(which, nodes, (nodes - 1) * part));
    }
  }
  grow(study.growth, "duffing", {&free_duffing_case(), 0, duffing_period() / 2}, quick ? 12 : 32);
  grow(study.growth, "impact inside", {&impact_case(), 0, 1.6}, quick ? 12 : 32);
  return study;
}

/// A variant: a column of the table, and how the figure draws it.
struct Variant {
  const char* name;
  const char* title = "";  ///< in the key
  int style = 0;           ///< of its line; 0: not drawn
};
constexpr std::array variants = {Variant{equal, "LGL, equal shapes", 3},
                                 Variant{right, "Radau nodes", 6},
                                 Variant{curved},
                                 Variant{residual, "nodes by residual", 2},
                                 Variant{own, "shapes of their own", 7},
                                 Variant{both},
                                 Variant{inserted, "inserted nodes", 4},
                                 Variant{squares, "least squares", 1},
                                 Variant{flat},
                                 Variant{flat_squares},
                                 Variant{flat_radau, "Radau polynomials", 8},
                                 Variant{split, "the same, split", 5}};

/// "end / largest" of a variant; empty where it was not tried.
scene::Cell errors_cell(const Comparison& c, const char* variant) {
  const auto found = c.errors.find(variant);
  if (found == c.errors.end()) return {};
  if (!std::isfinite(found->second.largest)) return "fails";
  return fmt::format("{} / {}", scene::format_number(found->second.end, 2),
                     scene::format_number(found->second.largest, 2));
}

/// A row a variant, a column a number of nodes; above those of an interval its length and shape.
scene::Table table_of(const Study& study) {
  const std::span all(study.table);
  const std::size_t counts = all.size() / 4;  // of nodes, on each of four intervals
  std::vector<scene::Column> heads = {{"interval"}, {"variant"}};
  for (const Comparison& c : all.first(counts)) heads.push_back({fmt::format("N = {}", c.nodes)});
  scene::Table table(heads);
  for (std::size_t first = 0; first < all.size(); first += counts) {
    const auto add = [&](const char* what, auto cell) {
      std::vector<scene::Cell> row = {all[first].problem, what};
      for (const Comparison& c : all.subspan(first, counts)) row.push_back(cell(c));
      if (!std::holds_alternative<std::monostate>(row.back())) table.add(std::move(row));
    };
    add("length h (s); shape c h", [](const Comparison& c) -> scene::Cell {
      return fmt::format("{}; {}", scene::format_number(c.h, 3), scene::format_number(c.shape, 4));
    });
    for (const Variant& v : variants)
      add(v.name, [&v](const Comparison& c) { return errors_cell(c, v.name); });
  }
  return table;
}

double finite(double value) { return std::isfinite(value) ? value : NAN; }

/// A problem of the figure: a column of panels.
struct Shown {
  const char *problem, *label;
  scene::Panel *largest, *end;  ///< errors against the shape
};

/// Panels of errors against the shape: anywhere above, at the end below.
std::array<Shown, 3> shape_panels(scene::Plot& plot) {
  std::array<Shown, 3> all = {Shown{"duffing", "free Duffing, P/2", nullptr, nullptr},
                              Shown{"three masses", "three masses, 5 s", nullptr, nullptr},
                              Shown{"impact inside", "impact inside, 1.6 s", nullptr, nullptr}};
  const auto add = [&](std::size_t i, double top, const char* x_label, const char* y_label) {
    const double left = 0.125 + static_cast<double>(i) * 0.295;
    scene::Panel& panel = plot.panel(x_label, i == 0 ? y_label : "");
    panel.place(left, left + 0.265, top - 0.215, top).log_x(0.8, 12).log_y(1e-17, 10).set("ytics 1e4");
    panel.set("xtics (1, 2, 5, 10)").set(*x_label == 0 ? "format x ''" : "format x '%g'").key("off");
    if (i > 0) panel.set("format y ''");
    return &panel;
  };
  for (std::size_t i = 0; i < 3; ++i)
    all.at(i).largest = &add(i, 0.905, "", "largest error")->caption(all.at(i).label);
  for (std::size_t i = 0; i < 3; ++i) all.at(i).end = add(i, 0.655, "{/:Italic c h}", "error at the end");
  return all;
}

/// Ways of refinement; the second of the panels has the key of all.
scene::Panel& growth_panel(scene::Plot& plot, const Shown& shown, bool first) {
  scene::Panel& panel = plot.panel("number of nodes", first ? "largest error" : "").caption(shown.label);
  const double left = first ? 0.125 : 0.385;
  panel.place(left, left + 0.235, 0.07, 0.32).x_range(6, 34).set("xtics (8, 16, 24, 32)");
  panel.log_y(1e-14, 10).set("ytics 1e4").key("off");
  panel.set("xlabel offset 0,0.5");
  if (first) return panel;
  panel.set("format y ''")
      .key("at screen 0.995, screen 0.32 right top vertical maxrows 9 samplen 2 spacing 1.05");
  for (const Variant& v : variants) {
    if (v.style > 0)
      panel.also(fmt::format("keyentry with linespoints linestyle {} title '{}'", v.style, v.title));
  }
  return panel;
}

void draw(const Study& study, scene::Show& show) {
  scene::Plot& plot = show.plots("Least squares and Radau nodes help; moving nodes does not");
  const std::array<Shown, 3> problems = shape_panels(plot);
  scene::Table data({{"panel"}, {"problem"}, {"variant", 3, true}, {"abscissa"}, {"end"}, {"largest"}});
  int block = 0;
  for (const Shown& shown : problems) {
    for (const Variant& v : variants) {
      const auto rows = data.rows().size();
      for (const Comparison& c : study.scan) {
        const auto found = c.errors.find(v.name);
        if (c.problem != shown.problem || found == c.errors.end()) continue;
        data.add(
            {"shape", c.problem, v.name, c.shape, finite(found->second.end), finite(found->second.largest)});
      }
      if (data.rows().size() == rows) continue;
      if (v.style > 0) {
        shown.largest->columns("", "abscissa:largest", {"linespoints", v.style}, block);
        shown.end->columns("", "abscissa:end", {"linespoints", v.style}, block);
      }
      ++block;
    }
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
    const Shown& shown = problems.at(i);
    scene::Panel& panel = growth_panel(plot, shown, i == 0);
    for (const auto& [way, style] : {std::pair("LGL", 3), {"inserted", 4}, {"least squares", 1}}) {
      for (const Growth& g : study.growth) {
        if (g.problem == shown.problem && g.way == way)
          data.add({"growth", g.problem, g.way, g.nodes, finite(g.residual), finite(g.largest)});
      }
      panel.columns("", "abscissa:largest", {"linespoints", style}, block++);
    }
  }
  plot.size(760, 820).data(std::move(data));
}

/// The comparison of the table with so many nodes.
const Comparison& row(const Study& study, const std::string& problem, int nodes) {
  for (const Comparison& c : study.table) {
    if (c.problem == problem && c.nodes == nodes) return c;
  }
  throw std::out_of_range("no comparison " + problem);
}

/// What a variant gains over equal shapes at LGL nodes, at the end or anywhere.
double gain(const Study& study, const char* variant, const std::string& problem, int nodes,
            double Errors::*where) {
  const auto& errors = row(study, problem, nodes).errors;
  const double rounding = where == &Errors::end ? 1e-16 : 0;
  return errors.at(equal).*where / std::max(errors.at(variant).*where, rounding);
}

void check_variants(const Study& study, scene::Show& show) {
  constexpr auto at_end = &Errors::end, anywhere = &Errors::largest;
  const auto check = [&](const char* words, const char* variant, const char* problem, int nodes,
                         double Errors::*where, double low, double high, const char* reason) {
    show.between(fmt::format("gain of {} {}, {}, N = {}", words, where == at_end ? "at the end" : "anywhere",
                             problem, nodes),
                 gain(study, variant, problem, nodes, where), low, high, reason);
  };
  const int N = show.quick() ? 20 : 35;
  for (const char* problem : {"duffing", "after the impact", "three masses"}) {
    check("least squares", squares, problem, N, at_end, 10, HUGE_VAL,
          "a digit at least: the least-squares error at the end is of twice the order of that between");
    check("least squares", squares, problem, N, anywhere, 1, HUGE_VAL, "must not lose");
  }
  check("Radau nodes", right, "duffing", 20, at_end, 1e3, HUGE_VAL, "quadrature of order 2 N - 3 for N - 1");
  check("nodes by residual", residual, "duffing", 20, anywhere, 0.1, 10, "no digit either way");
  if (!show.quick()) {
    check("nodes by residual", residual, "duffing", 35, anywhere, 1, 10, "narrow functions gain, no digit");
    show.between("loss of nodes by residual at the end, duffing, N = 35",
                 1 / gain(study, residual, "duffing", 35, at_end), 10, HUGE_VAL,
                 "moved nodes are no quadrature of high order: the end is as inexact as the rest");
  }
  check("own shapes", own, "duffing", 20, anywhere, 0, 1,
        "functions that are narrow where nodes are dense lose what wide ones share");
  check("least squares", squares, "impact inside", 20, anywhere, 1, 30,
        "a kink leaves an error of low order in any smooth space");
}

void check_refinement(const Study& study, scene::Show& show) {
  const auto grown = [&](const std::string& way) {
    const auto last = std::find_if(study.growth.rbegin(), study.growth.rend(),
                                   [&](const Growth& g) { return g.problem == "duffing" && g.way == way; });
    return last->largest;
  };
  show.between("error of inserted nodes over that of LGL nodes, duffing, as many",
               grown("inserted") / grown("LGL"), show.quick() ? 0.1 : 1, HUGE_VAL,
               "smooth motion: no part of the interval deserves more nodes than its ends");
  const auto& inside = row(study, "impact inside", 20).errors;
  show.at_most("error of Radau polynomials split at the kinks, N = 20", inside.at(split).largest, 1e-6,
               "order 7 at the nodes on half a second: 6 unknown nodes a piece");
  double least = HUGE_VAL;
  for (const auto& [name, e] : inside) {
    if (name != split) least = std::min(least, e.largest);
  }
  show.between("error of the best variant that is not split, impact inside, N = 20", least, 1e-4, 1e-2,
               "the kink: h^2/N^2 times the jump of the third derivative, or so");
}

void put(const Study& study, scene::Show& show) {
  draw(study, show);
  show.table(table_of(study));
  check_variants(study, show);
  check_refinement(study, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result study("placed-nodes",
                            "one interval; Gaussians by algebra of 50 digits, rounded to double afterwards; "
                            "errors of components by "
                            "their amplitudes, at the end / at all nodes and 3 (N - 1) points between",
                            study_of);
  return {{.name = "node-study",
           .title = "Placed nodes, own shapes, least squares and refinement with equally many unknowns",
           .content = scene::Content(put, study)}};
}

}  // namespace nlmech::chapters::rbf_ivp::node_study
