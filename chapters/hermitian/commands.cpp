#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "chapters/hermitian/peaks.hpp"
#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/library_problems.hpp"
#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::chapters::hermitian {
namespace {

// The paper's own parameters and starts.
struct Duffing : problems::DrivenDuffing {
  static constexpr std::string_view name = "laier-duffing";
  Duffing() : DrivenDuffing(laier_duffing()) {}
  [[nodiscard]] static Vector<double, 2> initial_state() { return {0, 0}; }
};
struct VanDerPol : problems::VanDerPol {
  static constexpr std::string_view name = "laier-van-der-pol";
  VanDerPol() : problems::VanDerPol(laier_van_der_pol()) {}
  [[nodiscard]] static Vector<double, 2> initial_state() { return {0.01, 0}; }
};

/// What was typed.
struct Words {
  std::string problem, method;
  double step = 0;
};

void declare(scene::Options& options, Words& words) {
  options.add("--problem", words.problem, "from rest, or from 0.01")
      .one_of({"laier-duffing", "laier-van-der-pol"})
      .required();
  options.add("--method", words.method, "operators of")
      .one_of({"laier", "argyris", "newmark", "hoff", "bazzi"})
      .required();
  options.add("--step", words.step, "length of a step").positive().required();
}

std::string peak(const Words& words) {
  const Case what = words.problem == "laier-duffing" ? duffing_case() : van_der_pol_case();
  // The peaks lie at 2.45 and 4.60; a step beyond that sees none.
  const Peak found =
      first_peak(what, {.operators = ivp::hermitian_pair(words.method), .step = words.step}, 40);
  if (!found.status.ok()) throw Failure(found.status);
  return fmt::format("t,peak\n{:.17g},{:.17g}\n", found.t, found.x);
}

}  // namespace

void commands(scene::Commands& all) {
  comparison::OwnProblems problems =
      comparison::library_problems({"driven-duffing", "van-der-pol", "linear", "two-dof"});
  problems.insert(problems.begin(), {&comparison::own_problem<Duffing>, &comparison::own_problem<VanDerPol>});
  comparison::add_integrate_command(all, problems, "laier");
  comparison::add_compare_command(all, problems);
  all.add("peak", "The first peak of the paper's oscillators, as CSV: t,peak", declare, peak);
}

}  // namespace nlmech::chapters::hermitian
