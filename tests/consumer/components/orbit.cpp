// A quarter of a circle.
#include <cmath>
#include <numbers>

#include "nlmech/orbit/continuation.hpp"

int main() {
  using namespace nlmech::orbit;
  Gravity sun;
  sun.mu = 1;
  const auto end = propagate({{1, 0, 0}, {0, 1, 0}}, 0, std::numbers::pi / 2, sun, AnalyticContinuation{});
  return end.status.ok() && std::abs(end.x.position[1] - 1) + std::abs(end.x.velocity[0] + 1) < 1e-12 ? 0 : 1;
}
