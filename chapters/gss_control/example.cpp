#include <cstdio>

// [example]
#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/response.hpp"

int main() {
  using namespace nlmech::spacecraft;
  Parameters craft = table_3_1();
  craft.tip_mass = 0.1;  // slug; the rest as in Table 3.1
  const double tip[] = {craft.length};
  const OptimalGains best = optimal_pd_gains(craft, {.deflection = 100, .torque = 1 / 144.});
  const TimeResponse turn = step_response(ClosedLoop(craft, best.gains), 0.5, tip);
  if (!turn.status.ok()) return 1;
  std::printf("k1 %.6f, k3 %.6f, cost %.6f\n", best.gains.k1, best.gains.k3, best.cost);
  std::printf("after 10 s: theta %.6f rad, tip %.6f ft\n", turn.theta.value(10),
              turn.deflection[0].value(10));
}
// [example]
