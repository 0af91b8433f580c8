// A toggle without a load is at rest.
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"

int main() {
  using namespace nlmech::frames;
  const ToggleFrame toggle = make_frame(Toggle{.height = 0.44});
  Equilibrium equations(toggle.frame, toggle.load, 0);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(equations.size());
  Eigen::VectorXd forces(equations.size());
  equations.residual(rest, forces);
  return forces.norm() == 0 ? 0 : 1;
}
