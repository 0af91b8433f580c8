#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/toggles.hpp"
#include "nlmech/algebraic/energy_trust_region.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using Extended = long double;

const char *const kinsol = "kinsol", *const trust_region = "energy-trust-region";

/// A panel of the figure.
struct Setting {
  double height, load;
  int elements;
};
constexpr std::array settings = {Setting{0.32, low_load, 1}, Setting{0.32, low_load, 16},
                                 Setting{0.44, near_load, 1}, Setting{0.44, near_load, 16}};

/// The half toggle under a load, and where it comes to rest.
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
  /// Of the apex's deflection, relative.
  [[nodiscard]] double error(const Eigen::VectorXd& x) const {
    return static_cast<double>(std::abs(-Extended(x[toggle_.apex]) / reference_ - 1));
  }

 private:
  /// Newton's iteration from there with more digits; the deflection of the apex.
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

/// What one tolerance of a solver came to.
struct Cost {
  double tolerance;
  std::string status;
  std::optional<double> error;  ///< nothing if it failed
  std::int64_t iterations = 0, residuals = 0, jacobians = 0;
  Timing time;
};

struct Line {
  std::string solver;
  std::vector<Cost> costs;  ///< ends with the first that fails
};

struct Panel {
  Setting setting;
  double reference;
  std::vector<Line> lines;

  [[nodiscard]] const Line& of(const std::string& solver) const {
    return *std::ranges::find(lines, solver, &Line::solver);
  }
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
  // It minimises energy and has no tolerance on F: stopped where the others stop.
  const auto reached = [bound](const algebraic::Iterate& at) { return at.norm > bound; };
  algebraic::EnergyTrustRegion method;
  method.iterations = static_cast<int>(limit);
  algebraic::Report report = find_root(method, subject.equations(), x, reached);
  if (report.last <= bound) report.status = {};
  return report;
}

Cost cost(const std::string& solver, Subject& subject, double tolerance, bool quick) {
  const std::int64_t limit = quick ? 500 : 2500;
  Eigen::VectorXd x;
  const Stopwatch watch;
  const algebraic::Report report = solve(solver, subject, tolerance, limit, x);
  const double first = watch.seconds();
  Cost c{tolerance,
         std::string(to_string(report.status.outcome())),
         {},
         report.statistics.steps + report.statistics.rejected,
         report.statistics.right_hand_sides,
         report.statistics.jacobians,
         {first, first, first, 1}};
  if (!report.status.ok()) return c;
  c.error = std::max(subject.error(x), 1e-16);
  if (quick || first > 0.05) return c;
  c.time = time_repeats([&] { static_cast<void>(solve(solver, subject, tolerance, limit, x)); }, 9);
  return c;
}

std::vector<std::string> solvers() {
  std::vector<std::string> names;
  for (const std::string_view name : algebraic::solver_names()) names.emplace_back(name);
  names.emplace_back(kinsol);
  if (std::find(names.begin(), names.end(), trust_region) == names.end()) names.emplace_back(trust_region);
  return names;
}

Panel measure(const Setting& setting, bool quick) {
  Subject subject(setting);
  Panel panel{setting, static_cast<double>(subject.reference()), {}};
  for (const std::string& solver : solvers()) {
    Line line{solver, {}};
    if (solver == kinsol && !peers::kinsol_available()) {
      panel.lines.push_back(line);
      continue;
    }
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
      if (quick && tolerance != 1e-4 && tolerance != 1e-8) continue;
      line.costs.push_back(cost(solver, subject, tolerance, quick));
      if (!line.costs.back().error) break;  // a tighter tolerance fails as well
    }
    panel.lines.push_back(std::move(line));
  }
  return panel;
}

std::vector<Panel> measure_all(bool quick) {
  std::vector<Panel> panels;
  for (const Setting& s : settings) panels.push_back(measure(s, quick));
  return panels;
}

/// Its colour: Newton's kind, |F| made smaller, descent, homotopy, energy, path following.
int kind_of(const std::string& solver) {
  static const std::map<std::string, int> kinds = {{"newton", 1},
                                                   {"least-squares", 1},
                                                   {"continuous-newton", 1},
                                                   {"broyden", 1},
                                                   {"damped-newton", 2},
                                                   {kinsol, 2},
                                                   {"levenberg-marquardt", 2},
                                                   {"dogleg", 2},
                                                   {"steepest-descent", 3},
                                                   {"fictitious-time", 3},
                                                   {"optimal-iterative", 3},
                                                   {trust_region, 5},
                                                   {"riks", 6},
                                                   {"crisfield", 6},
                                                   {"gdc", 6}};
  const auto found = kinds.find(solver);
  return found == kinds.end() ? 4 : found->second;
}

double best_error(const Line& line) {
  double least = HUGE_VAL;
  for (const Cost& c : line.costs) least = std::min(least, c.error.value_or(HUGE_VAL));
  return least;
}

