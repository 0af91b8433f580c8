#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::solvers {
namespace {

constexpr std::int64_t limit = 2500;  // steps, including rejected ones

/// A column of the table: elements per member, height, and the load, absolute or relative to the limit load.
struct Load {
  const char* label;
  int elements;
  double height, load, of_limit;
  double tolerance;  ///< on |F|, relative to W/2
};
constexpr std::array<Load, 8> loads = {{{"1 element, 43.79 lb", 1, 0.44, 43.79, 0, 1e-6},
                                        {"1 element, 44 lb", 1, 0.44, 44, 0, 1e-6},
                                        {"4 elements, 0.32 in, 27.11 lb", 4, 0.32, 27.11, 0, 1e-6},
                                        {"4 elements, 43.79 lb", 4, 0.44, 43.79, 0, 1e-6},
                                        {"4 elements, 44 lb", 4, 0.44, 44, 0, 1e-6},
                                        {"4 elements, W_L(1 - 1e-9)", 4, 0.44, 0, 1 - 1e-9, 1e-11},
                                        {"4 elements, W_L(1 + 1e-9)", 4, 0.44, 0, 1 + 1e-9, 1e-11},
                                        {"4 elements, 60 lb", 4, 0.44, 60, 0, 1e-6}}};
constexpr std::size_t below_fold = 5, above_fold = 6;

/// Outcome of a solver.
enum class End : std::uint8_t {
  equilibrium,     ///< success reported
  at_limit_point,  ///< failure within 0.02 in of the limit point, where |F| has a minimum
  elsewhere        ///< failure elsewhere
};

struct Trial {
  End end = End::elsewhere;
  Outcome outcome = Outcome::success;
  std::int64_t iterations = 0, evaluations = 0;
  double deflection = 0, residual = 0;  ///< inch; relative to W/2
};

struct Solvers {
  std::vector<std::string> names;
  std::vector<std::array<Trial, loads.size()>> trials;  ///< one row per solver
  double limit_load = 0, limit_deflection = 0;          ///< four elements per member, height 0.44 in
  double limit_of_one = 0;  ///< deflection at the limit point, one element per member

  [[nodiscard]] const Trial& of(std::string_view name, std::size_t load) const {
    const auto found = std::find(names.begin(), names.end(), name);
    return trials.at(static_cast<std::size_t>(found - names.begin())).at(load);
  }
  [[nodiscard]] int reached(std::size_t load) const {
    return static_cast<int>(std::count_if(trials.begin(), trials.end(),
                                          [load](const auto& t) { return t[load].end == End::equilibrium; }));
  }
};

Trial attempt(const std::string& name, const Load& column, double limit_load, double limit_deflection) {
  const frames::ToggleFrame toggle =
      make_frame(frames::Toggle{.height = column.height, .elements = column.elements});
  const double load = column.of_limit > 0 ? column.of_limit * limit_load : column.load, scale = load / 2;
  frames::Equilibrium equations(toggle.frame, toggle.load, load);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(equations.size()), f(x.size());
  const algebraic::Report report =
      name == "kinsol"
          ? find_root(peers::Kinsol{.tolerance = column.tolerance * scale, .iterations = limit}, equations, x)
          : find_root(algebraic::NamedSolver{name, column.tolerance, scale, limit}, equations, x);
  equations.residual(x, f);
  Trial t;
  t.outcome = report.status.outcome();
  t.iterations = report.statistics.steps + report.statistics.rejected;
  t.evaluations = report.statistics.right_hand_sides;
  t.deflection = -x[toggle.apex];
  t.residual = f.norm() / scale;
  if (report.status.ok()) {
    t.end = End::equilibrium;
  } else if (column.height == 0.44 && std::abs(t.deflection - limit_deflection) < 0.02) {
    t.end = End::at_limit_point;
  }
  return t;
}

Solvers compute() {
  Solvers s;
  const frames::Toggle one{.height = 0.44}, four{.height = 0.44, .elements = 4};
  const algebraic::PathPoint fold = first_limit_point(four);
  s.limit_load = fold.load;
  s.limit_deflection = -fold.x[make_frame(four).apex];
  s.limit_of_one = -first_limit_point(one).x[make_frame(one).apex];
  for (const std::string_view name : algebraic::solver_names()) {
    s.names.emplace_back(name);
    if (name == "damped-newton" && peers::kinsol_available()) s.names.emplace_back("kinsol");
  }
  for (const std::string& name : s.names) {
    auto& row = s.trials.emplace_back();
    for (std::size_t k = 0; k < loads.size(); ++k)
      row[k] = attempt(name, loads[k], s.limit_load, s.limit_deflection);
  }
  return s;
}

std::string words_of(const Trial& t) {
  std::string counts = fmt::format("{}/{}", t.iterations, t.evaluations);
  switch (t.end) {
    case End::equilibrium: return counts;
    case End::at_limit_point: return fmt::format("at the limit point, {} {}", to_string(t.outcome), counts);
    default: return fmt::format("{} {}", to_string(t.outcome), counts);
  }
}

void put_table(const Solvers& s, scene::Show& show) {
  std::vector<scene::Column> columns = {{"solver"}};
  for (const Load& load : loads) columns.push_back({load.label});
  scene::Table table(columns);
  for (std::size_t i = 0; i < s.names.size(); ++i) {
    std::vector<scene::Cell> cells = {s.names[i]};
    for (const Trial& t : s.trials[i]) cells.emplace_back(words_of(t));
    table.add(std::move(cells));
  }
  show.table(std::move(table));
}

void draw(const Solvers& s, scene::Show& show) {
  scene::Table data({{"solver"}, {"row"}, {"column"}, {"end"}, {"iterations"}});
  constexpr std::array ends = {"equilibrium", "at limit point", "elsewhere"};
  for (std::size_t i = 0; i < s.names.size(); ++i) {
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const Trial& t = s.trials[i][k];
      data.add({s.names[i], i + 1, k + 1, ends.at(static_cast<std::size_t>(t.end)), t.iterations});
    }
  }
  show.draw(std::move(data), "homotopy-solvers",
            {{"heading", "Iterations of each solver: energy descent and path following solve all loads"},
             {"solvers", std::to_string(s.names.size())},
             {"width", "900"},
             {"height", "700"}});
}

