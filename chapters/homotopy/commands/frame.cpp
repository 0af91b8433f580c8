#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/commands/commands.hpp"
#include "chapters/homotopy/commands/frame_dynamic.hpp"
#include "chapters/homotopy/commands/frame_file.hpp"
#include "chapters/homotopy/commands/frame_picture.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/frames/named/mesh_error.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy {
namespace {

/// Options of the command.
struct FrameOptions {
  std::string file, plot;
  int elements = 4;
  std::optional<int> steps, branches;
  std::optional<double> until, turn;
  std::string load_case;
  double limit = scene::Options::default_limit;
  Stopwatch time = {};
  DynamicOptions dynamic;
  /// Remaining wall time, s; at least 1e-3.
  [[nodiscard]] double left() const { return std::max(limit - time.seconds(), 1e-3); }
};

void declare(scene::Options& options, FrameOptions& typed) {
  options.add("file", typed.file, "TOML file of the frame; - is standard input").required();
  options
      .add("--steps", typed.steps,
           "largest number of steps along each branch (default 200); a branch that needs more is a failure")
      .range(1, 100'000);
  options.add(
      "--until", typed.until,
      "load factor at which a branch ends, not 0; negative: the path starts towards negative load factors. "
      "Default: twice the largest of the limit and branch points up to twice the first, if there is one");
  options
      .add("--turn", typed.turn,
           "approximate rotation of the path's tangent in a step, rad (default 0.15); smaller values give "
           "shorter steps")
      .range(1e-3, 1);
  options.add("--elements", typed.elements, "beam-columns a member, times its own number of elements")
      .range(1, 100'000);
  options
      .add("--branches", typed.branches,
           "number of branches to follow besides the path from rest (default 0): both directions from each "
           "bifurcation, in the order of their detection; adds a column branch")
      .range(0, 1000);
  options.add("--case", typed.load_case, "name of the load case, for a file with several");
  options.add("--plot", typed.plot, "FILE.svg: load factor against the largest displacement, and shapes");
  options.limit(typed.limit);
  declare_dynamic(options, typed.dynamic);
}

/// Path options without `until` and `branches`.
frames::PathOptions path_options_of(const FrameOptions& typed) {
  frames::PathOptions options;
  options.steps = typed.steps.value_or(options.steps);
  options.turn = typed.turn.value_or(options.turn);
  options.seconds = typed.left();
  return options;
}

/// Throws InputError for an option that the mode does not use. With --dynamic, an imperfection still uses
/// --turn and --steps: its shape comes from a path.
void require_used(const FrameOptions& typed, const FrameFile& file) {
  if (typed.until && *typed.until == 0)
    throw InputError("--until 0: the frame is at rest there; give another load factor");
  if (!typed.dynamic.is_wanted) return require_none(typed.dynamic);
  const std::array given = {std::pair{"--until", typed.until.has_value()},
                            std::pair{"--branches", typed.branches.has_value()},
                            std::pair{"--turn", typed.turn && !file.model.imperfection},
                            std::pair{"--steps", typed.steps && !file.model.imperfection}};
  for (const auto& [option, is_typed] : given) {
    if (is_typed)
      throw InputError(
          fmt::format("{}: is for equilibrium paths; leave out this option or --dynamic", option));
  }
}

/// Forces at each path point if displacements are prescribed; otherwise empty vectors.
std::vector<Eigen::VectorXd> reactions(const frames::NamedFrame& frame, const frames::FramePaths& paths) {
  std::vector<Eigen::VectorXd> all(paths.points.size());
  for (std::size_t i = 0; i < all.size() && !frame.given.empty(); ++i)
    static_cast<void>(frame.frame.force<double>(paths.points[i].x, all[i]));
  return all;
}

bool is_given(const frames::NamedFrame& frame, const frames::NamedMotion& motion) {
  return std::binary_search(frame.given.begin(), frame.given.end(), motion.unknown);
}

/// Estimated discretisation error of each path point; nothing if not known.
using MeshErrors = std::vector<std::optional<double>>;

std::string csv_of(const frames::NamedFrame& frame, const frames::FramePaths& paths, const MeshErrors& errors,
                   bool with_branch) {
  std::string text(with_branch ? "branch,load_factor" : "load_factor");
  for (const frames::NamedMotion& m : frame.motions) text.append(",").append(scene::csv_field(m.name));
  for (const frames::NamedMotion& m : frame.motions) {
    if (is_given(frame, m)) text.append(",").append(scene::csv_field(m.name + ".force"));
  }
  text += ",mesh_error,negative_eigenvalues,kind\n";
  const std::vector<Eigen::VectorXd> forces = reactions(frame, paths);
  for (std::size_t i = 0; i < paths.points.size(); ++i) {
    const frames::FramePoint& p = paths.points[i];
    if (with_branch) text += fmt::format("{},", p.branch);
    text += fmt::format("{:.12g}", p.load);
    for (const frames::NamedMotion& m : frame.motions) text += fmt::format(",{:.12g}", p.x[m.unknown]);
    for (const frames::NamedMotion& m : frame.motions) {
      if (is_given(frame, m)) text += fmt::format(",{:.12g}", forces[i][m.unknown]);
    }
    text += errors[i] ? fmt::format(",{:.2g}", *errors[i]) : ",";
    text += fmt::format(",{},{}\n", p.negative, to_string(p.kind));
  }
  return text;
}

/// The frame of the file with the given number of elements, including its imperfection.
frames::Imperfect frame_of(const FrameFile& file, const FrameOptions& typed, int elements) {
  const frames::NamedFrame perfect = build_frame(file, elements);
  if (!file.model.imperfection) return {perfect, {}, {}};
  return imperfect(perfect, *file.model.imperfection, path_options_of(typed));
}

/// Equilibrium paths of a frame with estimated mesh errors.
struct Estimated {
  frames::FramePaths paths;
  MeshErrors errors;
  int second = 0;  ///< elements of the second mesh
  Status status;   ///< of the second mesh
};

/// Traces the paths, then those of a second mesh within the remaining time.
Estimated estimated(const FrameFile& file, const FrameOptions& typed, const frames::NamedFrame& frame,
                    frames::PathOptions options) {
  Estimated e;
  e.paths = equilibrium_paths(frame, options);
  e.errors.resize(e.paths.points.size());
  e.second = frames::second_mesh(typed.elements, frame.members.size());
  const frames::Imperfect second = frame_of(file, typed, e.second);
  e.status = second.status;
  if (!e.status.ok()) return e;
  options.steps += options.steps / 2;
  options.seconds = typed.left();
  const frames::FramePaths compared = equilibrium_paths(second.frame, options);
  if (e.paths.status.ok()) e.status = compared.status;
  e.errors = frames::mesh_errors(
      {frame, e.paths, second.frame, compared, frames::mesh_factor(typed.elements, e.second)}, typed.left());
  return e;
}

/// Prints the estimated mesh error.
void print_mesh_error(const Estimated& e, const FrameOptions& typed) {
  double worst = 0;
  int alone = 0;
  for (std::size_t i = 0; i < e.errors.size(); ++i) {
    worst = std::max(worst, e.errors[i].value_or(0));
    if (e.errors[i] == 1 && e.paths.points[i].kind != frames::FramePoint::Kind::step) ++alone;
  }
  scene::print_message(
      fmt::format("frame: mesh errors up to {:.2g}, relative, estimated from {} and {} elements a member; "
                  "column mesh_error{}",
                  worst, typed.elements, e.second, worst > 0.01 ? "; more --elements reduce them" : ""));
  if (alone > 0)
    scene::print_message(
        fmt::format("frame: limit and branch points that were not found with {} elements a member: {}; take "
                    "more --elements",
                    e.second, alone));
  if (!e.status.ok())
    scene::print_message(fmt::format(
        "frame: the mesh errors are unknown where the path with {} elements a member was not followed: {}",
        e.second, e.status.sentence()));
}

/// Prints which bifurcating branches are not traced.
void print_unfollowed_branches(const frames::FramePaths& paths) {
  const frames::FramePoint* first = nullptr;
  int multiple = 0;
  for (const frames::FramePoint& p : paths.points) {
    if (p.kind != frames::FramePoint::Kind::bifurcation || p.vanishing < 2) continue;
    if (multiple++ == 0) first = &p;
  }
  if (first != nullptr)
    scene::print_message(
        fmt::format("frame: {} eigenvalues vanish at the bifurcation at load factor {:.10g}{}; branches from "
                    "such a point are not followed, whatever --branches; a small difference between the "
                    "members that buckle there makes simple bifurcations of it",
                    first->vanishing, first->load,
                    multiple > 1 ? fmt::format(", and several at {} others", multiple - 1) : ""));
  if (paths.unfollowed > 0)
    scene::print_message(
        fmt::format("frame: {} branches leave the paths and are not followed; --branches {} follows more",
                    paths.unfollowed, paths.branches + paths.unfollowed));
}

void move(const FrameOptions& typed, const FrameFile& file, const frames::NamedFrame& frame,
          const scene::Picture& picture) {
  const FrameRun run = run_frame(file, frame, typed.dynamic, typed.left());
  scene::print_result(csv_of(frame, run));
  if (picture.wanted()) picture.draw([&] { return motion_picture(frame, run); });
  if (!run.status.ok()) throw Failure(run.status);
  scene::print_message(
      fmt::format("frame: the energies balance within {:.1e} of the largest", run.imbalance));
}

void work(const FrameOptions& typed) {
  const scene::Picture picture(typed.plot);
  FrameFile file =
      read_frame(typed.file, typed.load_case.empty() ? std::nullopt : std::optional(typed.load_case));
  require_used(typed, file);
  file.model.may_move = typed.dynamic.is_wanted && !file.model.imperfection;
  const frames::Imperfect made = frame_of(file, typed, typed.elements);
  if (!made.status.ok()) throw Failure(made.status);
  if (file.model.imperfection)
    scene::print_message(
        fmt::format("frame: imperfection of {:.6g} in the shape of the {} at load factor {:.10g}",
                    file.model.imperfection->amplitude, to_string(made.buckled.kind), made.buckled.load));
  const frames::NamedFrame& frame = made.frame;
  if (typed.dynamic.is_wanted) return move(typed, file, frame, picture);
  frames::PathOptions options = path_options_of(typed);
  options.until = typed.until;
  options.branches = typed.branches.value_or(0);
  const Estimated e = estimated(file, typed, frame, options);
  const frames::FramePaths& paths = e.paths;
  if (paths.points.empty()) throw Failure(paths.status);
  scene::print_result(csv_of(frame, paths, e.errors, options.branches > 0));
  if (picture.wanted()) picture.draw([&] { return frame_picture(frame, paths); });
  if (!paths.status.ok())
    throw Failure(Status::failure(
        paths.status.outcome(),
        fmt::format("frame: all points found are printed, but a path did not reach its end: {}",
                    paths.status.sentence())));
  print_mesh_error(e, typed);
  print_unfollowed_branches(paths);
}

}  // namespace

void add_frame_command(scene::Commands& all) {
  all.add("frame",
          "Follow the equilibrium path of a plane frame from rest under dead loads or given displacements; "
          "prints as CSV load_factor, displacements of the named nodes that are free, forces at given "
          "displacements, mesh_error (relative, estimated with another number of elements: of the load "
          "factor at limit and branch points, else of displacements and forces), negative_eigenvalues (of "
          "the tangent stiffness; 0: stable), kind (step, maximum, minimum, bifurcation). With --dynamic its "
          "motion: time, load_factor, displacements, energies",
          declare, work);
}

}  // namespace nlmech::chapters::homotopy
