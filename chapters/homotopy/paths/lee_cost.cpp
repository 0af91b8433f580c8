#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chapters/homotopy/paths/limit_point.hpp"
#include "chapters/homotopy/paths/walked.hpp"
#include "chapters/homotopy/solvers/solver_groups.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy::lee_cost {
namespace {

const char *const kinsol = "kinsol", *const walk_name = "path walk";
constexpr std::array without_matrix = {"steepest-descent", "fictitious-time", "optimal-iterative",
                                       "scalar-homotopy",  "fixed-point",     "newton-homotopy"};
constexpr double near_start = 1.8, far_start = 1.5;

/// Lee's frame, 10 elements a member, and its upper limit load.
class Subject {
 public:
  Subject() : lee_(build(shipped_model("lee"), 2)) {
    const frames::FramePaths paths = equilibrium_paths(lee_, {.turn = 0.1, .critical = 1});
    if (!paths.status.ok()) throw Failure(paths.status);
    const frames::FramePoint& top = paths.points.back();
    Eigen::VectorXd z(2 * lee_.frame.size() + 1);
    z << top.x, top.mode.normalized(), top.load;
    reference_ = LimitPoint(lee_.frame, lee_.load, 1).refined(z);
  }
  [[nodiscard]] const frames::NamedFrame& lee() const { return lee_; }
  [[nodiscard]] double reference() const { return static_cast<double>(reference_); }
  [[nodiscard]] double error(double load) const {
    return std::max(static_cast<double>(std::abs(load / reference_ - 1)), 1e-16);
  }

