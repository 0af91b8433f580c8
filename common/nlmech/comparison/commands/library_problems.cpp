#include "nlmech/comparison/commands/library_problems.hpp"

#include <string>

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

Problems library_problems() {
  Problems all = {&user_problem<problems::Duffing>,        &user_problem<problems::ImpactDuffing>,
                  &user_problem<problems::ForcedDuffing>,  &user_problem<problems::DrivenDuffing>,
                  &user_problem<problems::LaierDuffing>,   &user_problem<problems::VanDerPol>,
                  &user_problem<problems::LaierVanDerPol>, &user_problem<problems::LinearOscillator>,
                  &user_problem<problems::TwoDof>,         &user_problem<problems::ThreeMassChain>,
                  &user_problem<problems::Lorenz>,         &user_problem<problems::StrongOscillator>,
                  &user_problem<problems::Projectile>,     &user_problem<problems::FourBodies>,
                  &user_problem<problems::BlowUp>,         &user_problem<problems::Robertson>,
                  &user_problem<problems::Hires>,          &user_problem<problems::DuffingChain>};
  for (const problems::ProblemText& known : problems::problem_texts())
    all.emplace_back([&known](const program::Settings& settings) {
      return typed_problem({std::string(known.name) + ".ode", std::string(known.text)}, settings, known.name);
    });
  return all;
}

}  // namespace nlmech::comparison
