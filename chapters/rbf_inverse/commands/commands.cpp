#include "chapters/rbf_inverse/commands/commands.hpp"

namespace nlmech::chapters::rbf_inverse {

void commands(scene::Commands& all) {
  add_duffing_command(all);
  add_lambert_commands(all);
  add_bvp_command(all);
  add_control_command(all);
}

}  // namespace nlmech::chapters::rbf_inverse
