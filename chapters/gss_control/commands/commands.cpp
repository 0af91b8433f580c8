#include "chapters/gss_control/commands/commands.hpp"

namespace nlmech::chapters::gss_control {

void commands(scene::Commands& all) {
  add_frequency_commands(all);
  add_step_command(all);
  add_optimal_gains_command(all);
}

}  // namespace nlmech::chapters::gss_control
