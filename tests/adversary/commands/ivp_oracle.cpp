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
  switch (draw.whole(0, 11)) {
    case 0: return question<problems::Duffing>(draw, "duffing", 100);
    case 1: return question<problems::ImpactDuffing>(draw, "impact", 100);
    case 2: return question<problems::ThreeMassChain>(draw, "three-dof", 100);
    case 3: return question<problems::VanDerPol>(draw, "van-der-pol", 20);
    case 4: return question<problems::DrivenDuffing>(draw, "driven-duffing", 100);
    case 5: return question<problems::TwoDof>(draw, "two-dof", 100);
    case 6: return question<problems::LinearOscillator>(draw, "linear", 100);
    case 7: return question<problems::Lorenz>(draw, "lorenz", 30);
    case 8: return question<problems::StrongOscillator>(draw, "oscillator", 30);
    case 9: return question<problems::Projectile>(draw, "projectile", 30, true);
    case 10: return question<problems::FourBodies>(draw, "bodies", 1000, true);
    default: return question<problems::ForcedDuffing>(draw, "forced-duffing", 100);
  }
}

std::string any_method(Draw& draw, const Question& question, bool takes_step) {
  std::vector<std::string> fit;
  for (const std::string& name : comparison::built_method_names()) {
    const ivp::MethodInfo info = comparison::any_method(name);
    const bool takes = takes_step ? info.steps != ivp::Steps::chosen : !info.fixed_step();
    if (takes && (question.second_order || !info.second_order_only)) fit.push_back(name);
  }
  return draw.one_of(fit);
}

std::string missing_oracles() {
  for (const char* peer : oracles) {
    if (!peers::peer_info(peer).is_available()) return peers::peer_info(peer).absent_sentence();
  }
  return missing_program("integrators");
}

}  // namespace nlmech::adversary
