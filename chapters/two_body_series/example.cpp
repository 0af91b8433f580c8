#include <algorithm>
#include <cstdio>

// [example]
#include "nlmech/orbit/continuation.hpp"

int main() {
  using namespace nlmech::orbit;
  // A day about the Earth with its zonal harmonics to J_6, in metres and seconds.
  const State start{{7.0e6, 0, 0}, {0, 4.7e3, 5.9e3}};
  double highest = 0;
  const auto watch = [&highest](const Step& step) {
    const State middle = step.at((step.t0 + step.t1) / 2);  // dense output: the series of the step
    highest = std::max(highest, middle.position.norm());
    return true;  // go on
  };
  const Solution end = propagate(start, 0, 86400, earth(6), AnalyticContinuation{}, watch);
  std::printf("%s: x = %.3f m, y = %.3f m, z = %.3f m, highest %.0f km\n", end.status.text().c_str(),
              end.x.position[0], end.x.position[1], end.x.position[2], highest / 1e3);
  return end.status.ok() ? 0 : 1;
}
// [example]
