#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/commands/commands.hpp"
#include "chapters/homotopy/commands/frame_dynamic.hpp"
#include "chapters/homotopy/commands/frame_file.hpp"
#include "chapters/homotopy/commands/frame_picture.hpp"
#include "nlmech/frames/named/frame_forces.hpp"
#include "nlmech/frames/named/frame_modes.hpp"
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
  std::vector<double> at;
  bool has_forces = false;
  std::optional<int> modes;
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
  options.add(
      "--at", typed.at,
      "load factors, such as 0.5,1: rows there, and at limit and branch points, alone; the default of "
      "--until is then the farthest of them");
  options.add("--forces", typed.has_forces,
              "adds columns: forces at both ends of each member and its greatest moment, forces of supports "
              "and springs");
  options
      .add("--modes", typed.modes,
           "the lowest modes of linear buckling and of vibration instead of the path, under the constant "
           "loads or at the load factors --at: their number")
      .range(1, 1000);
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

/// Load factor at which the paths end, if it is given.
std::optional<double> until_of(const FrameOptions& typed) {
  if (typed.until || typed.at.empty()) return typed.until;
  const double far = *std::ranges::max_element(typed.at, {}, [](double load) { return std::abs(load); });
  return far == 0 ? std::nullopt : std::optional(far);
}

/// Throws InputError for an option that the mode does not use. With --dynamic, an imperfection still uses
/// --turn and --steps: its shape comes from a path.
void require_used(const FrameOptions& typed, const FrameFile& file) {
  if (typed.until && *typed.until == 0)
    throw InputError("--until 0: the frame is at rest there; give another load factor");
  const double until = until_of(typed).value_or(0);
  for (const double load : typed.at) {
    if (load != 0 && (load * until < 0 || std::abs(load) > std::abs(until)))
      throw InputError(fmt::format("--at {}: is not between 0 and the end of the path, {}", load, until));
  }
  const std::array path_only = {
      std::pair{"--forces", typed.has_forces}, std::pair{"--branches", typed.branches.has_value()},
      std::pair{"--plot", !typed.plot.empty()}, std::pair{"--dynamic", typed.dynamic.is_wanted}};
  for (const auto& [option, is_typed] : path_only) {
    if (typed.modes && is_typed)
      throw InputError(fmt::format("{}: leave out this option or --modes", option));
  }
  if (!typed.dynamic.is_wanted) return require_none(typed.dynamic);
  const std::array given = {std::pair{"--until", typed.until.has_value()},
                            std::pair{"--branches", typed.branches.has_value()},
                            std::pair{"--at", !typed.at.empty()},
                            std::pair{"--forces", typed.has_forces},
                            std::pair{"--turn", typed.turn && !file.model.imperfection},
                            std::pair{"--steps", typed.steps && !file.model.imperfection}};
  for (const auto& [option, is_typed] : given) {
    if (is_typed)
      throw InputError(
          fmt::format("{}: is for equilibrium paths; leave out this option or --dynamic", option));
  }
}

/// Columns of forces: those at prescribed displacements, and with --forces all.
class ForceColumns {
 public:
  ForceColumns(const FrameFile& file, const frames::NamedFrame& frame, bool is_all)
      : file_(file), frame_(frame), is_all_(is_all) {
    using frames::Motion;
    for (int node = 0; node < static_cast<int>(file.model.nodes.size()); ++node) {
      for (const Motion motion : {Motion::x, Motion::y, Motion::rotation}) {
        if (!is_held(node, motion)) continue;
        held_.push_back(3L * node + static_cast<Eigen::Index>(motion));
        names_ += column(fmt::format("{}.{}.force", file.model.nodes[static_cast<std::size_t>(node)].name,
                                     to_string(motion)));
      }
    }
    if (is_all) name_members();
  }

  [[nodiscard]] const std::string& names() const { return names_; }

