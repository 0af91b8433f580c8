// The cheapest transfer of a grid of departures and arrivals.
// [example]
#include <cmath>
#include <cstdio>
#include <numbers>

#include "nlmech/orbit/transfer/porkchop.hpp"

int main() {
  using namespace nlmech::orbit;
  // Two planets on circles of radius 1 and 1.5; the inner one has the period 2 pi. They start at the same
  // angle.
  const double year = 2 * std::numbers::pi, outer = 1.5;
  const PorkchopProblem problem{.mu = 1,
                                .from = {.state = {{1, 0, 0}, {0, 1, 0}}},
                                .to = {.state = {{outer, 0, 0}, {0, 1 / std::sqrt(outer), 0}}},
                                .departures = {.first = 0, .last = 3 * year, .count = 300},
                                .arrivals = {.first = 0, .last = 4 * year, .count = 400}};
  const Porkchop grid = porkchop(problem);
  double least = INFINITY, departure = 0, arrival = 0;
  for (std::size_t i = 0; i < grid.departures.size(); ++i) {
    for (std::size_t j = 0; j < grid.arrivals.size(); ++j) {
      const PorkchopCell& cell = grid.at(i, j);
      if (!(cell.v_departure + cell.v_arrival < least)) continue;
      least = cell.v_departure + cell.v_arrival;
      departure = grid.departures[i];
      arrival = grid.arrivals[j];
    }
  }
  std::printf("%s: leave after %.3f years, arrive after %.3f, total speed change %.6f\n",
              grid.status.text().c_str(), departure / year, arrival / year, least);
}
// [example]
