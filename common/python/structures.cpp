#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "chapters/gss_control/commands/spacecraft_file.hpp"
#include "chapters/homotopy/commands/frame_file.hpp"
#include "common/python/module.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/frames/named/mesh_error.hpp"
#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::python {
namespace {

using chapters::homotopy::FrameFile;
using frames::FramePaths;
using frames::NamedFrame;

/// A frame, its paths and their mesh errors, as far as they are known.
struct Traced {
  NamedFrame frame;
  FramePaths paths;
  std::vector<std::optional<double>> errors;
};

/// Frame with its imperfection.
frames::Imperfect frame_of(const FrameFile& file, int elements, frames::PathOptions options) {
  const NamedFrame perfect = build_frame(file, elements);
  if (!file.model.imperfection) return {perfect, {}, {}};
  options.until = {};
  options.branches = 0;
  return imperfect(perfect, *file.model.imperfection, options);
}

/// Follows the paths of a frame on two meshes, as the command does.
Traced trace(const FrameFile& file, int elements, frames::PathOptions options) {
  const Stopwatch watch;
  const double limit = options.seconds;
  const auto left = [&] { return std::max(limit - watch.seconds(), 1e-3); };
  const frames::Imperfect made = frame_of(file, elements, options);
  if (!made.status.ok()) throw Failure(made.status);
  Traced traced{made.frame, {}, {}};
  options.seconds = left();
  traced.paths = equilibrium_paths(traced.frame, options);
  traced.errors.resize(traced.paths.points.size());
  if (!traced.paths.status.ok()) return traced;
  const int other = frames::second_mesh(elements, traced.frame.members.size());
  options.seconds = left();
  const frames::Imperfect second = frame_of(file, other, options);
  if (!second.status.ok()) return traced;  // an imperfection that this mesh does not have
  options.steps += options.steps / 2;
  options.seconds = left();
  const FramePaths compared = equilibrium_paths(second.frame, options);
  traced.errors = frames::mesh_errors(
      {traced.frame, traced.paths, second.frame, compared, frames::mesh_factor(elements, other)}, left());
  return traced;
}

/// Status; names of the displacements, their values, one row for each, forces there, and whether these are
/// of prescribed displacements; load factors, mesh errors, branches, negative eigenvalues and kinds.
auto path(const std::string& name, const std::optional<std::string>& load_case, int elements, int steps,
          std::optional<double> until, int branches, double turn, double seconds) {
  const FrameFile file = chapters::homotopy::read_frame(name, load_case);
  if (until == 0.) throw input_error("--until 0: the frame is at rest there; give another load factor");
  const auto [frame, paths, errors] =
      trace(file, elements,
            {.steps = steps, .until = until, .branches = branches, .turn = turn, .seconds = seconds});
  std::vector<std::string> names, kinds;
  std::vector<Eigen::Index> unknowns;
  std::vector<bool> is_held;
  for (const frames::NamedMotion& m : frame.motions) {
    names.push_back(m.name);
    unknowns.push_back(m.unknown);
    is_held.push_back(std::ranges::binary_search(frame.given, m.unknown));
  }
  Rows<> displacements(std::ssize(names), std::ssize(paths.points)), forces = displacements;
  std::vector<double> loads;
  std::vector<int> branch, negative;
  Eigen::VectorXd force;
  for (const frames::FramePoint& p : paths.points) {
    static_cast<void>(frame.frame.force<double>(p.x, force));
    displacements.col(std::ssize(loads)) = p.x(unknowns);
    forces.col(std::ssize(loads)) = force(unknowns);
    loads.push_back(p.load);
    branch.push_back(p.branch);
    negative.push_back(static_cast<int>(p.negative));
    kinds.emplace_back(to_string(p.kind));
  }
  return std::tuple(text_of(paths.status), names, displacements, forces, is_held, loads, errors, branch,
                    negative, kinds);
}

using spacecraft::Complex;

/// theta and y at s = j omega: arrays (frequency) and (frequency, place).
std::pair<Eigen::VectorXcd, Rows<Complex>> response(const std::string& file, const std::string& text,
                                                    const std::vector<double>& omega,
                                                    const std::vector<double>& places,
                                                    const std::optional<std::array<double, 3>>& gains) {
  using namespace chapters::gss_control;
  const spacecraft::Plant plant(text.empty() ? read_spacecraft(file) : parse_spacecraft(text, "spacecraft"));
  std::optional<spacecraft::ClosedLoop> loop;
  if (gains) loop.emplace(plant.parameters(), spacecraft::Gains{(*gains)[0], (*gains)[1], (*gains)[2]});
  Eigen::VectorXcd theta(std::ssize(omega));
  Rows<Complex> y(theta.size(), std::ssize(places));
  unlocked(py::none(), [&](Job& job) {
    for (Eigen::Index i = 0; i < theta.size() && job.reached(0); ++i) {
      const Complex s(0, omega[static_cast<std::size_t>(i)]);
      const std::span<Complex> row(y.row(i).data(), places.size());
      Outcome outcome = Outcome::success;
      if (loop) {
        const spacecraft::LoopResponse r = loop->response(s);
        theta[i] = r.theta;
        outcome = r.outcome;
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = loop->response(s, places[k]).deflection;
      } else {
        outcome = plant.response(s, places, theta[i], row);
      }
      if (outcome != Outcome::success) throw Failure(plant.status(outcome, s));
    }
  });
  return {theta, y};
}

}  // namespace

void add_structures(py::module_& module) {
  module.def("path", &path, Unlocked());
  module.def("response", &response);
}

}  // namespace nlmech::python