  /// The fields of a row.
  [[nodiscard]] std::string at(const Eigen::VectorXd& x, double load) const {
    if (names_.empty()) return {};
    const frames::FrameForces forces = forces_of(file_.model, frame_, x, load);
    std::string text;
    const auto add = [&](double value) { text += fmt::format(",{:.12g}", value); };
    for (const Eigen::Index i : held_) add(forces.nodes[i]);
    if (!is_all_) return text;
    for (const frames::MemberForces& m : forces.members) {
      for (const frames::SectionForces& s : {m.first, m.second}) add(s.axial), add(s.shear), add(s.moment);
      add(m.moment);
    }
    for (const double force : forces.springs) add(force);
    return text;
  }

 private:
  static std::string column(const std::string& name) { return "," + scene::csv_field(name); }

  [[nodiscard]] bool is_held(int node, frames::Motion motion) const {
    const Eigen::Index at = frame_.frame.unknown(node, motion);
    if (at >= 0) return std::binary_search(frame_.given.begin(), frame_.given.end(), at);
    return is_all_ && std::ranges::any_of(frame_.supports, [&](const frames::Support& s) {
             return s.node == node && s.motion == motion;
           });
  }

  /// Members that join the same nodes are numbered from the second on.
  void name_members() {
    std::map<std::string, int> known;
    for (const frames::NamedMember& m : file_.model.members) {
      std::string name = m.first + '-' + m.second;
      if (const int number = ++known[name]; number > 1) name += fmt::format(" {}", number);
      for (const std::string& end : {m.first, m.second}) {
        for (const char* const part : {"axial", "shear", "moment"})
          names_ += column(fmt::format("{}.{}.{}", name, end, part));
      }
      names_ += column(name + ".moment");
    }
    for (std::size_t i = 1; i <= file_.model.springs.size(); ++i)
      names_ += fmt::format(",spring_{}.force", i);
  }

  const FrameFile& file_;
  const frames::NamedFrame& frame_;
  bool is_all_;
  std::vector<Eigen::Index> held_;  ///< indices in FrameForces::nodes
  std::string names_;
};

/// Estimated discretisation error of each path point; nothing if not known.
using MeshErrors = std::vector<std::optional<double>>;

