#include "chapters/rbf_inverse/commands/commands.hpp"

namespace nlmech::chapters::rbf_inverse {

void commands(CLI::App& app) {
  add_duffing_command(app);
  add_lambert_commands(app);
}

}  // namespace nlmech::chapters::rbf_inverse
