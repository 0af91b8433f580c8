#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "chapters/rbf_ivp/stability/stiff_problems.hpp"
#include "chapters/rbf_ivp/stability/windows.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/comparison/any_method.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::stability {
namespace {

constexpr double tolerance = 1e-6;        // of methods with step-size control
constexpr double usable_digits = 1;       // least digits of a usable run
constexpr double gaussian_shape = 0.367;  // c h of the dissertation's 7 nodes

/// Outcome of a method on a problem; for fixed-step methods, with the largest usable step size.
struct Ending {
  std::string method, problem;
  bool fixed_step = false;
  Outcome outcome = Outcome::success;  ///< outcome of the run shown; of the last run if none is usable
  bool usable = false;                 ///< success, and at least one digit
  double digits = 0;
  double step = 0;       ///< mean step size
  double stiffness = 0;  ///< step size times Stiff::rate
  std::int64_t steps = 0;
};

Ending run(const ivp::MethodInfo& method, const Stiff& problem, const ivp::Settings& settings,
           std::int64_t most) {
  const ivp::Limits limits{.steps = most};
  const auto integrate = method.with(settings);
  const ivp::Solution s = integrate(problem.system, problem.x0, 0, problem.end, {}, limits);
  Ending ending{
      std::string(method.name), problem.name, method.fixed_step(), s.status.outcome(), false, 0, 0, 0,
      s.statistics.steps};
  if (!s.status.ok()) return ending;
  ending.digits = problem.digits(s.x);
  ending.usable = ending.digits >= usable_digits;
  ending.step = problem.end / static_cast<double>(std::max<std::int64_t>(1, s.statistics.steps));
  ending.stiffness = ending.step * problem.rate;
  return ending;
}

/// Maximum number of halvings of the interval: the smallest step size is end / 2^halvings. Lower for
/// collocation, whose steps are expensive.
int most_halvings(const ivp::MethodInfo& method, bool quick) {
  const bool is_explicit =
      method.name == "euler" || method.name == "explicit" || method.name == "rk4" || method.name == "rk6";
  const int halvings = method.has(ivp::nodes_setting) ? 17 : is_explicit ? 23 : 19;
  return quick ? halvings - 6 : halvings;
}

/// Finds the largest usable step size: halves the interval until two successive step sizes are usable, then
/// enlarges the first of them by factors of 2^(1/4).
Ending with_largest_step(const ivp::MethodInfo& method, const Stiff& problem, int halvings) {
  const auto with_steps = [&](std::int64_t count) {
    const double step = problem.end / static_cast<double>(count);
    ivp::Settings settings{.step = step};
    if (method.has(ivp::shape_setting)) settings.shape = gaussian_shape / step;
    return run(method, problem, settings, count + 1);
  };
  Ending coarse = with_steps(1);
  for (int k = 1; k <= std::min(halvings, problem.halvings); ++k) {
    Ending fine = with_steps(std::int64_t{1} << k);
    if (coarse.usable && fine.usable) {
      for (int quarter = 3; quarter >= 1; --quarter) {
        const auto count = std::llround(std::exp2(k - 1 - quarter / 4.0));
        if (Ending longer = with_steps(count); longer.usable) return longer;
      }
      return coarse;
    }
    coarse = std::move(fine);
  }
  coarse.usable = false;
  return coarse;
}

Ending ending_of(const ivp::MethodInfo& method, const Stiff& problem, bool quick) {
  Ending refused{.method = std::string(method.name),
                 .problem = problem.name,
                 .fixed_step = method.fixed_step(),
                 .outcome = Outcome::outside_validity};
  if (method.second_order_only && !problem.system.second_order()) return refused;
  if (method.fixed_step()) return with_largest_step(method, problem, most_halvings(method, quick));
  // RKN12(10) throws before the first step for accelerations that depend on velocities.
  try {
    return run(method, problem, {.tolerance = tolerance, .absolute_tolerance = tolerance * problem.absolute},
               std::int64_t{1} << (quick ? 14 : 17));
  } catch (const std::invalid_argument&) {
    return refused;
  }
}

/// Methods of other papers, which have such a scene in their own chapters.
constexpr std::array<std::string_view, 5> elsewhere = {"laier", "argyris", "hoff", "bazzi", "mtl"};

/// Outcomes of all other methods and peers of this build on all problems, ordered by method.
std::vector<Ending> all_endings(bool quick) {
  const std::vector<Stiff> problems = stiff_problems(quick);
  std::vector<Ending> endings;
  for (const std::string& name : comparison::any_method_names()) {
    const ivp::MethodInfo& method = comparison::any_method(name);
    if (!method.is_available() || std::ranges::find(elsewhere, name) != elsewhere.end()) continue;
    for (const Stiff& problem : problems) endings.push_back(ending_of(method, problem, quick));
  }
  return endings;
}

std::vector<std::string> different(const std::vector<Ending>& endings, std::string Ending::*member) {
  std::vector<std::string> names;
  for (const Ending& f : endings) {
    if (std::find(names.begin(), names.end(), f.*member) == names.end()) names.push_back(f.*member);
  }
  return names;
}

const Ending& find(const std::vector<Ending>& endings, const std::string& method,
                   const std::string& problem) {
  for (const Ending& f : endings) {
    if (f.method == method && f.problem == problem) return f;
  }
  throw std::logic_error(fmt::format("no run of {} on {}", method, problem));
}

/// Table cell of an outcome.
std::string words(const Ending& f) {
  if (f.usable && f.fixed_step) return fmt::format("{:.2g} s ({:.1f})", f.step, f.digits);
  if (f.outcome != Outcome::success) return std::string(to_string(f.outcome));
  if (f.fixed_step) return "no digit";
  return fmt::format("{:.1f} digits, {} steps", f.digits, f.steps);
}

/// Text of a cell in the figure, a few characters.
std::string mark(const Ending& f) {
  if (f.usable && f.fixed_step && f.stiffness >= 100) {  // 1e13 fills a cell
    const int power = static_cast<int>(std::floor(std::log10(f.stiffness)));
    return fmt::format("{:.0f}e{}", f.stiffness / std::pow(10, power), power);
  }
  if (f.usable && f.fixed_step) return scene::format_number(f.stiffness, 2);
  if (f.usable) return fmt::format("{:.1f}", f.digits);
  switch (f.outcome) {
    case Outcome::success: return "0";
    case Outcome::step_limit: return "…";
    case Outcome::newton_diverged:
    case Outcome::not_converged: return "×";
    case Outcome::non_finite: return "∞";
    case Outcome::step_underflow: return "↓";
    case Outcome::outside_validity: return "—";
    default: return "fails";
  }
}

scene::Table table_of(const std::vector<Ending>& endings) {
  std::vector<scene::Column> columns = {{"method"}};
  const auto problems = different(endings, &Ending::problem);
  for (const std::string& problem : problems) columns.push_back({problem});
  scene::Table table(columns);
  for (const std::string& method : different(endings, &Ending::method)) {
    std::vector<scene::Cell> row = {method};
    for (const std::string& problem : problems) row.push_back(words(find(endings, method, problem)));
    table.add(std::move(row));
  }
  return table;
}

void draw(const std::vector<Ending>& endings, scene::Show& show) {
  scene::Table data({{"panel"}, {"row"}, {"column"}, {"colour"}, {"mark"}, {"method"}, {"problem"}});
  const auto methods = different(endings, &Ending::method), problems = different(endings, &Ending::problem);
  int fixed_rows = 0, adaptive_rows = 0;
  for (const std::string& method : methods) {
    const bool fixed = find(endings, method, problems.front()).fixed_step;
    const int row = ++(fixed ? fixed_rows : adaptive_rows);
    for (int column = 0; const std::string& problem : problems) {
      const Ending& e = find(endings, method, problem);
      const double colour = fixed ? std::log10(e.stiffness) : e.digits;
      data.add({fixed ? "fixed" : "adaptive", row, ++column, e.usable ? scene::Cell(colour) : scene::Cell(),
                mark(e), method, problem});
    }
  }
  show.draw(std::move(data), "rbf_ivp-stability",
            {{"heading", "Stiff problems: only implicit methods with adaptive steps solve all"},
             {"rows_fixed", std::to_string(fixed_rows)},
             {"rows_adaptive", std::to_string(adaptive_rows)},
             {"height", "620"}});
}

void check(const std::vector<Ending>& endings, scene::Show& show) {
  const std::string stiff_chain = "three masses 1e8";
  const auto largest = [&](const std::string& method, double low, double high, const char* why) {
    show.between(fmt::format("largest step times frequency, {}, {}", method, stiff_chain),
                 find(endings, method, stiff_chain).stiffness, low, high, why);
  };
  constexpr double grid = 1.1892;  // a quarter of an octave
  largest("explicit", 2 / grid, 2, "stable for h omega <= 2; the grid of steps");
  largest("rk4", 2.8285 / grid, 2.8285, "stable for h omega <= sqrt(8); the grid of steps");
  for (const char* method : {"newmark", "hht", "generalized-alpha", "radau-coll"})
    largest(method, 100, 1e6, "unconditionally stable");
  double radau = 0, smooth = 0, least = 1e9;
  for (const std::string& problem : different(endings, &Ending::problem)) {
    least = std::min(least, find(endings, "adaptive-collocation", problem).digits);
    // No fixed step size of the search resolves the jump of van der Pol 1000, or the first second of
    // Robertson.
    if (problem == "van der Pol 1000" || problem == "Robertson") continue;
    ++smooth;
    radau += find(endings, "radau-coll", problem).usable ? 1 : 0;
  }
  show.between("problems but van der Pol 1000 and Robertson of which radau-coll finds a digit or more", radau,
               show.quick() ? smooth - 1 : smooth, smooth,
               "L-stable, order 11: all of them with a step short enough for the fast transitions; with "
               "--quick one less, because its search ends earlier");
  show.between("fewest digits of adaptive-collocation on a problem", least, 4, 16,
               "two digits less than the tolerance, as the codes of the test set's tables lose at most");
}

/// Checks the windows of omega h in which collocation, though implicit, amplifies an undamped oscillation.
void check_windows(scene::Show& show) {
  using collocation::NodeFamily;
  constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto, radau = NodeFamily::left_end_and_radau;
  constexpr double threshold = 1.001;  // of |R|; smaller excesses are truncation errors of radial functions
  const int per_unit = show.quick() ? 10 : 20;
  const char *recorded = "regression value with two or three digits",
             *formula = "|R| by the formula for the nodes (Hairer & Wanner II, Theorem IV.3.9), 50 digits";
  const auto windows = [&](NodeFamily family, int nodes, double shape) {
    const Eigen::VectorXd times = (collocation::nodes(family, nodes).array() + 1) / 2;
    return windows_above(collocation::StableGaussian(times, shape).differentiation_matrix(), 300, threshold,
                         per_unit);
  };
  const auto greatest = [](const std::vector<Window>& all) {
    return *std::ranges::max_element(all, {}, &Window::largest);
  };
  for (const int nodes : {7, 35}) {
    const std::vector<Window> polynomials = windows(lobatto, nodes, 0),
                              gaussians = windows(lobatto, nodes, nodes == 7 ? gaussian_shape : 8.5);
    const Window worst = greatest(polynomials);
    show.near(fmt::format("LGL N = {}, largest growth", nodes), worst.largest,
              polynomial_amplification(lobatto, nodes, worst.place), nodes == 7 ? 1e-9 : 1e-6, formula);
    show.near(fmt::format("RBF N = {}, largest growth", nodes), greatest(gaussians).largest,
              nodes == 7 ? 1.29 : 2.35, 0.005, recorded);
    show.at_most(fmt::format("Radau N = {}, windows", nodes), windows(radau, nodes, 0).size(), 0,
                 "L-stable: |R| < 1; rounding");
    if (nodes == 7)
      show.near("LGL N = 7, start of the window", polynomials.front().start, 5.4, 0.02, recorded);
    show.near(fmt::format("LGL N = {}, end of the windows", nodes), polynomials.back().end,
              nodes == 7 ? 9.5 : 192, 0.01, recorded);
    if (nodes == 35) show.near("RBF N = 35, end of the windows", gaussians.back().end, 75, 0.01, recorded);
  }
}

void put(const std::vector<Ending>& endings, scene::Show& show) {
  draw(endings, show);
  show.table(table_of(endings));
  check(endings, show);
  check_windows(show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result endings(
      "stiff-ends",
      "fixed steps: the largest of end/2^(k/4) that succeeds with a digit or more, as does its half (for "
      "rbf-coll c h = 0.367), down to end/2^17 for collocations, 2^23 for explicit formulas, 2^19 for others "
      "(none beyond 2^10 on Robertson, 2^18 on HIRES); others: tolerance 1e-6, 2^17 steps at most; 10 % "
      "error of the largest component (Robertson, HIRES: of any) is a digit",
      all_endings);
  return {{.name = "stability",
           .title = "Stiff problems: largest usable step, digits or failure of each method",
           .content = scene::Content(put, endings)}};
}

}  // namespace nlmech::chapters::rbf_ivp::stability
