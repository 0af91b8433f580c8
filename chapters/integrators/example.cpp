#include <cstdio>

// [example]
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/program/problem.hpp"

int main() {
  using namespace nlmech;
  // As a user types it; a mistake throws InputError, which points at its place.
  program::Equations equations(
      program::SourceText("pendulum", "a'' + (g/l) sin(a) = 0; g = 9.81; l = 2; a(0) = 1; a'(0) = 0"));
  const ivp::System pendulum{program::Problem(equations)};
  const std::vector<double> x0 = equations.initial_state("initial state", "");
  const auto end = ivp::integrate(pendulum, {x0[0], x0[1]}, 0, 10,
                                  ivp::Series{.relative_tolerance = 1e-14, .absolute_tolerance = 1e-14});
  std::printf("%s: a = %.12f, a' = %.12f\n", end.status.text().c_str(), end.x[0], end.x[1]);
  return end.status.ok() ? 0 : 1;
}
// [example]
