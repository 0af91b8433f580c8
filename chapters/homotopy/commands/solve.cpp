#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "chapters/homotopy/commands/commands.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/frames/toggle_path.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {
namespace {

/// What was typed.
struct Words {
  std::string height, load, solver = "energy-trust-region", model = "element";
  std::string elements;   ///< empty: elements_of()
  std::string tolerance;  ///< empty: 1e-10, or rounding where that is more
};

/// The equations of the toggle that was asked for, half of it.
struct Loaded {
  std::unique_ptr<frames::ToggleFrame> toggle;
  std::unique_ptr<algebraic::Equations> equations;
  Eigen::Index apex = 0;
  double sign = 1;  ///< of the drop
};

Loaded loaded_toggle(const Words& words, int elements, double height, double load) {
  Loaded all;
  try {
    if (words.model == "williams") {
      static_cast<void>(frames::make_frame({.height = height}));  // refuses what is no toggle
      all.equations = std::make_unique<frames::WilliamsEquilibrium>(frames::Williams{.height = height}, load);
    } else {
      all.toggle = std::make_unique<frames::ToggleFrame>(
          frames::make_frame(frames::Toggle{.height = height, .elements = elements}));
      all.equations = std::make_unique<frames::Equilibrium>(all.toggle->frame, all.toggle->load, load);
      all.apex = all.toggle->apex;
      all.sign = -1;
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--height {} --load {}: {}", words.height, words.load, error.what()));
  }
  return all;
}

algebraic::Report run(const algebraic::NamedSolver& method, algebraic::Equations& equations,
                      Eigen::VectorXd& x) {
  if (method.name == "kinsol" && peers::kinsol_available()) {
    constexpr Eigen::Index most = 3000;  // its matrices are dense
    if (equations.size() > most)
      throw InputError(
          fmt::format("--solver kinsol: its matrix is dense, and {} unknowns are too many (at most {}); "
                      "take fewer elements or another solver",
                      equations.size(), most));
    // Its measure is the greatest component, ours the length.
    const double components = std::sqrt(static_cast<double>(equations.size()));
    const peers::Kinsol kinsol{.tolerance = method.tolerance * method.scale / components,
                               .iterations = method.iterations};
    return held_to_tolerance(method, equations, x, peers::find_root(kinsol, equations, x));
  }
  const auto names = algebraic::solver_names();
  if (std::find(names.begin(), names.end(), method.name) == names.end())
    throw InputError(fmt::format("--solver {}: there are {}{}", method.name, fmt::join(names, ", "),
                                 peers::kinsol_available() ? ", kinsol" : ""));
  return find_root(method, equations, x);
}

/// What there is to know of the equilibrium besides that it is one.
struct Standing {
  std::optional<Eigen::Index> unstable;  ///< motions of the whole toggle; nothing if not known
  frames::TogglePath from_rest;          ///< up to the load or the first critical point
};

Standing standing_of(const Loaded& toggle, double height, double load, int elements,
                     const Eigen::VectorXd& x) {
  constexpr int enough = 64;  // elements a member: loads are right to 1e-6
  if (!toggle.toggle) {
    const frames::Williams williams{.height = height};
    return {unstable_motions(williams, x[0]), first_critical_point(williams, load)};
  }
  const frames::Toggle own{.height = height, .elements = elements};
  return {
      unstable_motions(own, x),
      first_critical_point(frames::Toggle{.height = height, .elements = std::min(elements, enough)}, load)};
}

std::string stability_of(const Standing& s) {
  if (!s.unstable) return "unknown";
  return *s.unstable == 0 ? "stable" : "unstable";
}

/// Says on standard error how the shape found stands to the path from rest.
void tell(const Standing& s, double height, double drop) {
  if (!s.from_rest.status.ok()) {
    std::cerr << fmt::format("solve: whether the path from rest leads here is not known: {}\n",
                             s.from_rest.status.text());
  } else if (!s.from_rest.events.empty()) {
    const frames::ToggleEvent& e = s.from_rest.events[0];
    std::cerr << fmt::format(
        "solve: before this load the path from rest meets {}{} at {:.7g} lb and a drop of {:.6g} in, where "
        "it "
        "loses its stability; the shape found lies beyond and is {}\n",
        e.kind == algebraic::CriticalPoint::Kind::bifurcation
            ? (e.is_symmetric ? "a symmetric " : "an antisymmetric ")
            : "a ",
        to_string(e.kind), e.load, e.drop, stability_of(s));
  } else if (!(std::abs(s.from_rest.drop - drop) <= 1e-3 * height)) {
    std::cerr << fmt::format(
        "solve: another equilibrium than the one on the path from rest, which carries this load at a drop of "
        "{:.6g} in; this one is {}\n",
        s.from_rest.drop, stability_of(s));
  }
}

void solve(const Words& words) {
  const double height = scene::typed_number("--height", words.height),
               load = scene::typed_number("--load", words.load);
  const bool is_given = !words.tolerance.empty();
  const double tolerance = is_given ? scene::typed_number("--tolerance", words.tolerance) : 1e-10;
  if (!(tolerance > 0 && tolerance < 1))
    throw InputError(fmt::format("--tolerance {}: must be above 0 and below 1", words.tolerance));
  const int elements = elements_of(words.elements, words.model);
  const Loaded toggle = loaded_toggle(words, elements, height, load);
  const double scale = load != 0 ? std::abs(load) / 2 : 1;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(toggle.equations->size());
  const algebraic::Report report =
      run({.name = words.solver, .tolerance = tolerance, .scale = scale, .to_rounding = !is_given},
          *toggle.equations, x);
  if (!report.status.ok()) throw Failure(report.status);
  // A drop of 0 has no sign.
  const double drop = x[toggle.apex] == 0 ? 0 : toggle.sign * x[toggle.apex];
  const Standing standing = standing_of(toggle, height, load, elements, x);
  const auto& events = standing.from_rest.events;
  scene::print_result(
      fmt::format("status,deflection,residual,iterations,bound,stability,critical_load\n{},{:.17g},{:.6g},{},"
                  "{:.6g},{},{}\n",
                  to_string(report.status.outcome()), drop, report.last / scale,
                  report.statistics.steps + report.statistics.rejected, report.bound / scale,
                  stability_of(standing), events.empty() ? "" : fmt::format("{:.12g}", events[0].load)));
  tell(standing, height, drop);
}

}  // namespace

void add_solve_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* const command = app.add_subcommand(
      "solve",
      "An equilibrium of half a loaded toggle, from rest, as CSV: "
      "status,deflection,residual,iterations,bound,stability,critical_load. Members, inch and pound as in "
      "Table "
      "2.1. residual: |F| there, relative to half the load, at most the bound; stability: of the whole "
      "toggle, "
      "antisymmetric motions included; critical_load: the limit point or bifurcation that the path from rest "
      "meets before this load, empty if none. Ends with 1 and says why if there is no such equilibrium to "
      "show");
  command->add_option("--height", words->height, "of the apex over the bases, inch")->required();
  command->add_option("--load", words->load, "W on the apex, downwards, pound")->required();
  command->add_option("--solver", words->solver, "its name; an unknown one lists them")
      ->capture_default_str();
  command->add_option("--model", words->model, "element, or williams for Eq. 2.21")->capture_default_str();
  command->add_option("--elements", words->elements,
                      "beam-columns a member, 4 if not given; one does not bow");
  command->add_option(
      "--tolerance", words->tolerance,
      "on the residual; if not given 1e-10, or where that is more, as with very many elements, 4 "
      "times what rounding of the displacements makes of it (the bound that is printed)");
  command->callback([words] { solve(*words); });
}

}  // namespace nlmech::chapters::homotopy
