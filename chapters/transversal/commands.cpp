#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::chapters::transversal {

void commands(scene::Commands& all) {
  using comparison::own_problem;
  const comparison::OwnProblems problems = {
      &own_problem<problems::DrivenDuffing>, &own_problem<problems::VanDerPol>,
      &own_problem<problems::LinearOscillator>, &own_problem<problems::TwoDof>};
  comparison::add_integrate_command(all, problems, {"mtl"});
  comparison::add_compare_command(all, problems);
}

}  // namespace nlmech::chapters::transversal