void draw(const std::vector<Panel>& panels, scene::Show& show) {
  scene::Table data({{"panel"},
                     {"line", 3, true},
                     {"kind"},
                     {"number"},
                     {"digits"},
                     {"time_s"},
                     {"last"},
                     {"solver"},
                     {"status"}});
  const std::vector<std::string> names = solvers();
  std::vector<int> kinds;
  for (const std::string& name : names) kinds.push_back(kind_of(name));
  int line = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      ++line;
      const auto& costs = panels[p].lines[i].costs;
      for (std::size_t k = 0; k < costs.size(); ++k) {
        const Cost& c = costs[k];
        const bool last = c.error && (k + 1 == costs.size() || !costs[k + 1].error);
        std::optional<double> digits;
        if (c.error) digits = -std::log10(*c.error);
        data.add({p + 1, line, kinds[i], i + 1, digits, c.time.median, last, names[i], c.status});
      }
    }
  }
  const auto passed =
      std::ranges::count_if(panels.back().lines, [](const Line& l) { return best_error(l) < 1; });
  show.draw(std::move(data), "homotopy-error-vs-time",
            {{"heading", fmt::format("With 16 elements {} of {} solvers get past the limit point", passed,
                                     names.size())},
             {"width", "1000"},
             {"height", "720"},
             {"legend", fmt::format("{}", fmt::join(names, "|"))},
             {"kinds", fmt::format("{}", fmt::join(kinds, " "))}});
}

/// A row of the table; without a cost the solver is not in this build.
struct Row {
  Setting setting;
  std::string solver;
  std::optional<Cost> cost;

  template <class Value>
  [[nodiscard]] scene::Cell cell(Value Cost::*value) const {
    return cost ? scene::Cell(*cost.*value) : scene::Cell();
  }
  /// Thousandths of a second.
  [[nodiscard]] scene::Cell time(double Timing::*value) const {
    return cost ? scene::Cell(1e3 * cost->time.*value) : scene::Cell();
  }
};

void put_table(const std::vector<Panel>& panels, scene::Show& show) {
  std::vector<Row> rows;
  for (const Panel& p : panels) {
    for (const Line& line : p.lines) {
      if (line.costs.empty()) rows.push_back({p.setting, line.solver, {}});
      for (const Cost& c : line.costs) rows.push_back({p.setting, line.solver, c});
    }
  }
  show.table(rows, {{"height (in)", [](const Row& r) { return r.setting.height; }},
                    {"load (lb)", [](const Row& r) { return r.setting.load; }, 4},
                    {"elements", [](const Row& r) { return r.setting.elements; }},
                    {"solver", &Row::solver},
                    {"tolerance", [](const Row& r) { return r.cell(&Cost::tolerance); }},
                    {"status",
                     [](const Row& r) { return r.cost ? r.cost->status : std::string("not in this build"); }},
                    {"error of the deflection", [](const Row& r) { return r.cell(&Cost::error); }, 2},
                    {"iterations", [](const Row& r) { return r.cell(&Cost::iterations); }},
                    {"residuals", [](const Row& r) { return r.cell(&Cost::residuals); }},
                    {"Jacobians", [](const Row& r) { return r.cell(&Cost::jacobians); }},
                    {"time (ms)", [](const Row& r) { return r.time(&Timing::median); }},
                    {"from", [](const Row& r) { return r.time(&Timing::smallest); }},
                    {"to", [](const Row& r) { return r.time(&Timing::largest); }}});
}

void put(const std::vector<Panel>& panels, scene::Show& show) {
  draw(panels, show);
  put_table(panels, show);
  // oracle: homotopy_frames toggle 0.32 of 1 drop under 27.11, toggle 0.44 of 1 drop under 43.79
  const char* program = "tools/oracles/homotopy_frames.py, all digits";
  show.near("deflection, height 0.32, 1 element", {panels[0].reference, "in"}, 0.265167973289, 1e-11,
            program);
  show.near("deflection, height 0.44, 1 element", {panels[2].reference, "in"}, 0.621922545486, 1e-11,
            program);
  // Rounding of a chord's length, eps l, is an axial force of eps EA, of which sin(beta) loads the apex; the
  // stiffness there is 15 lb/in and more.
  const double rounding = 2.2e-16 * 1.885e6 * 0.034 / 7 / 0.26;
  for (const Panel& p : panels)
    show.at_most(fmt::format("least error of the energy trust region, height {}, {} element{}",
                             p.setting.height, p.setting.elements, p.setting.elements == 1 ? "" : "s"),
                 best_error(p.of(trust_region)), show.quick() ? 1e-6 : 1e-9 + 64 * rounding,
                 show.quick() ? "tolerance 1e-8, 0.3 % of the load an inch at least"
                              : "tolerance 1e-10 over the stiffness there, and rounding");
  for (const std::size_t i : {std::size_t{1}, std::size_t{3}}) {
    int converged = 0;
    for (const char* name : {"fixed-point", "newton-homotopy", "scalar-homotopy"})
      converged += std::isfinite(best_error(panels[i].of(name))) ? 1 : 0;
    show.at_most(
        fmt::format("scalar homotopies that converge, height {}, 16 elements", panels[i].setting.height),
        converged, 0,
        "recorded: none of several steps in 2500 iterations, and more elements are worse conditioned");
  }
}

}  // namespace

std::vector<scene::Scene> error_vs_time() {
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

}  // namespace nlmech::chapters::homotopy
