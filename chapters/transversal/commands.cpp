#include "nlmech/comparison/commands/ivp_commands.hpp"
#include "nlmech/comparison/commands/library_problems.hpp"

namespace nlmech::chapters::transversal {

void commands(scene::Commands& all) {
  const auto problems = comparison::library_problems({"driven-duffing", "van-der-pol", "linear", "two-dof"});
  comparison::add_integrate_command(all, problems, "mtl");
  comparison::add_compare_command(all, problems);
}

}  // namespace nlmech::chapters::transversal
