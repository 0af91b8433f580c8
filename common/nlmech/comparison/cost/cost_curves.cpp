#include "nlmech/comparison/cost/cost_curves.hpp"

#include <algorithm>
#include <utility>

#include "nlmech/peers/ivp/registry.hpp"

namespace nlmech::comparison {

scene::MethodLine line_of(std::string name, Kind kind) {
  const auto peers = peers::peer_methods();
  const bool peer = std::ranges::find(peers, name, &ivp::MethodInfo::name) != peers.end();
  return {std::move(name),
          static_cast<std::size_t>(kind),
          {},
          peer                        ? scene::Side::peer
          : kind == Kind::closed_form ? scene::Side::floor
          : kind <= Kind::series      ? scene::Side::subject
                                      : scene::Side::library};
}

scene::Attempt attempt_of(std::string setting, std::string status, std::optional<double> error,
                          const Statistics& work, const Timing& time) {
  return {
      std::move(setting), std::move(status), error, time, {work.right_hand_sides, work.steps, work.rejected}};
}

std::vector<scene::MethodGroup> method_groups(const std::string& own, const std::string& source) {
  // Closed form and polynomials share a colour: no figure has both.
  return {{source, 2},
          {own, 0},
          {"closed form", 7},
          {"Taylor series", 1},
          {"polynomials, Picard", 7},
          {"fixed step, others", 6},
          {"Runge-Kutta, step control", 3},
          {"extrapolation", 6},
          {"Adams", 5},
          {"implicit, step control", 4}};
}

}  // namespace nlmech::comparison
