#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "chapters/homotopy/commands/commands.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/frames/toggle_path.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {
namespace {

/// Options of the command.
struct ToggleOptions {
  TypedToggle toggle;
  double load = 0;
  std::string solver = "energy-trust-region";
  std::optional<double> tolerance;  ///< default 1e-10, or the rounding bound if larger
};

void declare(scene::Options& options, ToggleOptions& typed) {
  declare_toggle(options, typed.toggle, "one element cannot bow");
  options.add("--load", typed.load, "load W on the apex, downwards, pound").required();
  options.add("--solver", typed.solver, "name of the solver; an unknown name lists all");
  options
      .add("--tolerance", typed.tolerance,
           "tolerance on the residual, below 1. Default: 1e-10, or 4 times the residual that rounding of the "
           "displacements causes if that is larger, as with very many elements (the printed bound)")
      .positive();
}

/// Equations of half the toggle.
struct Loaded {
  std::unique_ptr<frames::ToggleFrame> toggle;
  std::unique_ptr<algebraic::Equations> equations;
  Eigen::Index apex = 0;
  double sign = 1;  ///< sign of the deflection in the unknowns
};

Loaded loaded_toggle(const TypedToggle& typed, int elements, double load) {
  const double height = typed.height;
  Loaded all;
  try {
    if (typed.model == "williams") {
      static_cast<void>(frames::make_frame({.height = height}));  // throws if the toggle is not valid
      all.equations = std::make_unique<frames::WilliamsEquilibrium>(frames::Williams{.height = height}, load);
    } else {
      all.toggle = std::make_unique<frames::ToggleFrame>(
          frames::make_frame(frames::Toggle{.height = height, .elements = elements}));
      all.equations = std::make_unique<frames::Equilibrium>(all.toggle->frame, all.toggle->load, load);
      all.apex = all.toggle->apex;
      all.sign = -1;
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--height {} --load {}: {}", height, load, error.what()));
  }
  return all;
}

algebraic::Report run(const algebraic::NamedSolver& method, algebraic::Equations& equations,
                      Eigen::VectorXd& x) {
  if (method.name == "kinsol" && peers::kinsol_available()) {
    constexpr Eigen::Index most = 3000;  // KINSOL uses dense matrices here
    if (equations.size() > most)
      throw InputError(
          fmt::format("--solver kinsol: its matrix is dense, and {} unknowns are too many (at most {}); "
                      "take fewer elements or another solver",
                      equations.size(), most));
    // KINSOL measures the largest component, nlmech the Euclidean norm.
    const double components = std::sqrt(static_cast<double>(equations.size()));
    const peers::Kinsol kinsol{.tolerance = method.tolerance * method.scale / components,
                               .iterations = method.iterations};
    return checked_against_tolerance(method, equations, x, peers::find_root(kinsol, equations, x));
  }
  const auto names = algebraic::solver_names();
  if (std::find(names.begin(), names.end(), method.name) == names.end())
    throw InputError(fmt::format("--solver {}: no such solver; the solvers are {}{}", method.name,
                                 fmt::join(names, ", "), peers::kinsol_available() ? ", kinsol" : ""));
  return find_root(method, equations, x);
}

/// Stability of an equilibrium and its relation to the path from rest.
struct PathRelation {
  std::optional<Eigen::Index> unstable;  ///< unstable modes of the whole toggle; nothing if unknown
  frames::TogglePath from_rest;          ///< path up to the load or the first critical point
};

PathRelation path_relation(const Loaded& toggle, double height, double load, int elements,
                           const Eigen::VectorXd& x) {
  constexpr int enough = 64;  // elements per member; loads are accurate to 1e-6
  if (!toggle.toggle) {
    const frames::Williams williams{.height = height};
    return {unstable_motions(williams, x[0]), first_critical_point(williams, load)};
  }
  const frames::Toggle own{.height = height, .elements = elements};
  return {
      unstable_motions(own, x),
      first_critical_point(frames::Toggle{.height = height, .elements = std::min(elements, enough)}, load)};
}

std::string stability_of(const PathRelation& s) {
  if (!s.unstable) return "unknown";
  return *s.unstable == 0 ? "stable" : "unstable";
}

/// Prints to standard error how the equilibrium found relates to the path from rest.
void print_relation(const PathRelation& s, double height, double drop) {
  if (!s.from_rest.status.ok()) {
    std::cerr << fmt::format(
        "toggle: it is not known whether the path from rest leads to this equilibrium: {}\n",
        s.from_rest.status.text());
  } else if (!s.from_rest.events.empty()) {
    const frames::ToggleEvent& e = s.from_rest.events[0];
    std::cerr << fmt::format(
        "toggle: before this load the path from rest reaches {}{} at {:.7g} lb and a drop of {:.6g} in, "
        "where "
        "it loses its stability; the equilibrium found lies beyond it and is {}\n",
        e.kind == algebraic::CriticalPoint::Kind::bifurcation
            ? (e.is_symmetric ? "a symmetric " : "an antisymmetric ")
            : "a ",
        to_string(e.kind), e.load, e.drop, stability_of(s));
  } else if (!(std::abs(s.from_rest.drop - drop) <= 1e-3 * height)) {
    std::cerr << fmt::format(
        "toggle: this equilibrium is not on the path from rest, which carries this load at a drop of {:.6g} "
        "in; it is {}\n",
        s.from_rest.drop, stability_of(s));
  }
}

std::string solve_toggle(const ToggleOptions& typed) {
  const double height = typed.toggle.height, load = typed.load, tolerance = typed.tolerance.value_or(1e-10);
  if (!(tolerance < 1)) throw InputError(fmt::format("--tolerance {}: must be below 1", tolerance));
  const int elements = elements_of(typed.toggle);
  const Loaded toggle = loaded_toggle(typed.toggle, elements, load);
  const double scale = load != 0 ? std::abs(load) / 2 : 1;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(toggle.equations->size());
  const algebraic::Report report =
      run({.name = typed.solver, .tolerance = tolerance, .scale = scale, .to_rounding = !typed.tolerance},
          *toggle.equations, x);
  if (!report.status.ok()) throw Failure(report.status);
  // Avoids a drop of -0.
  const double drop = x[toggle.apex] == 0 ? 0 : toggle.sign * x[toggle.apex];
  const PathRelation relation = path_relation(toggle, height, load, elements, x);
  const auto& events = relation.from_rest.events;
  print_relation(relation, height, drop);
  return fmt::format(
      "status,deflection,residual,iterations,bound,stability,critical_load\n{},{:.17g},{:.6g},{},"
      "{:.6g},{},{}\n",
      to_string(report.status.outcome()), drop, report.last / scale,
      report.statistics.steps + report.statistics.rejected, report.bound / scale, stability_of(relation),
      events.empty() ? "" : fmt::format("{:.12g}", events[0].load));
}

}  // namespace

void add_toggle_command(scene::Commands& all) {
  all.add(
      "toggle",
      "Solve for an equilibrium of half a loaded toggle from rest; prints as CSV "
      "status,deflection,residual,iterations,bound,stability,critical_load. Members, inch and pound as in "
      "Table "
      "2.1. residual: |F| relative to half the load, at most the bound; stability: of the whole toggle, "
      "including antisymmetric motions; critical_load: load of the limit point or bifurcation on the path "
      "from rest before this load, empty if there is none. Exits with 1 and a message if no equilibrium is "
      "found",
      declare, solve_toggle);
}

}  // namespace nlmech::chapters::homotopy
