// Lambert's problem: all arcs between two positions in a given time.
// [example]
#include <cstdio>

#include "nlmech/orbit/transfer/lambert.hpp"

int main() {
  using namespace nlmech::orbit;
  // About the Earth in 72 minutes, with at most one full revolution; metres and seconds.
  const LambertProblem problem{
      .from = {2.87e6, 5.19e6, 2.85e6}, .to = {2.09e6, 7.82e6, 0}, .time = 4320, .mu = 3.986004418e14};
  for (const auto& [arc, orbit] : lambert_arcs(problem, 1)) {
    std::printf("%s way, %d revolutions, %s: v = %.6f, %.6f, %.6f m/s\n", arc.long_way ? "long" : "short",
                arc.revolutions, arc.branch == LambertBranch::low ? "low" : "high", orbit.v1[0], orbit.v1[1],
                orbit.v1[2]);
  }
}
// [example]
