#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <optional>
#include <utility>

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

/// Frame with its imperfection. @throws Failure if the path to its shape fails
NamedFrame frame_of(const FrameFile& file, int elements, const frames::PathOptions& options) {
  NamedFrame perfect = build_frame(file, elements);
  if (!file.model.imperfection) return perfect;
  frames::PathOptions search = options;
  search.until = {};
  search.branches = 0;
  frames::Imperfect made = imperfect(perfect, *file.model.imperfection, search);
  if (!made.status.ok()) throw Failure(made.status);
  return std::move(made.frame);
}

/// Follows the paths of a frame on two meshes, as the command does.
Traced trace(const FrameFile& file, int elements, frames::PathOptions options) {
  const Stopwatch watch;
  const double limit = options.seconds;
  const auto left = [&] { return std::max(limit - watch.seconds(), 1e-3); };
  Traced traced{frame_of(file, elements, options), {}, {}};
  options.seconds = left();
  traced.paths = equilibrium_paths(traced.frame, options);
  traced.errors.resize(traced.paths.points.size());
  if (!traced.paths.status.ok()) return traced;
  const int other = frames::second_mesh(elements, traced.frame.members.size());
  try {
    options.seconds = left();
    const NamedFrame second = frame_of(file, other, options);
    options.steps += options.steps / 2;
    options.seconds = left();
    const FramePaths compared = equilibrium_paths(second, options);
    traced.errors = frames::mesh_errors(
        {traced.frame, traced.paths, second, compared, frames::mesh_factor(elements, other)}, left());
  } catch (const Failure&) {  // an imperfection that this mesh does not have: the errors are unknown
  }
  return traced;
}

/// Columns of the points of paths: a dictionary of arrays.
py::dict columns_of(const Traced& traced) {
  const auto& points = traced.paths.points;
  const auto count = static_cast<py::ssize_t>(points.size());
  const auto column = [&](const auto& value) {
    py::array_t<double> all(count);
    for (std::size_t i = 0; i < points.size(); ++i) all.mutable_data()[i] = value(i);
    return all;
  };
  std::vector<std::string> kinds;
  std::vector<Eigen::VectorXd> forces(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    kinds.emplace_back(to_string(points[i].kind));
    static_cast<void>(traced.frame.frame.force<double>(points[i].x, forces[i]));
  }
  py::dict displacement, force;
  for (const frames::NamedMotion& m : traced.frame.motions) {
    displacement[py::str(m.name)] = column([&](std::size_t i) { return points[i].x[m.unknown]; });
    if (std::ranges::binary_search(traced.frame.given, m.unknown))
      force[py::str(m.name)] = column([&](std::size_t i) { return forces[i][m.unknown]; });
  }
  py::dict all;
  all["load_factor"] = column([&](std::size_t i) { return points[i].load; });
  all["displacement"] = displacement;
  all["force"] = force;
  all["mesh_error"] = column(
      [&](std::size_t i) { return traced.errors[i].value_or(std::numeric_limits<double>::quiet_NaN()); });
  all["branch"] = py::array_t<int>(column([&](std::size_t i) { return points[i].branch; }));
  all["negative_eigenvalues"] =
      py::array_t<int>(column([&](std::size_t i) { return static_cast<double>(points[i].negative); }));
  all["kind"] = kinds;
  return all;
}

py::dict path(const std::string& file, const std::optional<std::string>& load_case, int elements, int steps,
              std::optional<double> until, int branches, double turn, double seconds) {
  const FrameFile read = chapters::homotopy::read_frame(file, load_case);
  if (until == 0.) throw input_error("--until 0: the frame is at rest there; give another load factor");
  const Traced traced = unlocked([&] {
    return trace(read, elements,
                 {.steps = steps, .until = until, .branches = branches, .turn = turn, .seconds = seconds});
  });
  if (!traced.paths.status.ok()) raise(traced.paths.status, columns_of(traced));
  return columns_of(traced);
}

using spacecraft::Complex;

spacecraft::Parameters craft_of(const std::string& file, const std::string& text) {
  return text.empty() ? chapters::gss_control::read_spacecraft(file)
                      : chapters::gss_control::parse_spacecraft(text, "spacecraft");
}

/// theta and y at s = j omega: arrays (frequency) and (frequency, place).
py::tuple response(const std::string& file, const std::string& text, const std::vector<double>& omega,
                   const std::optional<std::array<double, 3>>& gains, const std::vector<double>& places) {
  const spacecraft::Plant plant(craft_of(file, text));
  std::optional<spacecraft::ClosedLoop> loop;
  if (gains) loop.emplace(plant.parameters(), spacecraft::Gains{(*gains)[0], (*gains)[1], (*gains)[2]});
  const auto rows = static_cast<py::ssize_t>(omega.size()), columns = static_cast<py::ssize_t>(places.size());
  py::array_t<Complex> theta(rows), y({rows, columns});
  Complex *const angle = theta.mutable_data(), *const deflection = y.mutable_data();
  unlocked(py::none(), [&](Job& job) {
    for (std::size_t i = 0; i < omega.size() && job.reached(0); ++i) {
      const Complex s(0, omega[i]);
      const std::span<Complex> row(deflection + i * places.size(), places.size());
      Outcome outcome = Outcome::success;
      if (loop) {
        const spacecraft::LoopResponse r = loop->response(s);
        angle[i] = r.theta;
        outcome = r.outcome;
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = loop->response(s, places[k]).deflection;
      } else {
        outcome = plant.response(s, places, angle[i], row);
      }
      if (outcome != Outcome::success) throw Failure(plant.status(outcome, s));
    }
    return true;
  });
  return py::make_tuple(theta, y);
}

}  // namespace

void add_structures(py::module_& module) {
  module.def("path", &path);
  module.def("response", &response);
}

}  // namespace nlmech::python
