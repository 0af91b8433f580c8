#include <memory>

#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::comparison {

// In own_problems.cpp.
extern template std::unique_ptr<OwnProblem> own_problem<problems::VanDerPol>();
extern template std::unique_ptr<OwnProblem> own_problem<problems::BlowUp>();
extern template std::unique_ptr<OwnProblem> own_problem<problems::Robertson>();
extern template std::unique_ptr<OwnProblem> own_problem<problems::Hires>();

}  // namespace nlmech::comparison

namespace nlmech::chapters::rbf_ivp {

void commands(scene::Commands& all) {
  using comparison::own_problem;
  const comparison::OwnProblems problems = {
      &own_problem<problems::Duffing>,        &own_problem<problems::ImpactDuffing>,
      &own_problem<problems::ThreeMassChain>, &own_problem<problems::VanDerPol>,
      &own_problem<problems::BlowUp>,         &own_problem<problems::Robertson>,
      &own_problem<problems::Hires>};
  comparison::add_integrate_command(all, problems);
  comparison::add_compare_command(all, problems);
}

}  // namespace nlmech::chapters::rbf_ivp
