#include "nlmech/comparison/commands/library_problems.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

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
namespace {

using Maker = OwnProblems::value_type;
template <class Problem>
constexpr std::pair<std::string_view, Maker> entry = {Problem::name, &own_problem<Problem>};

constexpr std::array all = {
    entry<problems::Duffing>,          entry<problems::ImpactDuffing>,  entry<problems::ForcedDuffing>,
    entry<problems::DrivenDuffing>,    entry<problems::VanDerPol>,      entry<problems::LinearOscillator>,
    entry<problems::TwoDof>,           entry<problems::ThreeMassChain>, entry<problems::Lorenz>,
    entry<problems::StrongOscillator>, entry<problems::Projectile>,     entry<problems::FourBodies>,
    entry<problems::BlowUp>,           entry<problems::Robertson>,      entry<problems::Hires>,
    entry<problems::Kepler>,           entry<problems::Arenstorf>,      entry<problems::Pleiades>,
    entry<problems::DuffingChain>,     entry<problems::SpringPendulum>, entry<problems::Pollution>,
    entry<problems::DeadEnd>,          entry<problems::LostDomain>};

}  // namespace

OwnProblems library_problems(const std::vector<std::string_view>& first) {
  OwnProblems list;
  for (const std::string_view name : first) {
    const auto place =
        std::find_if(all.begin(), all.end(), [name](const auto& e) { return e.first == name; });
    if (place == all.end()) throw std::logic_error("no problem " + std::string(name));
    list.push_back(place->second);
  }
  for (const auto& [name, make] : all) {
    if (std::find(first.begin(), first.end(), name) == first.end()) list.push_back(make);
  }
  return list;
}

}  // namespace nlmech::comparison