std::string csv_of(const frames::NamedFrame& frame, const frames::FramePaths& paths, const MeshErrors& errors,
                   const ForceColumns& forces, const FrameOptions& typed) {
  const bool with_branch = typed.branches.value_or(0) > 0;
  std::string text(with_branch ? "branch,load_factor" : "load_factor");
  for (const frames::NamedMotion& m : frame.motions) text.append(",").append(scene::csv_field(m.name));
  text += forces.names() + ",mesh_error,negative_eigenvalues,kind\n";
  for (std::size_t i = 0; i < paths.points.size(); ++i) {
    const frames::FramePoint& p = paths.points[i];
    if (!typed.at.empty() && p.kind == frames::FramePoint::Kind::step &&
        std::ranges::find(typed.at, p.load) == typed.at.end())
      continue;
    if (with_branch) text += fmt::format("{},", p.branch);
    text += fmt::format("{:.12g}", p.load);
    for (const frames::NamedMotion& m : frame.motions) text += fmt::format(",{:.12g}", p.x[m.unknown]);
    text += forces.at(p.x, p.load);
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
  e.status = e.paths.status;
  if (e.status.outcome() == Outcome::time_limit) return e;  // nor is there time for a second mesh
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
  if (std::ranges::any_of(e.errors, [](const auto& error) { return error.has_value(); }))
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

/// The modes at each load factor, or the status of a failure.
std::vector<frames::FrameModes> modes_of(const FrameOptions& typed, const frames::Imperfect& made,
                                         const std::vector<double>& loads) {
  frames::PathOptions options = path_options_of(typed);
  options.until = until_of(typed);
  options.at = loads;
  const frames::Start start = start_of(made.frame, options);
  const frames::FramePaths paths =
      options.until ? equilibrium_paths(made.frame, options) : frames::FramePaths{};
  for (const Status& status : {made.status, start.status}) {
    if (!status.ok()) return std::vector<frames::FrameModes>(loads.size(), {{}, status});
  }
  std::vector<frames::FrameModes> all;
  for (const double load : loads) {
    const auto at = std::ranges::find(paths.points, load, &frames::FramePoint::load);
    if (load != 0 && at == paths.points.end())
      all.push_back({{}, paths.status});
    else
      all.push_back(frame_modes(made.frame, load == 0 ? start.x : at->x, load, *typed.modes));
  }
  return all;
}

/// The value of the mode of this kind and number, from 0; none if there is no such mode.
std::optional<double> value_of(const frames::FrameModes& modes, frames::FrameMode::Kind kind, int number) {
  for (const frames::FrameMode& mode : modes.modes) {
    if (mode.kind == kind && number-- == 0) return mode.value;
  }
  return std::nullopt;
}

void print_modes(const FrameOptions& typed, const FrameFile& file, const frames::Imperfect& made) {
  const std::vector<double> loads = typed.at.empty() ? std::vector{0.} : typed.at;
  const int second = frames::second_mesh(typed.elements, made.frame.frame.members().size());
  const auto modes = modes_of(typed, made, loads);
  const auto failed = std::ranges::find_if(modes, [](const auto& m) { return !m.status.ok(); });
  const bool is_empty = std::ranges::all_of(modes, [](const auto& m) { return m.modes.empty(); });
  if (is_empty && failed != modes.end()) throw Failure(failed->status);
  if (is_empty)
    throw InputError(fmt::format("--modes: {} has neither masses nor loads that compress", file.name));
  const auto others = modes_of(typed, frame_of(file, typed, second), loads);
  const double factor = frames::mesh_factor(typed.elements, second);
  std::string text = "load_factor,kind,mode,value,mesh_error";
  for (const frames::NamedMotion& m : made.frame.motions) text.append(",").append(scene::csv_field(m.name));
  text += "\n";
  for (std::size_t i = 0; i < loads.size(); ++i) {
    std::array<int, 2> numbers = {0, 0};
    for (const frames::FrameMode& mode : modes[i].modes) {
      const int number = numbers[static_cast<std::size_t>(mode.kind)]++;
      text += fmt::format("{:.12g},{},{},{:.12g},", loads[i], to_string(mode.kind), number + 1, mode.value);
      const auto other = value_of(others[i], mode.kind, number);
      if (other) text += fmt::format("{:.2g}", std::min(1., factor * std::abs(1 - *other / mode.value)));
      for (const frames::NamedMotion& m : made.frame.motions)
        text += fmt::format(",{:.12g}", mode.shape[m.unknown]);
      text += "\n";
    }
  }
  scene::print_result(text);
  if (failed != modes.end()) throw Failure(failed->status);
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
  file.model.needs_load = !typed.modes;
  const frames::Imperfect made = frame_of(file, typed, typed.elements);
  if (!made.status.ok()) throw Failure(made.status);
  if (file.model.imperfection)
    scene::print_message(
        fmt::format("frame: imperfection of {:.6g} in the shape of the {} at load factor {:.10g}",
                    file.model.imperfection->amplitude, to_string(made.buckled.kind), made.buckled.load));
  const frames::NamedFrame& frame = made.frame;
  if (picture.wanted() && frame.motions.empty())
    throw InputError("--plot: all nodes of the file are fixed; add one where the frame moves");
  if (typed.dynamic.is_wanted) return move(typed, file, frame, picture);
  if (typed.modes) return print_modes(typed, file, made);
  frames::PathOptions options = path_options_of(typed);
  options.until = until_of(typed);
  options.at = typed.at;
  options.branches = typed.branches.value_or(0);
  const Estimated e = estimated(file, typed, frame, options);
  const frames::FramePaths& paths = e.paths;
  if (paths.points.empty()) throw Failure(paths.status);
  scene::print_result(csv_of(frame, paths, e.errors, ForceColumns(file, frame, typed.has_forces), typed));
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
          "the tangent stiffness; 0: stable), kind (step, maximum, minimum, bifurcation). With --modes its "
          "modes: "
          "load_factor, kind (buckling, vibration), mode, value (critical load factor; cycles per time), "
          "mesh_error, shape. With --dynamic its motion: time, load_factor, displacements, energies",
          declare, work);
}

}  // namespace nlmech::chapters::homotopy
