#include "chapters/homotopy/commands/commands_typed.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/peers/algebraic/gsl_hybrid.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::homotopy {

using algebraic::TypedSolver;

void declare_roots(scene::Options& options, TypedRoots& typed) {
  options.add(
      "--equation", typed.equation,
      "equations, separated by ;: \"x^2 + y^2 = 4; exp(x) + y = r; r = 1\". name = number or expression "
      "is a definition, other names are unknowns. Or a definition of energy alone, for its stationary "
      "points: \"energy = x^4 - x y + y^2\"");
  options.add("--file", typed.file,
              "a file of equations, definitions, start values x(0) = 1 and bounds x >= 0");
  options.add("--set", typed.set, "name=value of a definition; separate several by blanks");
  options.add("--start", typed.start, "start values of the unknowns: \"x=1, y=-1\"");
  options.add("--bounds", typed.bounds, "bounds of the unknowns: \"x >= 0; y < 2\"");
  options
      .add("--tolerance", typed.tolerance,
           "largest error of a root, in units of the sizes of the unknowns at start and root; of a root of "
           "order m its m-th root")
      .range(1e-15, 0.1);
  options.add("--iterations", typed.iterations, "largest number of iterations of a solver")
      .range(1, 1'000'000);
}

algebraic::TypedSystem system_of(const TypedRoots& typed, std::set<std::string> unknowns,
                                 const std::string& parameter) {
  if (typed.equation.empty() == typed.file.empty())
    throw InputError("give one of --equation TEXT and --file NAME");
  program::SourceText source = typed.file.empty()
                                   ? program::SourceText("--equation", typed.equation)
                                   : program::SourceText(typed.file, comparison::read_equations(typed.file));
  unknowns.merge(algebraic::assigned_names("--start", typed.start));
  algebraic::TypedSystem system(std::move(source), {.settings = comparison::settings_of(typed.set),
                                                    .unknowns = std::move(unknowns),
                                                    .parameter = parameter});
  if (!typed.bounds.empty()) system.add_bounds("--bounds", typed.bounds);
  return system;
}

std::vector<TypedSolver> solvers_of(const algebraic::TypedSystem& system, const std::string& option,
                                    const std::vector<std::string>& names) {
  std::vector<TypedSolver> all = typed_solvers(system);
  // A solver of another library; its end is checked as those of this one.
  const auto add_peer = [&](const std::string& name, const auto& method_of) {
    all.push_back(
        {name,
         [=](double tolerance, std::int64_t iterations, algebraic::Equations& equations, Eigen::VectorXd& x) {
           algebraic::Report report =
               find_root(method_of(tolerance, iterations, equations.size()), equations, x);
           const algebraic::NamedSolver method{.name = name, .tolerance = tolerance, .to_rounding = true};
           return checked_against_tolerance(method, equations, x, std::move(report));
         }});
  };
  if (peers::kinsol_available())
    add_peer("kinsol", [](double tolerance, std::int64_t iterations, Eigen::Index n) {
      // KINSOL measures the largest component, nlmech the Euclidean norm.
      return peers::Kinsol{.tolerance = tolerance / std::sqrt(static_cast<double>(n)),
                           .iterations = iterations};
    });
  if (peers::gsl_hybrid_available())
    add_peer("gsl-hybrid", [](double tolerance, std::int64_t iterations, Eigen::Index) {
      return peers::GslHybrid{.tolerance = tolerance, .iterations = iterations};
    });
  std::vector<TypedSolver> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(all, name, &TypedSolver::name);
    if (found == all.end()) {
      std::vector<std::string> known;
      for (const TypedSolver& solver : all) known.push_back(solver.name);
      throw input_error("{} {}: no such solver{}; the solvers are {}", option, quoted_input(name),
                        name == "energy-trust-region" ? " for equations without an energy" : "",
                        fmt::join(known, ", "));
    }
    chosen.push_back(*found);
  }
  return names.empty() ? all : chosen;
}

std::set<std::string> names_in_box(const std::string& box) {
  std::set<std::string> names;
  if (box.empty()) return names;
  for (const auto& [name, range] : algebraic::read_ranges("--box", box)) names.insert(name);
  return names;
}

algebraic::Box box_of(const algebraic::TypedSystem& system, const std::string& box) {
  const algebraic::NamedRanges ranges = algebraic::read_ranges("--box", box);
  algebraic::Box all;
  for (const std::string& name : system.names()) {
    const auto range = ranges.find(name);
    if (range == ranges.end()) throw input_error("--box {}: {} needs a range", box, quoted_input(name));
    const auto [low, high] = std::minmax(range->second.first, range->second.second);
    all.emplace_back(low, high);
  }
  if (ranges.size() != all.size()) throw input_error("--box {}: has a name that is no unknown", box);
  return all;
}

std::string columns_of(const algebraic::TypedSystem& system) {
  std::string text;
  for (const std::string& name : system.names()) text.append(scene::csv_field(name)).append(",");
  return text;
}

}  // namespace nlmech::chapters::homotopy
