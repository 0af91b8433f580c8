#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy::error_vs_time {
namespace {

using Extended = long double;

const char *const kinsol = "kinsol", *const trust_region = "energy-trust-region";
constexpr std::array homotopies = {"fixed-point", "newton-homotopy", "scalar-homotopy"};

/// A toggle with its load (inch, pound).
struct Setting {
  double height, load;
  int elements;
};
constexpr std::array settings = {Setting{0.32, low_load, 1}, Setting{0.32, low_load, 16},
                                 Setting{0.44, near_load, 1}, Setting{0.44, near_load, 16}};

/// The half toggle under a load and its reference equilibrium.
class Subject {
 public:
  explicit Subject(const Setting& s)
      : toggle_(make_frame(frames::Toggle{.height = s.height, .elements = s.elements})),
        equations_(toggle_.frame, toggle_.load, s.load),
        scale_(s.load / 2) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(equations_.size());
    const algebraic::Report report = find_root(algebraic::EnergyTrustRegion{}, equations_, x);
    if (!report.status.ok()) throw Failure(report.status);
    reference_ = refined(x.cast<Extended>(), s.load);
  }
  [[nodiscard]] frames::Equilibrium& equations() { return equations_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] Extended reference() const { return reference_; }
  /// Relative error of the apex deflection.
  [[nodiscard]] double error(const Eigen::VectorXd& x) const {
    return static_cast<double>(std::abs(-Extended(x[toggle_.apex]) / reference_ - 1));
  }

 private:
  /// Apex deflection after four Newton iterations from @p x in extended precision.
  Extended refined(frames::Frame::Displacements<Extended> x, double load) const {
    using Matrix = Eigen::Matrix<Extended, Eigen::Dynamic, Eigen::Dynamic>;
    frames::Frame::Displacements<Extended> f;
    Eigen::SparseMatrix<Extended> k;
    for (int i = 0; i < 4; ++i) {
      if (!toggle_.frame.force<Extended>(x, f).ok() || !toggle_.frame.tangent<Extended>(x, k).ok())
        throw Failure("the reference of the toggle has no tangent");
      x -= Eigen::PartialPivLU<Matrix>(Matrix(k)).solve(f - Extended(load) * toggle_.load.cast<Extended>());
    }
    return -x[toggle_.apex];
  }

  frames::ToggleFrame toggle_;
  frames::Equilibrium equations_;
  double scale_;
  Extended reference_ = 0;
};

/// Reference deflection of a toggle and the results of the solvers.
struct Toggle {
  double reference;
  scene::ProblemLines problem;
};

algebraic::Report solve(const std::string& solver, Subject& subject, double tolerance, std::int64_t limit,
                        Eigen::VectorXd& x) {
  x.setZero(subject.equations().size());
  const double bound = tolerance * subject.scale();
  if (solver == kinsol)
    return find_root(peers::Kinsol{.tolerance = bound, .iterations = limit}, subject.equations(), x);
  if (solver != trust_region)
    return find_root(algebraic::NamedSolver{solver, tolerance, subject.scale(), limit}, subject.equations(),
                     x);
  // The energy minimisation has no tolerance on F; the observer stops it at the same residual as the others.
  const auto reached = [bound](const algebraic::Iterate& at) { return at.norm > bound; };
  algebraic::EnergyTrustRegion method;
  method.iterations = static_cast<int>(limit);
  algebraic::Report report = find_root(method, subject.equations(), x, reached);
  if (report.last <= bound) report.status = {};
  return report;
}

scene::Attempt attempt(const std::string& solver, Subject& subject, double tolerance, bool quick) {
  Eigen::VectorXd x;
  Statistics work;
  scene::Attempt result = scene::attempt(
      fmt::format("tolerance {:.0e}", tolerance),
      [&] { return solve(solver, subject, tolerance, quick ? 500 : 2500, x); },
      [&](const algebraic::Report& report) -> scene::Ending {
        work = report.statistics;
        if (!report.status.ok()) return {report.status, {}};
        return {report.status, std::max(subject.error(x), 1e-16)};
      },
      quick);
  result.work = {work.steps + work.rejected, work.right_hand_sides, work.jacobians};
  return result;
}

std::vector<std::string> solvers() {
  std::vector<std::string> names;
  for (const std::string_view name : algebraic::solver_names()) names.emplace_back(name);
  names.emplace_back(kinsol);
  if (std::find(names.begin(), names.end(), trust_region) == names.end()) names.emplace_back(trust_region);
  return names;
}

/// Groups of solvers; the last group takes all solvers not listed.
const std::vector<std::pair<scene::MethodGroup, std::vector<std::string>>> groups = {
    {{"Newton's kind", 2}, {"newton", "least-squares", "continuous-newton", "broyden"}},
    {{"globalised by |F|", 5}, {"damped-newton", "kinsol", "levenberg-marquardt", "dogleg"}},
    {{"descent", 6}, {"steepest-descent", "fictitious-time", "optimal-iterative"}},
    {{"energy", 0}, {trust_region}},
    {{"path following", 4}, {"riks", "crisfield", "gdc"}},
    {{"homotopy", 1}, {}}};

