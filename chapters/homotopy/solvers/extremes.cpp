#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/paths/path_solvers.hpp"
#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::extremes {
namespace {

using Eigen::VectorXd;
constexpr std::array<const char*, 8> solvers = {"newton",
                                                "damped-newton",
                                                "levenberg-marquardt",
                                                "newton-homotopy",
                                                "energy-trust-region",
                                                "riks",
                                                "crisfield",
                                                "gdc"};
constexpr std::size_t energy = 4, first_path = 5;
constexpr std::int64_t most = 300;  // steps

/// A difficult case: toggle, load and start.
struct Extreme {
  std::string label;
  frames::Toggle toggle;
  double load = 0;
  VectorXd start;
};

struct Trial {
  Outcome outcome = Outcome::success;
  double drop = 0;      ///< inch
  double residual = 0;  ///< |F| at the end, divided by its change from rounding x
  std::int64_t iterations = 0;
  Eigen::Index negative = 0;  ///< number of negative eigenvalues of the tangent
};

struct Extremes {
  std::vector<Extreme> cases;
  std::vector<std::array<Trial, solvers.size()>> trials;
  double limit_load = 0, limit_drop = 0;
};

/// Runs a solver. Energy minimisation and path following stop by their own criteria (increments at rounding
/// level); the other solvers stop by the residual.
algebraic::Report solved_by(const std::string& name, frames::Equilibrium& equations, VectorXd& x) {
  using Kind = algebraic::PathMethod::Kind;
  if (name == "energy-trust-region")
    return find_root(algebraic::EnergyTrustRegion{.iterations = static_cast<int>(most)}, equations, x);
  for (const auto& [path, kind] :
       {std::pair{"riks", Kind::riks}, {"crisfield", Kind::crisfield}, {"gdc", Kind::gdc}}) {
    if (name == path)
      return find_root(algebraic::ArcLength{.path = {.kind = kind}, .steps = most}, equations, x);
  }
  return find_root(
      algebraic::NamedSolver{
          .name = name, .tolerance = 1e-10, .scale = std::abs(equations.load()) / 2, .iterations = most},
      equations, x);
}

Trial attempt(const Extreme& e, const std::string& name) {
  const frames::ToggleFrame toggle = make_frame(e.toggle);
  frames::Equilibrium equations(toggle.frame, toggle.load, e.load);
  VectorXd x = e.start, f(x.size());
  const algebraic::Report report = solved_by(name, equations, x);
  Trial t;
  t.outcome = report.status.outcome();
  t.iterations = report.statistics.steps + report.statistics.rejected;
  t.drop = -x[toggle.apex];
  equations.residual(x, f);
  const double rounding =
      algebraic::rounding_of_residual(equations, x, f, [](const VectorXd& v) { return v.norm(); });
  t.residual = f.norm() / (rounding + std::numeric_limits<double>::epsilon() * std::abs(e.load));
  equations.linearise(x);
  algebraic::SymmetricSolver solver;
  solver.take_from(equations);
  if (solver.is_finite()) t.negative = solver.factorise().negative;
  return t;
}

/// Displacements under a load, found from rest by energy minimisation.
VectorXd shape(const frames::Toggle& toggle, double load) {
  const frames::ToggleFrame t = make_frame(toggle);
  frames::Equilibrium equations(t.frame, t.load, load);
  VectorXd x = VectorXd::Zero(t.frame.size());
  (void)find_root(algebraic::EnergyTrustRegion{}, equations, x);
  return x;
}

/// Toggle of one element per member whose height makes the largest compression along its path
/// (1 - 1e-6) 4 pi^2 EI/l^2.
frames::Toggle next_to_pole() {
  frames::Toggle toggle{.height = 0.5};
  const double wanted = -4 * std::acos(-1.) * std::acos(-1.) * (1 - 1e-6);
  const auto least = [&](double height) {
    toggle.height = height;
    const frames::ToggleFrame t = make_frame(toggle);
    double n = 0;
    for (int k = 80; k <= 120; ++k)
      n = std::min(n, t.frame.member<double>(VectorXd::Constant(1, -0.01 * k * height), 0).axial.n);
    return n;
  };
  double low = 0.5, high = 0.7;
  for (int k = 0; k < 50; ++k) {
    const double middle = (low + high) / 2;
    (least(middle) > wanted ? low : high) = middle;
  }
  toggle.height = low;
  return toggle;
}

Extremes compute(bool quick) {
  Extremes x;
  const frames::Toggle four{.height = 0.44, .elements = 4}, one{.height = 0.44};
  const auto add = [&](const std::string& label, const frames::Toggle& toggle, double load,
                       const VectorXd& start) {
    x.cases.push_back({label, toggle, load, start});
  };
  const auto rest = [](const frames::Toggle& toggle) -> VectorXd {
    return VectorXd::Zero(make_frame(toggle).frame.size());
  };
  const algebraic::PathPoint limit = first_limit_point(four);
  x.limit_load = limit.load;
  x.limit_drop = -limit.x[make_frame(four).apex];
  frames::Toggle stiff = four, past_pole = one, many = four;
  stiff.ea *= 1e6;
  past_pole.ea *= 1e3;
  many.elements = quick ? 200 : 1000;
  const frames::Toggle near_pole = next_to_pole();
  add("EA x 1e6, 44 lb", stiff, 44, rest(stiff));
  add("EA x 1e6, 1000 lb", stiff, 1000, rest(stiff));
  add("1 element, n to -39.478, 120 lb", near_pole, 120, rest(near_pole));
  add("EA x 1e3, 1 element past its buckling load", past_pole, 79.286, VectorXd::Constant(1, -0.2));
  add(fmt::format("{} elements, 44 lb", many.elements), many, 44, rest(many));
  add("the limit load", four, limit.load, rest(four));
  add("36 lb from the snapped shape", four, 36, shape(four, 100));
  add("36 lb from the limit point", four, 36, limit.x);
  add("-100 lb from the snapped shape", four, -100, shape(four, 100));
  for (const Extreme& e : x.cases) {
    auto& row = x.trials.emplace_back();
    for (std::size_t i = 0; i < solvers.size(); ++i) row[i] = attempt(e, solvers[i]);
  }
  return x;
}

std::string words_of(const Trial& t) {
  if (t.outcome != Outcome::success) return std::string(to_string(t.outcome));
  return fmt::format("{:.6g} in {}{}", t.drop, t.iterations, t.negative > 0 ? ", unstable" : "");
}

void put_table(const Extremes& x, scene::Show& show) {
  std::vector<scene::Column> columns = {{"case"}};
  for (const char* name : solvers) columns.push_back({name});
  scene::Table table(columns);
  for (std::size_t i = 0; i < x.cases.size(); ++i) {
    std::vector<scene::Cell> cells = {x.cases[i].label};
    for (const Trial& t : x.trials[i]) cells.emplace_back(words_of(t));
    table.add(std::move(cells));
  }
  show.table(std::move(table));
}

// Cases in the order of compute().
enum Row : std::uint8_t { stiff, buckled, at_pole, past_pole, many, at_limit, snapped, singular, back };

void check_counts(const Extremes& x, scene::Show& show) {
  const auto solved = [](const Trial& t) { return t.outcome == Outcome::success && t.residual <= 16; };
  int stable = 0, reached = 0, refused = 0;
  for (const auto& row : x.trials) {
    if (solved(row[energy]) && row[energy].negative == 0) ++stable;
    if (solved(row[first_path])) ++reached;
  }
  for (std::size_t k = first_path; k < solvers.size(); ++k)
    if (x.trials[past_pole][k].outcome == Outcome::wrong_branch) ++refused;
  const auto count = static_cast<double>(x.cases.size());
  show.equals("cases in which the energy trust region ends in a stable equilibrium to rounding", stable,
              count, "a potential that is bounded below has a minimum");
  show.equals("cases that riks solves to rounding", reached, count - 1,
              "all but the one whose start is on the straight branch of a buckled member, where its status "
              "is wrong_branch");
  show.equals("paths that report the straight branch of a buckled member", refused, 3,
              "one element without symmetric rotations, past its clamped buckling load");
}

void check_stiff(const Extremes& x, scene::Show& show) {
  const auto& trial = [&](Row row, std::size_t solver) -> const Trial& { return x.trials[row][solver]; };
  // oracle: homotopy_williams element 0.44 with 1000 EA*
  show.near("drop on that branch under 79.286 lb", {trial(past_pole, first_path).drop, "in"}, 0.2, 1e-5,
            "tools/oracles/homotopy_williams.py: 79.286 lb at 0.2 in");
  show.near("drop with EA x 1e6 under 44 lb", {trial(stiff, energy).drop, "in"},
            44 * 12.94 / (2 * 1.885e12 * 0.44 * 0.44 / (12.94 * 12.94)), 2e-6,
            "two bars, W l/(2 EA sin^2); bending carries 3e-7 of the load");
  show.between("negative eigenvalues where Newton ends, EA x 1e6, 1000 lb", trial(buckled, 0).negative, 1,
               HUGE_VAL,
               "Euler's clamped load is passed at 2 sin(beta) 4 pi^2 EI/l^2 = 149 lb: a straight member is "
               "unstable");
  show.near("drop with very many elements under 44 lb", {trial(many, energy).drop, "in"}, 0.623149373513,
            1e-8, "the exact elastica by shooting; 200 elements are 5e-9 away");
  show.equals("iterations of Newton there, by a residual of 1e-10", trial(many, 0).iterations, most,
              "the residual's rounding is a thousand times that");
}

void check_paths(const Extremes& x, scene::Show& show) {
  double from_limit = 0, from_energy = 0;
  for (std::size_t k = first_path; k < solvers.size(); ++k) {
    from_limit = std::max(from_limit, std::abs(x.trials[at_limit][k].drop - x.limit_drop));
    for (const Row row : {at_pole, many, snapped, back})
      from_energy = std::max(from_energy, std::abs(x.trials[row][k].drop / x.trials[row][energy].drop - 1));
  }
  show.at_most("largest distance from the limit point of riks, crisfield and gdc at the limit load",
               {from_limit, "in"}, 1e-6, "the root of a rounding");
  show.at_most("largest relative difference of paths from the energy's drop, four cases", from_energy, 1e-7,
               "the same equilibrium, to the rounding of 1000 elements");
  show.between("drop under 36 lb from the snapped shape, energy", {x.trials[snapped][energy].drop, "in"},
               0.4801, 0.6144, "between the lower limit point and the limit load, on the snapped branch");
  show.between("drop under 36 lb from the limit point, energy", {x.trials[singular][energy].drop, "in"}, 0,
               0.2272,
               "on the rising branch: there the energy falls from the limit point to the nearest minimum");
  const Trial& riks = x.trials[singular][first_path];
  // Both ways out of the limit point; rounding decides which. oracle: homotopy_elastica elastica 0.44 36 lb *
  constexpr double rising = 0.1277565, falling = 0.372627883;
  show.at_most("distance of the drop under 36 lb from the limit point, riks, from the nearer of two",
               {std::min(std::abs(riks.drop - rising), std::abs(riks.drop - falling)), "in"}, 1e-4,
               "tools/oracles/homotopy_elastica.py; four elements are 2e-6 away on the rising branch");
  show.equals("negative eigenvalues there", riks.negative, riks.drop > x.limit_drop ? 1 : 0,
              "a falling branch is unstable in one direction, a rising one in none");
}

void put(const Extremes& x, scene::Show& show) {
  put_table(x, show);
  check_counts(x, show);
  check_stiff(x, show);
  check_paths(x, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "extreme-toggles",
      "half a toggle 0.44 in high where members hardly shorten, with very many elements, at the limit load, "
      "and from "
      "starts that are snapped or singular; at most 300 steps, residual 1e-10 of half the load",
      compute);
  return {{.name = "extremes",
           .title = "Stiff members, many elements, the limit load itself, unfavourable starts",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::homotopy::extremes
