#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>

#include "chapters/homotopy/commands/commands.hpp"
#include "chapters/homotopy/commands/commands_typed.hpp"
#include "nlmech/algebraic/typed/all_roots.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::homotopy {
namespace {

struct SolveOptions {
  TypedRoots roots;
  std::string method = "automatic", box;
  bool all_roots = false;
  double limit = scene::Options::default_limit;
};

void declare(scene::Options& options, SolveOptions& typed) {
  declare_roots(options, typed.roots);
  options.add("--method", typed.method,
              "a solver, an unknown name lists all; automatic: several in turn, then from other starts");
  options.add("--all-roots", typed.all_roots, "all roots in the --box, with proof, of up to three unknowns");
  options.add("--box", typed.box, "a range for each unknown, for --all-roots: \"x=-5:5, y=0:2\"");
  options.limit(typed.limit);
}

/// What a user should know of a root beyond its row.
void print_remarks(const algebraic::TypedSystem& system, const algebraic::TypedSolution& found, int tried) {
  using Kind = algebraic::CheckedRoot::Kind;
  const algebraic::CheckedRoot& root = found.root;
  if (tried > 1)
    scene::print_message(fmt::format(
        "solve: from the given start no solver found a root; this one is from other start {}", tried - 1));
  if (!root.is_isolated)
    scene::print_message(
        "solve: no isolated root: the equations depend on each other there, and roots fill a curve or more");
  else if (root.kind == Kind::singular)
    scene::print_message(
        fmt::format("solve: a singular root: dF/dx loses rank {}, multiplicity {} {}; a change of the "
                    "equations in their last "
                    "digits may remove it, and rounding hides {:.1g} of its size",
                    root.defect, root.defect > 1 ? "at least" : "about",
                    root.defect > 1 ? fmt::format("{}", 1 << std::min<Eigen::Index>(root.defect, 30))
                                    : fmt::format("{}", root.order),
                    root.error(found.typical)));
  if (root.kind == Kind::unproved)
    scene::print_message(
        "solve: F vanishes to rounding, but a root is not proved: F has a kink or a jump there, or dF/dx is "
        "too "
        "ill-conditioned");
  if (system.has_energy()) {
    Eigen::MatrixXd hessian;
    system.derivative(root.x, hessian);
    const Eigen::LLT<Eigen::MatrixXd> factors(hessian);
    scene::print_message(
        fmt::format("solve: the energy is {:.12g}, a {}", system.energy(root.x),
                    factors.info() == Eigen::Success ? "minimum" : "saddle, maximum or flat point"));
  }
}

algebraic::TypedSolution solution_of(const SolveOptions& typed, const algebraic::TypedSystem& system,
                                     int& tried) {
  const TypedRoots& roots = typed.roots;
  const Eigen::VectorXd start = system.start("--start", roots.start);
  if (typed.method == "automatic")
    return solve_by_several(system, start, roots.tolerance, roots.iterations, tried);
  return solve_by(solvers_of(system, "--method", {typed.method}).front(), system, start, roots.tolerance,
                  roots.iterations);
}

/// All roots in the box as rows.
void solve_all(const SolveOptions& typed) {
  if (typed.box.empty()) throw InputError("--all-roots: give a --box, a range for each unknown");
  const algebraic::TypedSystem system = system_of(typed.roots, names_in_box(typed.box));
  if (system.size() > 3)
    throw input_error("--all-roots: {} unknowns; bisection takes up to three", system.size());
  const algebraic::AllRoots found = all_roots(system, box_of(system, typed.box), {.seconds = typed.limit});
  std::string text = columns_of(system) + "error,root\n";
  for (const algebraic::RootBox& root : found.boxes) {
    double error = 0;
    for (const program::Interval& side : root.box) {
      text += fmt::format("{:.17g},", side.low + side.width() / 2);
      error = std::max(error, side.width());
    }
    text += fmt::format("{:.2g},{}\n", error, root.is_proved ? "proved" : "undecided");
  }
  scene::print_result(text);
  if (!found.status.ok())
    throw Failure(failed_with(found.status.outcome(), "solve: all that was found is printed, but {}",
                              found.status.sentence()));
  const bool has_bounds = system.lower().array().isFinite().any() || system.upper().array().isFinite().any();
  scene::print_message(
      fmt::format("solve: {} in the box{}, proved by interval arithmetic (boxes examined: {})",
                  found.boxes.empty() ? "there is no root" : "these are all roots",
                  has_bounds ? " and the bounds" : "", found.examined));
}

void solve_typed(const SolveOptions& typed) {
  if (typed.all_roots) return solve_all(typed);
  if (!typed.box.empty()) throw input_error("--box {}: is for --all-roots", typed.box);
  const algebraic::TypedSystem system = system_of(typed.roots);
  int tried = 1;
  const algebraic::TypedSolution found = solution_of(typed, system, tried);
  if (!found.status.ok()) throw Failure(found.status);
  print_remarks(system, found, tried);
  std::string text = columns_of(system) + "error,residual,condition,root,method,iterations,evaluations\n";
  // A root of 0 that is singular is approached until squares underflow.
  for (Eigen::Index i = 0; i < system.size(); ++i)
    text += fmt::format("{:.17g},",
                        std::abs(found.root.x[i]) <= 1e-6 * found.root.bound[i] ? 0 : found.root.x[i]);
  const Statistics& s = found.report.statistics;
  scene::print_result(text + fmt::format("{:.2g},{:.2g},{:.2g},{},{},{},{}\n",
                                         found.root.error(found.typical), found.root.residual,
                                         found.root.condition, to_string(found.root.kind), found.solver,
                                         s.steps + s.rejected, s.right_hand_sides));
}

}  // namespace

void add_solve_command(scene::Commands& all) {
  all.add(
      "solve",
      "Find a root of typed equations F(x) = 0; prints as CSV the unknowns, error (bound, in sizes of the "
      "unknowns at start and root), residual (|F_i| over its change when all unknowns change by their size), "
      "condition (of dF/dx, scaled), root (proved: interval arithmetic shows that one, and only one, lies "
      "within the error; singular; unproved), method, iterations, evaluations. Exits with 1 and a message "
      "if no root is found. With --all-roots a row for each root: the unknowns, error, root (proved, or "
      "undecided: the middle of a box that may hold any number of roots)",
      declare, solve_typed);
}

}  // namespace nlmech::chapters::homotopy
