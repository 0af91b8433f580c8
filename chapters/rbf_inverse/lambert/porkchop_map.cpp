#include "chapters/rbf_inverse/lambert/porkchop_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

constexpr double ceiling = 4;  ///< times the least speed: where the colours end

/// 1, 2, 2.5 or 5 times a power of ten, at least @p least.
double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1., 2., 2.5, 5.}) {
    if (digit * power >= least * (1 - 1e-9)) return digit * power;
  }
  return 10 * power;
}

/// Contour lines between the least speed and the ceiling: "3,4,5".
std::string levels(double least) {
  const double step = round_step((ceiling - 1) * least / 12);
  std::string list;
  for (double k = std::ceil(least / step); k * step < ceiling * least; ++k) {
    if (k * step <= least) continue;
    list += fmt::format("{}{:.12g}", list.empty() ? "" : ",", k * step);
  }
  return list;
}

}  // namespace

scene::Figure porkchop_map(const orbit::Porkchop& grid, const PorkchopAxes& axes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double least_departure = infinity, least_arrival = infinity;
  for (const orbit::PorkchopCell& cell : grid.cells) {
    if (!cell.exists()) continue;
    least_departure = std::min(least_departure, cell.v_departure / axes.speed_unit);
    least_arrival = std::min(least_arrival, cell.v_arrival / axes.speed_unit);
  }
  if (!(least_departure > 0 && least_departure < infinity && least_arrival > 0))
    throw Failure(
        "porkchop: no transfer of the grid has two positive excess speeds, so there is nothing to draw");
  if (grid.departures.size() < 2 || grid.arrivals.size() < 2)
    throw Failure(fmt::format("porkchop: a map needs two departures and two arrivals, not {} x {}",
                              grid.departures.size(), grid.arrivals.size()));
  scene::Table data({{"departure", 3, true}, {"arrival"}, {"v_departure"}, {"v_arrival"}});
  constexpr std::size_t most = 400;
  const std::size_t down = (grid.departures.size() - 1) / most + 1,
                    across = (grid.arrivals.size() - 1) / most + 1;
  const auto shown = [&](double speed, double least) {
    const double v = speed / axes.speed_unit;
    return v <= ceiling * least ? v : std::numeric_limits<double>::quiet_NaN();
  };
  for (std::size_t i = 0; i < grid.departures.size(); i += down) {
    for (std::size_t j = 0; j < grid.arrivals.size(); j += across) {
      const orbit::PorkchopCell& cell = grid.at(i, j);
      data.add({grid.departures[i] / axes.time, grid.arrivals[j] / axes.time,
                shown(cell.v_departure, least_departure), shown(cell.v_arrival, least_arrival)});
    }
  }
  std::map<std::string, std::string> variables = {
      {"heading", axes.heading}, {"xlabel", axes.departure}, {"ylabel", axes.arrival}, {"speed", axes.speed}};
  for (const auto& [k, least] : {std::pair{1, least_departure}, {2, least_arrival}}) {
    variables[fmt::format("least{}", k)] = fmt::format("{:.6g}", least);
    variables[fmt::format("most{}", k)] = fmt::format("{:.6g}", ceiling * least);
    variables[fmt::format("levels{}", k)] = levels(least);
  }
  return {std::move(data), "rbf_inverse-porkchop", std::move(variables)};
}

}  // namespace nlmech::chapters::rbf_inverse
