#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "chapters/homotopy/scenes.hpp"
#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/peers/algebraic/kinsol.hpp"
#include "nlmech/scene/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

/// What was typed.
struct Words {
  std::string height, load, solver = "energy-trust-region", model = "element", elements = "1";
  std::string tolerance = "1e-10";
};

/// The equations of the toggle that was asked for, half of it.
struct Loaded {
  std::unique_ptr<frames::ToggleFrame> toggle;
  std::unique_ptr<algebraic::Equations> equations;
  Eigen::Index apex = 0;
  double sign = 1;  ///< of the drop
};

Loaded loaded_toggle(const Words& words, double height, double load) {
  const int elements = scene::typed_whole("--elements", words.elements, 1, 10'000);
  Loaded all;
  try {
    if (words.model == "williams") {
      if (elements != 1)
        throw InputError(
            fmt::format("--elements {}: Williams' equation has none; use --model element", elements));
      static_cast<void>(frames::make_frame({.height = height}));  // refuses what is no toggle
      all.equations = std::make_unique<frames::WilliamsEquilibrium>(frames::Williams{.height = height}, load);
    } else if (words.model == "element") {
      all.toggle = std::make_unique<frames::ToggleFrame>(
          frames::make_frame(frames::Toggle{.height = height, .elements = elements}));
      all.equations = std::make_unique<frames::Equilibrium>(all.toggle->frame, all.toggle->load, load);
      all.apex = all.toggle->apex;
      all.sign = -1;
    } else {
      throw InputError(fmt::format("--model {}: there are element and williams", words.model));
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--height {} --load {}: {}", words.height, words.load, error.what()));
  }
  return all;
}

algebraic::Report run(const Words& words, double tolerance, double scale, algebraic::Equations& equations,
                      Eigen::VectorXd& x) {
  if (words.solver == "kinsol" && peers::kinsol_available())
    return peers::find_root(peers::Kinsol{.tolerance = tolerance * scale, .iterations = 10'000}, equations,
                            x);
  const auto names = algebraic::solver_names();
  if (std::find(names.begin(), names.end(), words.solver) == names.end())
    throw InputError(fmt::format("--solver {}: there are {}{}", words.solver, fmt::join(names, ", "),
                                 peers::kinsol_available() ? ", kinsol" : ""));
  return find_root(algebraic::NamedSolver{.name = words.solver, .tolerance = tolerance, .scale = scale},
                   equations, x);
}

void solve(const Words& words) {
  const double height = scene::typed_number("--height", words.height),
               load = scene::typed_number("--load", words.load);
  const double tolerance = scene::typed_number("--tolerance", words.tolerance);
  if (!(tolerance > 0 && tolerance < 1))
    throw InputError(fmt::format("--tolerance {}: must be above 0 and below 1", words.tolerance));
  const Loaded toggle = loaded_toggle(words, height, load);
  const double scale = load != 0 ? std::abs(load) / 2 : 1;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(toggle.equations->size()), f(x.size());
  const algebraic::Report report = run(words, tolerance, scale, *toggle.equations, x);
  toggle.equations->residual(x, f);
  // A drop of 0 has no sign.
  const double drop = x[toggle.apex] == 0 ? 0 : toggle.sign * x[toggle.apex];
  scene::print_result(fmt::format("status,deflection,residual,iterations\n{},{:.17g},{:.6g},{}\n",
                                  to_string(report.status.outcome()), drop, f.norm() / scale,
                                  report.statistics.steps + report.statistics.rejected));
  if (!report.status.ok()) throw Failure(report.status);
}

}  // namespace

void add_solve_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* const command = app.add_subcommand(
      "solve",
      "An equilibrium of a loaded toggle, from rest, as CSV: status,deflection,residual,iterations. Members, "
      "inch and pound as in Table 2.1; the residual is relative to half the load");
  command->add_option("--height", words->height, "of the apex over the bases, inch")->required();
  command->add_option("--load", words->load, "W on the apex, downwards, pound")->required();
  command->add_option("--solver", words->solver, "its name; an unknown one lists them")
      ->capture_default_str();
  command->add_option("--model", words->model, "element, or williams for Eq. 2.21")->capture_default_str();
  command->add_option("--elements", words->elements, "beam-columns a member")->capture_default_str();
  command
      ->add_option("--tolerance", words->tolerance,
                   "on the residual; the energy trust region and paths go to rounding without it")
      ->capture_default_str();
  command->callback([words] { solve(*words); });
}

}  // namespace nlmech::chapters