// oracle: homotopy_frames toggle 0.44 of 4 maximum, toggle 0.44 of 1 drop *, toggle 0.44 of 4 drop just
// above *
void check_numbers(const Solvers& s, scene::Show& show) {
  const char *recorded = "regression value with the same start and tolerance",
             *program = "tools/oracles/homotopy_frames.py, all its digits";
  double worst = 0;
  for (const auto& row : s.trials) {
    for (std::size_t k = 0; k < loads.size(); ++k) {
      if (row[k].end == End::equilibrium) worst = std::max(worst, row[k].residual / loads[k].tolerance);
    }
  }
  const auto count = [&](std::string_view name, std::size_t load) {
    const Trial& t = s.of(name, load);
    return t.end == End::equilibrium ? static_cast<double>(t.iterations) : HUGE_VAL;
  };
  const auto drop = [&](std::string_view name, std::size_t load) { return s.of(name, load).deflection; };
  show.near("limit load, four elements a member", {s.limit_load, "lb"}, 42.4387099966, 3e-12, program);
  show.at_most("greatest |F| of an equilibrium found, in tolerances", worst, 1,
               "evaluated once more at the end");
  show.equals("iterations of Newton, one element, 43.79 lb", count("newton", 0), 8, recorded);
  show.equals("iterations of Newton, four elements, 0.32 in, 27.11 lb", count("newton", 2), 7, recorded);
  show.between("iterations of Newton, W_L(1 - 1e-9)", count("newton", below_fold), 17, 19,
               "regression value 18; the error halves with every step, and may end a step off");
  show.between("iterations of the optimal iterative algorithm, one element, 43.79 lb",
               count("optimal-iterative", 0), 18, 40,
               "regression value 27; in one variable damped Newton by 0.95, chaotic at the fold");
  show.near("deflection under 43.79 lb, one element", {drop("energy-trust-region", 0), "in"}, 0.621922545486,
            1e-11, program);
  show.near("deflection under 44 lb, one element", {drop("energy-trust-region", 1), "in"}, 0.623070489, 1e-9,
            program);
  show.near("deflection under W_L(1 + 1e-9)", {drop("energy-trust-region", above_fold), "in"}, 0.614300816,
            1e-9, program);
  // |W - W_L|/W of one element; F is half the imbalance.
  show.near("least residual that Levenberg-Marquardt finds, one element, 43.79 lb",
            s.of("levenberg-marquardt", 0).residual, (43.79 - 42.435492120383) / 43.79, 1e-10,
            "relative distance of the load from the limit load: the minimum of |F| is at the limit point");
  show.at_most("distance of that place from the limit point",
               {std::abs(drop("levenberg-marquardt", 0) - s.limit_of_one), "in"}, 1e-5,
               "|F| is flat there: the root of 1e-15, times a hundred");
  show.at_most("the same for the dogleg", {std::abs(drop("dogleg", 0) - s.limit_of_one), "in"}, 1e-5,
               "as above");
}

void check_counts(const Solvers& s, scene::Show& show) {
  const auto solved = [&](const char* name, std::size_t load) {
    return s.of(name, load).end == End::equilibrium;
  };
  for (const char* name : {"energy-trust-region", "riks", "crisfield", "gdc", "chow-yorke"}) {
    int reached = 0;
    for (std::size_t k = 0; k < loads.size(); ++k) reached += solved(name, k) ? 1 : 0;
    show.equals(fmt::format("loads of {} solved by {}", loads.size(), name), reached, loads.size(),
                "neither the potential nor the path has an obstacle");
  }
  for (const auto& [load, label] : {std::pair{3U, "43.79 lb"}, {4U, "44 lb"}}) {
    int passed = 0;
    for (const char* name : {"fixed-point", "newton-homotopy", "scalar-homotopy", "steepest-descent",
                             "optimal-iterative", "vector-homotopy", "levenberg-marquardt", "dogleg"})
      passed += solved(name, load) ? 1 : 0;
    show.at_most(
        fmt::format("of eight methods without a path or an energy, how many solve four elements, {}", label),
        passed, 0, "regression value: scalar homotopies not in 2500 steps, the others stuck");
  }
  for (std::size_t k = 0; k < loads.size(); ++k)
    show.between(fmt::format("solvers that find an equilibrium, {}", loads[k].label), s.reached(k), 5,
                 k == above_fold ? 5 : static_cast<double>(s.names.size()),
                 k == above_fold
                     ? "the five above; all others stop at a minimum of |F| of 1e-9"
                     : "five follow a path or minimise the energy; results of the others depend on rounding");
}

void put(const Solvers& s, scene::Show& show) {
  draw(s, show);
  put_table(s, show);
  check_numbers(s, show);
  check_counts(s, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "solvers-on-loads",
      "half a toggle of one and four beam-columns a member from rest, under loads next to the limit load and "
      "past it, by every solver with its usual options, at most 2500 steps",
      compute);
  return {{.name = "solvers",
           .title = "Iterations of each solver on each load",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::homotopy::solvers
