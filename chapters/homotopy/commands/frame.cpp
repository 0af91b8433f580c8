#include <fmt/format.h>

#include <optional>
#include <string>

#include "chapters/homotopy/commands/commands.hpp"
#include "chapters/homotopy/commands/frame_file.hpp"
#include "chapters/homotopy/commands/frame_picture.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {
namespace {

/// What was typed.
struct Words {
  std::string file, plot;
  int steps = 200, elements = 4, branches = 0;
  std::optional<double> until;
};

void declare(scene::Options& options, Words& words) {
  options.add("file", words.file, "the frame, TOML; - is standard input").required();
  options.add("--steps", words.steps, "along each branch, at most").range(1, 100'000);
  options
      .add("--until", words.until,
           "load factor of either sign at which a branch ends; without it twice the greatest of a limit or "
           "branch point on it, if it has one")
      .positive();
  options.add("--elements", words.elements, "beam-columns a member, times its own number of elements")
      .range(1, 100'000);
  options
      .add("--branches", words.branches,
           "so many branches are followed besides the path from rest, both ways from a bifurcation, in the "
           "order in which they are met; with a column branch")
      .range(0, 1000);
  options.add("--plot", words.plot, "FILE.svg: load factor against the largest displacement, and shapes");
}

std::string csv_of(const frames::NamedFrame& frame, const frames::FramePaths& paths, bool with_branch) {
  std::string text(with_branch ? "branch,load_factor" : "load_factor");
  for (const frames::NamedMotion& m : frame.motions) text.append(",").append(scene::csv_field(m.name));
  text += ",negative_eigenvalues,kind\n";
  for (const frames::FramePoint& p : paths.points) {
    if (with_branch) text += fmt::format("{},", p.branch);
    text += fmt::format("{:.12g}", p.load);
    for (const frames::NamedMotion& m : frame.motions) text += fmt::format(",{:.12g}", p.x[m.unknown]);
    text += fmt::format(",{},{}\n", p.negative, to_string(p.kind));
  }
  return text;
}

void work(const Words& words) {
  const scene::Picture picture(words.plot);
  const frames::NamedFrame frame = build_frame(read_frame(words.file), words.elements);
  const frames::FramePaths paths = equilibrium_paths(
      frame.frame, frame.load, {.steps = words.steps, .until = words.until, .branches = words.branches});
  if (paths.points.empty()) throw Failure(paths.status);
  scene::print_result(csv_of(frame, paths, words.branches > 0));
  if (picture.wanted()) picture.draw([&] { return frame_picture(frame, paths); });
  if (!paths.status.ok())
    throw Failure(Status::failure(
        paths.status.outcome(), fmt::format("frame: all points found are printed, and a path did not get to "
                                            "its end: {}",
                                            paths.status.sentence())));
  if (paths.unfollowed > 0)
    scene::tell(
        fmt::format("frame: {} halves of branches leave the paths and are not followed; --branches {} "
                    "follows more",
                    paths.unfollowed, paths.branches + paths.unfollowed));
}

}  // namespace

void add_frame_command(scene::Commands& all) {
  all.add("frame",
          "The equilibrium path of a plane frame of your own under growing dead loads, from rest, as CSV: "
          "load_factor, displacements of the named nodes that are free, negative_eigenvalues (of the tangent "
          "stiffness: 0 is stable), kind: step, maximum, minimum, bifurcation",
          declare, work);
}

}  // namespace nlmech::chapters::homotopy
