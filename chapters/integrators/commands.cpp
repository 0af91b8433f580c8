#include "nlmech/comparison/commands/ivp_commands.hpp"

namespace nlmech::chapters::integrators {

void commands(scene::Commands& all) { comparison::add_ivp_commands(all); }

}  // namespace nlmech::chapters::integrators
