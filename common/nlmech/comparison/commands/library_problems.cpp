#include "nlmech/comparison/commands/library_problems.hpp"

#include "nlmech/comparison/commands/own_problem_of.hpp"
#include "nlmech/problems/arenstorf.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/dead_end.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/duffing_chain.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/kepler.hpp"
#include "nlmech/problems/laier.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/pleiades.hpp"
#include "nlmech/problems/pollution.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/spring_pendulum.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::comparison {

OwnProblems library_problems() {
  return {&own_problem<problems::Duffing>,        &own_problem<problems::ImpactDuffing>,
          &own_problem<problems::ForcedDuffing>,  &own_problem<problems::DrivenDuffing>,
          &own_problem<problems::LaierDuffing>,   &own_problem<problems::VanDerPol>,
          &own_problem<problems::LaierVanDerPol>, &own_problem<problems::LinearOscillator>,
          &own_problem<problems::TwoDof>,         &own_problem<problems::ThreeMassChain>,
          &own_problem<problems::Lorenz>,         &own_problem<problems::StrongOscillator>,
          &own_problem<problems::Projectile>,     &own_problem<problems::FourBodies>,
          &own_problem<problems::BlowUp>,         &own_problem<problems::Robertson>,
          &own_problem<problems::Hires>,          &own_problem<problems::Kepler>,
          &own_problem<problems::Arenstorf>,      &own_problem<problems::Pleiades>,
          &own_problem<problems::DuffingChain>,   &own_problem<problems::SpringPendulum>,
          &own_problem<problems::Pollution>,      &own_problem<problems::DeadEnd>,
          &own_problem<problems::LostDomain>};
}

}  // namespace nlmech::comparison
