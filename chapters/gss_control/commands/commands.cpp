#include "chapters/gss_control/commands/commands.hpp"

namespace nlmech::chapters::gss_control {

void commands(CLI::App& app) {
  add_poles_command(app);
  add_zeros_command(app);
  add_response_command(app);
  add_step_command(app);
  add_optimal_gains_command(app);
}

}  // namespace nlmech::chapters::gss_control
