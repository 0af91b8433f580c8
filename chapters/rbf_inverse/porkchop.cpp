#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "chapters/rbf_inverse/porkchop_map.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/porkchop.hpp"

namespace nlmech::chapters {
namespace {

using orbit::Porkchop;
using orbit::PorkchopProblem;
using scene::Workshop;

constexpr double day = 86400, hour = 3600, pi = std::numbers::pi;

/// A body from mean elements as ephemerides print them: degrees, longitudes of the body and of its periapsis.
orbit::Ephemeris planet(double mu, double axis, double e, double i, double longitude, double periapsis,
                        double node) {
  constexpr double degree = pi / 180;
  const double anomaly = (longitude - periapsis) * degree;  // mean
  double eccentric = anomaly;
  for (int k = 0; k < 60; ++k)
    eccentric -= (eccentric - e * std::sin(eccentric) - anomaly) / (1 - e * std::cos(eccentric));
  const double nu =
      2 * std::atan2(std::sqrt(1 + e) * std::sin(eccentric / 2), std::sqrt(1 - e) * std::cos(eccentric / 2));
  return {state_of(orbit::from_axis(axis, e, i * degree, node * degree, (periapsis - node) * degree, nu), mu),
          0};
}

/// Earth and Mars on the conics of their mean elements at J2000, as E. M. Standish and J. G. Williams print
/// them; times in seconds since then. The windows are those of summer 2003.
PorkchopProblem earth_to_mars(bool quick) {
  constexpr double mu = 1.32712440018e20, au = 1.495978707e11;
  PorkchopProblem p;
  p.mu = mu;
  p.from = planet(mu, 1.00000261 * au, 0.01671123, -0.00001531, 100.46457166, 102.93768193, 0);
  p.to = planet(mu, 1.52371034 * au, 0.09339410, 1.84969142, -4.55343205, -23.94362959, 49.55953891);
  const int count = quick ? 51 : 201;
  p.departures = {1150 * day, 1400 * day, count};
  p.arrivals = {1350 * day, 1750 * day, count};
  return p;
}

constexpr double earth_mu = 3.986004418e14, low = 6678137, high = 42164137;

/// From a circle 300 km above the Equator to the geostationary one. The goal is over the point that is
/// opposite to the low satellite's place at 1.5 h when Hohmann's half ellipse from there ends.
PorkchopProblem low_to_geostationary(bool quick) {
  PorkchopProblem p;
  p.mu = earth_mu;
  const double v1 = std::sqrt(earth_mu / low), v2 = std::sqrt(earth_mu / high);
  const double half = pi * std::sqrt(std::pow((low + high) / 2, 3) / earth_mu), leave = 1.5 * hour;
  p.from = {{{low, 0, 0}, {0, v1, 0}}, leave};
  p.to = {{{-high, 0, 0}, {0, -v2, 0}}, leave + half};
  p.most_revolutions = 2;
  const int count = quick ? 61 : 241;
  p.departures = {0, 6 * hour, count};
  p.arrivals = {3 * hour, 15 * hour, count};
  return p;
}

/// The cheapest cell by a measure.
struct Cheapest {
  std::size_t i = 0, j = 0;
  double value = std::numeric_limits<double>::infinity();
};
template <class Measure>
Cheapest cheapest(const Porkchop& grid, const Measure& measure) {
  Cheapest best;
  for (std::size_t i = 0; i < grid.departures.size(); ++i) {
    for (std::size_t j = 0; j < grid.arrivals.size(); ++j) {
      const orbit::PorkchopCell& cell = grid.at(i, j);
      if (cell.exists() && measure(cell) < best.value) best = {i, j, measure(cell)};
    }
  }
  return best;
}

double sum_of(const orbit::PorkchopCell& c) { return c.v_departure + c.v_arrival; }

/// Least sum, least departure, least arrival, a row each.
scene::Table minima(const Porkchop& grid, const std::string& unit, double time) {
  scene::Table table({{"least"},
                      {fmt::format("departure ({})", unit), 5},
                      {fmt::format("arrival ({})", unit), 5},
                      {"speed at the departure (km/s)", 5},
                      {"speed at the arrival (km/s)", 5},
                      {"revolutions"},
                      {"way"}});
  const auto add = [&](const char* name, const Cheapest& at) {
    const orbit::PorkchopCell& c = grid.at(at.i, at.j);
    table.add({std::string(name), grid.departures[at.i] / time, grid.arrivals[at.j] / time,
               c.v_departure / 1e3, c.v_arrival / 1e3, std::int64_t(c.revolutions),
               std::string(c.long_way ? "long" : "short")});
  };
  add("sum of both", cheapest(grid, sum_of));
  add("speed at the departure", cheapest(grid, [](const auto& c) { return c.v_departure; }));
  add("speed at the arrival", cheapest(grid, [](const auto& c) { return c.v_arrival; }));
  return table;
}

/// Between the least value of continuous times and that of the nearest cells, a promise.
scene::Quantity least(const std::string& name, double value, double known, double coarse,
                      const std::string& reason) {
  return {name, "km/s", value / 1e3, known / 1e3 * (1 - 1e-9), known / 1e3 * (1 + coarse), reason};
}

scene::Showing show_earth_to_mars(const scene::Run<Porkchop>& run, Workshop& w) {
  const Porkchop& grid = w.result(run);
  scene::Showing showing;
  showing.figure =
      porkchop_map(grid, {.heading = "Earth to Mars, summer of 2003: km/s by departure and arrival",
                          .departure = "departure (days since J2000)",
                          .arrival = "arrival (days since J2000)",
                          .speed = "km/s",
                          .time = day,
                          .speed_unit = 1e3});
  showing.table = minima(grid, "days since J2000", day);
  const Cheapest best = cheapest(grid, sum_of);
  const std::string program =
      "recorded: least by other code (universal variables of Bate, Mueller and White, bisection) over "
      "continuous times; a grid with steps of days is a little above";
  showing.quantities = {
      least("least sum of excess speeds", best.value, 5669.37334827, 2e-3, program),
      least("least excess speed at the departure",
            cheapest(grid, [](const auto& c) { return c.v_departure; }).value, 2968.19185617, 2e-3, program),
      least("least excess speed at the arrival",
            cheapest(grid, [](const auto& c) { return c.v_arrival; }).value, 2697.71255038, 2e-3, program),
      {"departure of the least sum", "days", grid.departures[best.i] / day, 1253.4 - 5, 1253.4 + 5,
       "recorded: 1253.4; flat, so that two steps of the grid are allowed"},
      {"arrival of the least sum", "days", grid.arrivals[best.j] / day, 1457.1 - 8, 1457.1 + 8,
       "recorded: 1457.1; two steps"}};
  return showing;
}

scene::Showing show_low_to_geostationary(const scene::Run<Porkchop>& run, Workshop& w) {
  const Porkchop& grid = w.result(run);
  scene::Showing showing;
  showing.figure = porkchop_map(grid, {.heading = "Low orbit to the geostationary one: windows every 1.6 h",
                                       .departure = "departure (h)",
                                       .arrival = "arrival (h)",
                                       .speed = "km/s",
                                       .time = hour,
                                       .speed_unit = 1e3});
  showing.table = minima(grid, "h", hour);
  const double sum = low + high, v1 = std::sqrt(earth_mu / low), v2 = std::sqrt(earth_mu / high);
  const double hohmann = v1 * (std::sqrt(2 * high / sum) - 1) + v2 * (1 - std::sqrt(2 * low / sum));
  int around = 0;
  for (const orbit::PorkchopCell& cell : grid.cells) around += cell.revolutions > 0;
  showing.quantities = {
      least("least sum of excess speeds", cheapest(grid, sum_of).value, hohmann, 5e-3,
            "Hohmann's half ellipse, the least of all transfers between these circles; the grid misses its "
            "arrival by "
            "part of a step"),
      {"share of the cells where a revolution more is cheaper", "1",
       double(around) / double(grid.cells.size()), 1e-3, 0.5,
       "there are such, since the transfer ellipse takes 10.5 h; but direct ones are cheaper mostly"}};
  return showing;
}

}  // namespace

void add_porkchop(scene::Chapter& chapter) {
  const auto& mars = chapter.add_run<Porkchop>(
      "porkchop-mars", "conics of the mean elements at J2000; short and long way, no revolution", {},
      [](Workshop& w) { return orbit::porkchop(earth_to_mars(w.quick())); });
  const auto& geostationary = chapter.add_run<Porkchop>(
      "porkchop-geostationary", "circles of 6678.137 km and 42164.137 km in one plane; up to two revolutions",
      {}, [](Workshop& w) { return orbit::porkchop(low_to_geostationary(w.quick())); });
  chapter.add({.name = "porkchop",
               .title = "Earth to Mars: excess speeds by departure and arrival",
               .place = "our own",
               .needs = {&mars},
               .show = [&mars](Workshop& w) { return show_earth_to_mars(mars, w); }});
  chapter.add(
      {.name = "porkchop-geostationary",
       .title = "Low orbit to the geostationary one: excess speeds by departure and arrival",
       .place = "our own",
       .needs = {&geostationary},
       .show = [&geostationary](Workshop& w) { return show_low_to_geostationary(geostationary, w); }});
}

}  // namespace nlmech::chapters
