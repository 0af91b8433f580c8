#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/library_problems.hpp"

namespace nlmech::chapters::integrators {

void commands(scene::Commands& all) { comparison::add_ivp_commands(all, comparison::library_problems()); }

}  // namespace nlmech::chapters::integrators