 private:
  frames::NamedFrame lee_;
  long double reference_ = 0;
};

/// How a way to the limit load ended, where, and what it took.
struct Found {
  Status status;
  double load = 0;
  Statistics work;
};

/// From rest to the start, and by a solver from there to the limit point.
Found solve(const Subject& subject, double from, const std::string& solver, double tolerance, bool quick) {
  const std::int64_t limit = quick ? 100 : 300;
  const frames::NamedFrame& lee = subject.lee();
  const LimitPointStart start = limit_point_start(lee.frame, lee.load, from);
  LimitPoint equations(lee.frame, lee.load, start.stiffness);
  Eigen::VectorXd z = start.z;
  const algebraic::Report report =
      solver == kinsol ? find_root(peers::Kinsol{.tolerance = tolerance, .iterations = limit}, equations, z)
                       : find_root(algebraic::NamedSolver{solver, tolerance, 1, limit}, equations, z);
  return {report.status, z[z.size() - 1], start.statistics + report.statistics};
}

Found walk(const Subject& subject, double turn) {
  const frames::FramePaths paths =
      equilibrium_paths(subject.lee(), {.steps = 2000, .turn = turn, .critical = 1});
  return {paths.status, paths.points.empty() ? 0 : paths.points.back().load, paths.statistics};
}

template <class Find>
scene::Attempt attempt(const Subject& subject, std::string setting, const Find& find, bool quick) {
  Statistics work;
  scene::Attempt result = scene::attempt(
      std::move(setting), find,
      [&](const Found& found) -> scene::Ending {
        work = found.work;
        if (!found.status.ok()) return {found.status, {}};
        return {found.status, subject.error(found.load)};
      },
      quick);
  result.work = {work.factorisations, work.right_hand_sides};
  return result;
}

const SolverGroups& groups() {
  static const SolverGroups all = solver_groups({{"path of the frame", 0}, {walk_name}});
  return all;
}

std::vector<std::string> solvers() {
  std::vector<std::string> names;
  for (const std::string_view name : algebraic::solver_names()) {
    if (name != "energy-trust-region") names.emplace_back(name);  // these equations have no energy
  }
  names.emplace_back(kinsol);
  return names;
}

scene::MethodLine line_of(const std::string& method, scene::Side side) {
  scene::MethodLine line;
  line.method = method;
  line.group = group_of(groups(), method);
  line.side = side;
  return line;
}

/// What all came to from near, and from far the solvers that arrived.
struct Cost {
  double reference;
  scene::ProblemLines problem;
  int arrived = 0;
};

/// At the limit point, and not at another root.
bool has_arrived(double error) { return error < 1e-3; }

Cost measure(bool quick) {
  const Subject subject;
  Cost cost{subject.reference(), {}, 0};
  scene::MethodLine walked = line_of(walk_name, scene::Side::subject);
  for (const double turn : {0.6, 0.3, 0.15, 0.075}) {
    walked.attempts.push_back(attempt(
        subject, fmt::format("turn {:.3g}", turn), [&] { return walk(subject, turn); }, quick));
  }
  cost.problem.lines.push_back(std::move(walked));
  for (const std::string& solver : solvers()) {
    const bool is_homotopy = group_of(groups(), solver) + 1 == groups().size();
    scene::MethodLine line = line_of(solver, solver == kinsol ? scene::Side::peer
                                             : is_homotopy    ? scene::Side::subject
                                                              : scene::Side::ours);
    for (const double tolerance : {1e-2, 1e-4, 1e-7, 1e-10}) {
      if (solver == kinsol && !peers::kinsol_available()) break;
      if (quick && tolerance != 1e-4) continue;
      line.attempts.push_back(attempt(
          subject, fmt::format("tolerance {:.0e}", tolerance),
          [&] { return solve(subject, near_start, solver, tolerance, quick); }, quick));
      if (!line.attempts.back().error) break;  // a tighter tolerance fails as well
    }
    cost.problem.lines.push_back(std::move(line));
    if (solver == kinsol && !peers::kinsol_available()) continue;
    const Found far = solve(subject, far_start, solver, 1e-5, quick);
    if (far.status.ok() && has_arrived(subject.error(far.load))) ++cost.arrived;
  }
  return cost;
}

void put(const Cost& cost, scene::Show& show) {
  scene::show_work_precision(
      {.heading = "A walk along its path gives Lee's limit load to rounding; solvers must start near it",
       .digits = "digits of the limit load",
       .most_digits = 17.5,
       .error = "error of the limit load",
       .work = {"factorisations", "residuals"},
       .work_label = "factorisations",
       .groups = looks_of(groups())},
      {cost.problem}, show);
  // oracle: homotopy_frames Lee's frame of 10 limit
  show.near("upper limit load, 10+10 elements", cost.reference, 1.8556922898, 1e-10,
            "tools/oracles/homotopy_frames.py, all its digits");
  show.at_most("least error of the path walk", cost.problem.of(walk_name).least_error(), 1e-12,
               "a rounding of a chord's length is an axial force of eps EA, 1e-12");
  const auto& lines = cost.problem.lines;
  const auto arrives = [](const scene::MethodLine& line) {
    return line.method != walk_name && has_arrived(line.least_error());
  };
  const auto near = static_cast<double>(std::ranges::count_if(lines, arrives));
  show.between("solvers that arrive from a load of 1.8", near, 3, static_cast<double>(lines.size() - 1),
               "the three path followers at least, which need no nearness");
  show.at_most("solvers that arrive from a load of 1.5", cost.arrived, near,
               "the nearer start is the easier");
  const auto plain = static_cast<double>(std::ranges::count_if(lines, [&](const scene::MethodLine& line) {
    return std::ranges::count(without_matrix, line.method) > 0 && arrives(line);
  }));
  show.at_most("solvers without a matrix that arrive from a load of 1.8", plain, 0,
               "recorded: none in 300 iterations; the products of this matrix with its transpose have a "
               "condition that is squared");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result cost(
      "lee-limit-cost",
      "Lee's frame, chapters/homotopy/frames/lee.toml, 10 elements a member, from rest to the upper limit "
      "load: by a walk along the path with four turns a step; and by solvers for the limit point as a root "
      "(Moore and Spence 1980) from the equilibrium under a load of 1.8, tolerances on |F|, 300 iterations "
      "at most; error against Newton's iteration in extended precision; one thread, median of repeats",
      measure);
  return {{.name = "error-vs-time-lee",
           .title = "Digits of Lee's limit load against time and factorisations, all solvers",
           .content = scene::Content(put, cost)}};
}

}  // namespace nlmech::chapters::homotopy::lee_cost
