#include "tests/adversary/commands/ivp_oracle.hpp"

namespace nlmech::adversary {

Question any_question(Draw& draw) {
  switch (draw.whole(0, 11)) {
    case 0: return question(draw, "duffing", 100);
    case 1: return question(draw, "impact", 100);
    case 2: return question(draw, "three-dof", 100);
    case 3: return question(draw, "van-der-pol", 20);
    case 4: return question(draw, "driven-duffing", 100);
    case 5: return question(draw, "two-dof", 100);
    case 6: return question(draw, "linear", 100);
    case 7: return question(draw, "lorenz", 30);
    case 8: return question(draw, "oscillator", 30);
    case 9: return question(draw, "projectile", 30, true);
    case 10: return question(draw, "bodies", 1000, true);
    default: return question(draw, "forced-duffing", 100);
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
