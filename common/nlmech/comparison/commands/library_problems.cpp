#include "nlmech/comparison/commands/library_problems.hpp"

#include <string>

#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/comparison/commands/typed_problem.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/duffing_chain.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/laier.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::comparison {

OwnProblems library_problems() {
  OwnProblems all = {&own_problem<problems::Duffing>,        &own_problem<problems::ImpactDuffing>,
                     &own_problem<problems::ForcedDuffing>,  &own_problem<problems::DrivenDuffing>,
                     &own_problem<problems::LaierDuffing>,   &own_problem<problems::VanDerPol>,
                     &own_problem<problems::LaierVanDerPol>, &own_problem<problems::LinearOscillator>,
                     &own_problem<problems::TwoDof>,         &own_problem<problems::ThreeMassChain>,
                     &own_problem<problems::Lorenz>,         &own_problem<problems::StrongOscillator>,
                     &own_problem<problems::Projectile>,     &own_problem<problems::FourBodies>,
                     &own_problem<problems::BlowUp>,         &own_problem<problems::Robertson>,
                     &own_problem<problems::Hires>,          &own_problem<problems::DuffingChain>};
  for (const problems::ProblemText& known : problems::problem_texts())
    all.emplace_back([&known] {
      return typed_problem({std::string(known.name) + ".ode", std::string(known.text)}, {}, known.name);
    });
  return all;
}

}  // namespace nlmech::comparison
