#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <memory>
#include <string>

#include "chapters/algebraic_series/sections.hpp"
#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/scene/program/command.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/typed.hpp"

namespace nlmech::comparison {

// In own_problems.cpp.
extern template std::unique_ptr<OwnProblem> own_problem<problems::Lorenz>();
extern template std::unique_ptr<OwnProblem> own_problem<problems::Projectile>();
extern template std::unique_ptr<OwnProblem> own_problem<problems::FourBodies>();

}  // namespace nlmech::comparison

namespace nlmech::chapters::algebraic_series {
namespace {

/// What was typed.
struct Words {
  std::string sections, initial, limit = scene::usual_limit;
  std::vector<std::string> set;
};

std::string section_rows(const Words& words) {
  double count = 0;
  if (!scene::parse_number(words.sections, count) || count != std::floor(count) || count < 1 || count > 1e7)
    throw InputError(
        fmt::format("--sections {}: must be a whole number from 1 to 10 million", words.sections));
  comparison::OwnProblemOf<problems::StrongOscillator> problem;
  comparison::apply_settings(problem, words.set);
  const std::vector<double> x0 = comparison::initial_state(problem, words.initial);
  const auto all =
      sections(problem.problem(), {x0[0], x0[1]}, problem.initial_time(), static_cast<std::int64_t>(count),
               {.seconds = scene::typed_positive("--limit", words.limit)});
  std::string text = "section,x,v\n";
  for (std::size_t k = 0; k < all.size(); ++k)
    fmt::format_to(std::back_inserter(text), "{},{:.17g},{:.17g}\n", k, all[k][0], all[k][1]);
  return text;
}

void add_poincare_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* command = app.add_subcommand(
      "poincare", "States of the oscillator every pi, from t = pi on, as CSV: section,x,v");
  command->add_option("--sections", words->sections, "how many, the first of them the initial state")
      ->required();
  command->add_option("--initial", words->initial, "initial state x,v; -0.5,0 without it");
  command->add_option("--set", words->set,
                      "name=value of stiffness or epsilon; more of them with blanks between");
  command->add_option("--limit", words->limit, "wall time in seconds, at most")->capture_default_str();
  command->callback([words] { scene::print_result(section_rows(*words)); });
}

}  // namespace

void commands(CLI::App& app) {
  using comparison::own_problem;
  const comparison::OwnProblems problems = {
      &own_problem<problems::Lorenz>, &own_problem<problems::ForcedDuffing>,
      &own_problem<problems::StrongOscillator>, &own_problem<problems::Projectile>,
      &own_problem<problems::FourBodies>};
  comparison::add_integrate_command(app, problems, {"series"});
  comparison::add_compare_command(app, problems, "algebraic_series");
  add_poincare_command(app);
}

}  // namespace nlmech::chapters::algebraic_series
