#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "chapters/hermitian/peaks.hpp"
#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/scene/program/typed.hpp"

namespace nlmech::chapters::hermitian {
namespace {

// The paper's own parameters and starts.
struct Duffing : problems::DrivenDuffing {
  Duffing() : DrivenDuffing(laier_duffing()) {}
  [[nodiscard]] static Vector<double, 2> initial_state() { return {0, 0}; }
};
struct VanDerPol : problems::VanDerPol {
  VanDerPol() : problems::VanDerPol(laier_van_der_pol()) {}
  [[nodiscard]] static Vector<double, 2> initial_state() { return {0.01, 0}; }
};

/// What was typed.
struct Words {
  std::string problem, method, step;
};

std::string peak_rows(const Words& words) {
  const double step = scene::typed_positive("--step", words.step);
  const ivp::HermitianPair pair =
      comparison::about("--method", [&] { return ivp::hermitian_pair(words.method); });
  if (words.problem != "driven-duffing" && words.problem != "van-der-pol")
    throw InputError(fmt::format(
        "--problem {}: there is no such problem; there is driven-duffing, van-der-pol", words.problem));
  const Case what = words.problem == "driven-duffing" ? duffing_case() : van_der_pol_case();
  // The peaks lie at 2.45 and 4.60; a step beyond that sees none.
  const Peak peak = first_peak(what, {.operators = pair, .step = step}, 40);
  if (!peak.status.ok()) throw Failure(peak.status);
  return fmt::format("t,peak\n{:.17g},{:.17g}\n", peak.t, peak.x);
}

void add_peak_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* command = app.add_subcommand("peak", "The first peak of the paper's oscillators, as CSV: t,peak");
  command->add_option("--problem", words->problem, "driven-duffing (from rest) or van-der-pol (from 0.01)")
      ->required();
  command->add_option("--method", words->method, "laier, argyris, newmark, hoff or bazzi")->required();
  command->add_option("--step", words->step, "length of a step")->required();
  command->callback([words] { scene::print_result(peak_rows(*words)); });
}

}  // namespace

void commands(CLI::App& app) {
  using comparison::own_problem;
  const comparison::OwnProblems problems = {&own_problem<Duffing>, &own_problem<VanDerPol>,
                                            &own_problem<problems::LinearOscillator>,
                                            &own_problem<problems::TwoDof>};
  // The rows of the paper's Table 1.
  comparison::add_integrate_command(app, problems, {"laier", "argyris", "newmark", "hoff", "bazzi"});
  comparison::add_compare_command(app, problems, "hermitian");
  add_peak_command(app);
}

}  // namespace nlmech::chapters::hermitian
