#include "tests/adversary/commands/ivp_oracle.hpp"

#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::adversary {

Question any_question(Draw& draw) {
  const std::string any = draw.one_of({"hermitian", "transversal"});  // both have these four problems
  switch (draw.whole(0, 13)) {
    case 0: return question<problems::Duffing>(draw, "rbf_ivp", "duffing", 100);
    case 1: return question<problems::ImpactDuffing>(draw, "rbf_ivp", "impact", 100);
    case 2: return question<problems::ThreeMassChain>(draw, "rbf_ivp", "three-dof", 100);
    case 3: return question<problems::VanDerPol>(draw, "rbf_ivp", "van-der-pol", 20);
    case 4: return question<problems::DrivenDuffing>(draw, any, "driven-duffing", 100);
    case 5: return question<problems::TwoDof>(draw, any, "two-dof", 100);
    case 6: return question<problems::LinearOscillator>(draw, any, "linear", 100);
    case 7: return question<problems::VanDerPol>(draw, any, "van-der-pol", 20);
    case 8: return question<problems::Lorenz>(draw, "algebraic_series", "lorenz", 30);
    case 9: return question<problems::StrongOscillator>(draw, "algebraic_series", "oscillator", 30);
    case 10: return question<problems::Projectile>(draw, "algebraic_series", "projectile", 30, true);
    case 11: return question<problems::FourBodies>(draw, "algebraic_series", "bodies", 1000, true);
    case 12: return question<problems::ThreeMassChain>(draw, "rbf_ivp", "three-dof", 20);
    default: return question<problems::ForcedDuffing>(draw, "algebraic_series", "forced-duffing", 100);
  }
}

std::string missing(std::initializer_list<const char*> programs) {
  for (const char* peer : oracles) {
    if (!peers::peer_available(peer)) return peers::absent_peer_sentence(peer);
  }
  for (const char* program : programs) {
    if (std::string what = missing_program(program); !what.empty()) return what;
  }
  return "";
}

}  // namespace nlmech::adversary
