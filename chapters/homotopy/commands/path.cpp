#include <fmt/format.h>

#include <string>
#include <tuple>
#include <utility>

#include "chapters/homotopy/commands/commands.hpp"
#include "chapters/homotopy/commands/commands_typed.hpp"
#include "nlmech/algebraic/typed/typed_path.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using algebraic::TypedPathPoint;

struct PathCommand {
  TypedRoots roots;
  algebraic::TypedPathOptions path{.seconds = scene::Options::default_limit};
  std::string parameter, plot;
};

void declare(scene::Options& options, PathCommand& typed) {
  declare_roots(options, typed.roots);
  options.add("--parameter", typed.parameter, "name and range, from the start: \"a = 0:3\"").required();
  options
      .add("--branches", typed.path.branches,
           "number of half branches to follow from bifurcations besides the path from the start")
      .range(0, 1000);
  options.add("--turn", typed.path.turn, "rotation of the path's tangent in a step, rad").range(1e-3, 1);
  options.add("--steps", typed.path.steps, "largest number of steps of a branch").range(1, 100'000);
  options.add("--plot", typed.plot, "NAME.svg: the first unknown against the parameter");
  options.limit(typed.path.seconds);
}

scene::Figure path_picture(const algebraic::TypedSystem& system, const std::string& parameter,
                           const algebraic::TypedPaths& paths) {
  scene::Show show(false);
  scene::Panel& panel = show.plot("Solutions against the parameter", scene::without_markup(parameter),
                                  scene::without_markup(system.names().front()))
                            .key("outside right");
  const auto put = [&](const std::string& name, const auto& wanted, const scene::CurveStyle& style) {
    std::vector<double> a, x;
    for (const TypedPathPoint& p : paths.points) {
      if (wanted(p)) a.push_back(p.parameter), x.push_back(p.x[0]);
    }
    if (!a.empty()) panel.curve(name, a, x, style);
  };
  for (int branch = 0; branch <= paths.points.back().branch; ++branch)
    put(
        branch == 0 ? "from the start" : fmt::format("branch {}", branch),
        [&](const TypedPathPoint& p) { return p.branch == branch; }, scene::lines(branch % 7 + 1));
  for (const auto& [kind, symbol] : {std::pair{TypedPathPoint::Kind::maximum, 5},
                                     {TypedPathPoint::Kind::minimum, 4},
                                     {TypedPathPoint::Kind::bifurcation, 3}})
    put(
        std::string(to_string(kind)), [wanted = kind](const TypedPathPoint& p) { return p.kind == wanted; },
        scene::large_points(symbol));
  return *show.take().figure;
}

/// A root at the first value of the parameter.
Eigen::VectorXd root_at_start(PathCommand typed, const std::string& parameter, double value) {
  typed.roots.set.push_back(fmt::format("{}={:.17g}", parameter, value));
  // The equations are sound for the range, so only the value can make them unsound.
  const algebraic::TypedSystem system = [&] {
    try {
      return system_of(typed.roots);
    } catch (const InputError&) {
      throw Failure(failed_with(Outcome::singular_matrix,
                                "path: at {} = {:.10g} an equation loses its unknowns, and no single root "
                                "exists there; begin the range at another value",
                                parameter, value));
    }
  }();
  int tried = 0;
  const algebraic::TypedSolution found =
      solve_by_several(system, system.start("--start", typed.roots.start), typed.roots.tolerance,
                       typed.roots.iterations, tried);
  if (!found.status.ok())
    throw Failure(failed_with(found.status.outcome(), "path: no root at {} = {:.10g}: {}", parameter, value,
                              found.status.sentence()));
  return found.root.x;
}

void follow_typed(const PathCommand& typed) {
  const algebraic::NamedRanges ranges = algebraic::read_ranges("--parameter", typed.parameter);
  if (ranges.size() != 1)
    throw input_error("--parameter {}: one name with its range", quoted_input(typed.parameter));
  const std::string& parameter = ranges.begin()->first;
  const algebraic::TypedSystem system = system_of(typed.roots, {}, parameter);
  const scene::Picture picture(typed.plot);
  algebraic::TypedPathOptions options = typed.path;
  std::tie(options.from, options.until) = ranges.begin()->second;
  const algebraic::TypedPaths paths =
      follow_paths(system, root_at_start(typed, parameter, options.from), options);
  if (paths.points.empty()) throw Failure(paths.status);
  const bool is_stable_known = system.has_energy();
  std::string text = fmt::format("branch,kind,{},{}", scene::csv_field(parameter), columns_of(system));
  text.pop_back();
  text += is_stable_known ? ",negative_eigenvalues\n" : "\n";
  for (const TypedPathPoint& p : paths.points) {
    text += fmt::format("{},{},{:.15g}", p.branch, to_string(p.kind), p.parameter);
    for (const double x : p.x) text += fmt::format(",{:.15g}", x);
    text += is_stable_known ? fmt::format(",{}\n", p.negative) : "\n";
  }
  scene::print_result(text);
  if (picture.wanted()) picture.draw([&] { return path_picture(system, parameter, paths); });
  if (paths.unfollowed > 0)
    scene::print_message(
        fmt::format("path: {} half branches leave the paths and are not followed; --branches {} "
                    "follows more",
                    paths.unfollowed, options.branches + paths.unfollowed));
  if (paths.unresolved > 0)
    scene::print_message(fmt::format(
        "path: at {} bifurcation point{} no other branch is found: dF/dx loses more than one rank "
        "there, or is singular all along the other branch",
        paths.unresolved, paths.unresolved == 1 ? "" : "s"));
  if (!paths.status.ok())
    throw Failure(failed_with(paths.status.outcome(),
                              "all points found are printed, but a branch did not reach its end: {}",
                              paths.status.sentence()));
}

}  // namespace

void add_path_command(scene::Commands& all) {
  all.add("path",
          "Follow a root of typed equations F(x, a) = 0 in a parameter a through folds; prints as CSV "
          "branch, kind "
          "(step, maximum or minimum of the parameter, bifurcation), the parameter, the unknowns, and with "
          "an energy "
          "negative_eigenvalues (0: a minimum)",
          declare, follow_typed);
}

}  // namespace nlmech::chapters::homotopy
