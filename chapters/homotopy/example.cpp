#include <cstdio>

// [example]
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle.hpp"

int main() {
  using namespace nlmech;
  // Half the toggle of 0.44 in, a member as one element; inch and pound.
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = 0.44});

  // Where does it come to rest under a load above its limit?
  frames::Equilibrium equations(toggle.frame, toggle.load, 43.79);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(equations.size());
  const algebraic::Report report = find_root(algebraic::EnergyTrustRegion{}, equations, x);
  std::printf("%s: deflection %.7f in\n", report.status.text().c_str(), -x[toggle.apex]);

  // And where is the limit? Along the path from rest, where the load stops growing.
  frames::LoadedFrame loaded(toggle.frame, toggle.load);
  algebraic::Path path({.first = 5}, loaded, Eigen::VectorXd::Zero(loaded.size()), 0);
  Status status = path.start();
  while (status.ok() && !path.has_passed_fold()) status = path.advance();
  algebraic::PathPoint limit;
  if (!report.status.ok() || !status.ok() || path.fold(limit) != Outcome::success) return 1;
  std::printf("limit load %.6f lb at %.6f in\n", limit.load, -limit.x[toggle.apex]);
}
// [example]