std::size_t group_of(const std::string& solver) {
  const auto has = [&](const auto& group) { return std::ranges::count(group.second, solver) > 0; };
  return std::min(static_cast<std::size_t>(std::ranges::find_if(groups, has) - groups.begin()),
                  groups.size() - 1);
}

Toggle measure(const Setting& setting, bool quick) {
  Subject subject(setting);
  Toggle toggle{static_cast<double>(subject.reference()),
                {fmt::format("{:.2f} in, {:.2f} lb, {} element{} a member", setting.height, setting.load,
                             setting.elements, setting.elements == 1 ? "" : "s"),
                 {}}};
  for (const std::string& solver : solvers()) {
    scene::MethodLine& line = toggle.problem.lines.emplace_back();
    line.method = solver;
    line.group = group_of(solver);
    const bool treated = solver == trust_region || line.group + 1 == groups.size();  // homotopies
    line.side = solver == kinsol ? scene::Side::peer : treated ? scene::Side::subject : scene::Side::library;
    if (solver == kinsol && !peers::kinsol_available()) continue;
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
      if (quick && tolerance != 1e-4 && tolerance != 1e-8) continue;
      line.attempts.push_back(attempt(solver, subject, tolerance, quick));
      if (!line.attempts.back().error) break;  // assume that tighter tolerances fail too
    }
  }
  return toggle;
}

std::vector<Toggle> measure_all(bool quick) {
  std::vector<Toggle> toggles;
  for (const Setting& s : settings) toggles.push_back(measure(s, quick));
  return toggles;
}

void draw(const std::vector<Toggle>& toggles, scene::Show& show) {
  std::vector<scene::ProblemLines> problems;
  for (const Toggle& t : toggles) problems.push_back(t.problem);
  std::vector<scene::MethodGroup> looks;
  for (const auto& [look, members] : groups) looks.push_back(look);
  const auto& last = problems.back().lines;
  const auto passed =
      std::ranges::count_if(last, [](const scene::MethodLine& l) { return l.least_error() < 1; });
  scene::show_work_precision(
      {.heading = fmt::format("Digits against time: with 16 elements {} of {} solvers pass the limit point",
                              passed, last.size()),
       .digits = "digits of the deflection",
       .most_digits = 17.5,
       .error = "error of the deflection",
       .work = {"iterations", "residuals", "Jacobians"},
       .groups = std::move(looks)},
      problems, show);
}

void put(const std::vector<Toggle>& toggles, scene::Show& show) {
  draw(toggles, show);
  // oracle: homotopy_frames toggle 0.32 of 1 drop under 27.11, toggle 0.44 of 1 drop under 43.79
  const char* program = "tools/oracles/homotopy_frames.py, all digits";
  show.near("deflection, height 0.32, 1 element", {toggles[0].reference, "in"}, 0.265167973289, 1e-11,
            program);
  show.near("deflection, height 0.44, 1 element", {toggles[2].reference, "in"}, 0.621922545486, 1e-11,
            program);
  // Rounding eps l of a chord length gives an axial force eps EA with the apex component eps EA sin(beta).
  // The stiffness is 15 lb/in or more.
  const double rounding = 2.2e-16 * 1.885e6 * 0.034 / 7 / 0.26;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Setting& s = settings[i];
    show.at_most(fmt::format("least error of the energy trust region, height {}, {} element{}", s.height,
                             s.elements, s.elements == 1 ? "" : "s"),
                 toggles[i].problem.of(trust_region).least_error(),
                 show.quick() ? 1e-6 : 1e-9 + 64 * rounding,
                 show.quick() ? "tolerance 1e-8, 0.3 % of the load an inch at least"
                              : "tolerance 1e-10 over the stiffness there, and rounding");
  }
  for (const std::size_t i : {std::size_t{1}, std::size_t{3}}) {
    const auto converged = std::ranges::count_if(homotopies, [&](const char* name) {
      return std::isfinite(toggles[i].problem.of(name).least_error());
    });
    show.at_most(fmt::format("scalar homotopies that converge, height {}, 16 elements", settings[i].height),
                 converged, 0,
                 "regression value: none of several steps in 2500 iterations, and more elements are worse "
                 "conditioned");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result times(
      "solver-times",
      "half toggle from rest; tolerances on |F| over the load, the same for all, 2500 iterations at most; "
      "error of the apex's deflection against Newton's iteration in extended precision; one thread, median "
      "of "
      "repeats",
      measure_all);
  return {{.name = "error-vs-time-toggle",
           .title = "Digits of the deflection against time, all solvers, before and past the limit point",
           .content = scene::Content(put, times)}};
}

}  // namespace nlmech::chapters::homotopy::error_vs_time
