#include "chapters/rbf_inverse/lambert/porkchop_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_inverse/lambert/contour_labels.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

constexpr double ceiling = 4;  ///< upper end of the colour scale, relative to the least speed
constexpr double character = 0.034, height = 0.036;  ///< of a label, as fractions of the size of the maps

/// 1, 2, 2.5 or 5 times a power of ten, at least @p least.
double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1., 2., 2.5, 5.}) {
    if (digit * power >= least * (1 - 1e-9)) return digit * power;
  }
  return 10 * power;
}

/// Contour lines between the least speed and the ceiling.
/// @param count largest number of lines
std::vector<double> levels(double least, int count) {
  const double step = round_step((ceiling - 1) * least / count);
  std::vector<double> list;
  for (double k = std::ceil(least / step); k * step < ceiling * least; ++k) {
    if (k * step > least) list.push_back(k * step);
  }
  return list;
}

/// Labels of contour lines in the format of the template, place and text of each: "1253 1452 3 1270 1500 4".
std::string text(const std::vector<ContourLabel>& labels) {
  std::string list;
  for (const ContourLabel& label : labels)
    list += fmt::format("{}{:.6g} {:.6g} {:.12g}", list.empty() ? "" : " ", label.x, label.y, label.level);
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
  GridValues departing, arriving;
  const auto shown = [&](double speed, double least) {
    const double v = speed / axes.speed_unit;
    return v <= ceiling * least ? v : std::numeric_limits<double>::quiet_NaN();
  };
  for (std::size_t i = 0; i < grid.departures.size(); i += down) {
    departing.x.push_back(grid.departures[i] / axes.time);
    for (std::size_t j = 0; j < grid.arrivals.size(); j += across) {
      const orbit::PorkchopCell& cell = grid.at(i, j);
      const double y = grid.arrivals[j] / axes.time;
      departing.values.push_back(shown(cell.v_departure, least_departure));
      arriving.values.push_back(shown(cell.v_arrival, least_arrival));
      if (i == 0) departing.y.push_back(y);
      data.add({departing.x.back(), y, departing.values.back(), arriving.values.back()});
    }
  }
  arriving.x = departing.x;
  arriving.y = departing.y;
  std::map<std::string, std::string> variables = {
      {"heading", axes.heading}, {"xlabel", axes.departure}, {"ylabel", axes.arrival}, {"speed", axes.speed}};
  const auto map = [&](int k, double least, const GridValues& values) {
    std::vector<double> lines = levels(least, 12);
    std::vector<ContourLabel> labels = contour_labels(values, lines, character, height);
    if (2 * labels.size() < lines.size()) {  // too narrow to be read
      lines = levels(least, 6);
      labels = contour_labels(values, lines, character, height);
    }
    variables[fmt::format("least{}", k)] = fmt::format("{:.6g}", least);
    variables[fmt::format("most{}", k)] = fmt::format("{:.6g}", ceiling * least);
    variables[fmt::format("levels{}", k)] = fmt::format("{:.12g}", fmt::join(lines, ","));
    variables[fmt::format("labels{}", k)] = text(labels);
  };
  map(1, least_departure, departing);
  map(2, least_arrival, arriving);
  if (!axes.departure_tics.empty()) variables["xmarks"] = axes.departure_tics;
  if (!axes.arrival_tics.empty()) variables["ymarks"] = axes.arrival_tics;
  return {std::move(data), "rbf_inverse-porkchop", std::move(variables)};
}

}  // namespace nlmech::chapters::rbf_inverse
