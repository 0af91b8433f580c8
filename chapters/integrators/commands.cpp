#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/library_problems.hpp"

namespace nlmech::chapters::integrators {

void commands(scene::Commands& all) {
  const auto problems = comparison::library_problems();
  comparison::add_integrate_command(all, problems);
  comparison::add_compare_command(all, problems);
  comparison::add_choose_command(all, problems);
  comparison::add_merge_command(all);
}

}  // namespace nlmech::chapters::integrators
