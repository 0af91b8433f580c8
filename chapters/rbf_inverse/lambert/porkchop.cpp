#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/lambert/porkchop_map.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/transfer/porkchop.hpp"

namespace nlmech::chapters::rbf_inverse::porkchop {
namespace {

using orbit::Porkchop;
using orbit::PorkchopProblem;

constexpr double day = 86400, pi = std::numbers::pi;

/// Ephemeris from mean elements as commonly tabulated: degrees, longitudes of the body and of its periapsis.
orbit::Ephemeris planet(double mu, double axis, double e, double i, double longitude, double periapsis,
                        double node) {
  constexpr double degree = pi / 180;
  const double anomaly = (longitude - periapsis) * degree;  // mean anomaly
  double eccentric = anomaly;
  for (int k = 0; k < 60; ++k)
    eccentric -= (eccentric - e * std::sin(eccentric) - anomaly) / (1 - e * std::cos(eccentric));
  const double nu =
      2 * std::atan2(std::sqrt(1 + e) * std::sin(eccentric / 2), std::sqrt(1 - e) * std::cos(eccentric / 2));
  return {state_of(orbit::from_axis(axis, e, i * degree, node * degree, (periapsis - node) * degree, nu), mu),
          0};
}

/// Earth and Mars on Kepler orbits with their mean elements at J2000 (E. M. Standish and J. G. Williams);
/// times in seconds since J2000. The windows are those of summer 2003.
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

/// Tics with the days since J2000 (noon of 1 January 2000) and the date below.
std::string dated_tics(const std::vector<double>& times) {
  constexpr int every = 100;
  using std::chrono::days;
  std::string tics;
  for (int t = static_cast<int>(std::ceil(times.front() / day / every)) * every; t <= times.back() / day;
       t += every) {
    const std::chrono::year_month_day date{std::chrono::sys_days{std::chrono::year{2000} / 1 / 1} + days{t}};
    constexpr std::array months = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    tics += fmt::format("{}\"{}\\n{} {} {:02}\" {}", tics.empty() ? "" : ", ", t, unsigned(date.day()),
                        months[unsigned(date.month()) - 1], int(date.year()) % 100, t);
  }
  return tics;
}

/// Row of the table: the cell of least speed by a measure.
struct Row {
  const char* measure;
  double departure = 0, arrival = 0, value = HUGE_VAL;
  orbit::PorkchopCell cell = {};
};
template <class Measure>
Row cheapest(const Porkchop& grid, const char* name, const Measure& measure) {
  Row best{name};
  for (std::size_t i = 0; i < grid.departures.size(); ++i) {
    for (std::size_t j = 0; j < grid.arrivals.size(); ++j) {
      const orbit::PorkchopCell& cell = grid.at(i, j);
      if (cell.exists() && measure(cell) < best.value)
        best = {name, grid.departures[i], grid.arrivals[j], measure(cell), cell};
    }
  }
  return best;
}

/// Rows of least sum, least departure speed and least arrival speed.
std::vector<Row> put_minima(const Porkchop& grid, scene::Show& show) {
  using orbit::PorkchopCell;
  std::vector<Row> rows = {
      cheapest(grid, "sum of both", [](const PorkchopCell& c) { return c.v_departure + c.v_arrival; }),
      cheapest(grid, "speed at the departure", [](const PorkchopCell& c) { return c.v_departure; }),
      cheapest(grid, "speed at the arrival", [](const PorkchopCell& c) { return c.v_arrival; })};
  show.table(rows,
             {{"least", &Row::measure},
              {"departure (days since J2000)", [](const Row& r) { return r.departure / day; }, 5},
              {"arrival (days since J2000)", [](const Row& r) { return r.arrival / day; }, 5},
              {"speed at the departure (km/s)", [](const Row& r) { return r.cell.v_departure / 1e3; }, 5},
              {"speed at the arrival (km/s)", [](const Row& r) { return r.cell.v_arrival / 1e3; }, 5},
              {"revolutions", [](const Row& r) { return r.cell.revolutions; }},
              {"way", [](const Row& r) { return r.cell.long_way ? "long" : "short"; }}});
  return rows;
}

void put_earth_to_mars(const Porkchop& grid, scene::Show& show) {
  show.draw(
      porkchop_map(grid, {.heading = "Earth to Mars, 2003: excess speed (km/s) by departure and arrival",
                          .departure = "departure (days since J2000)",
                          .arrival = "arrival (days since J2000)",
                          .speed = "km/s",
                          .time = day,
                          .speed_unit = 1e3,
                          .departure_tics = dated_tics(grid.departures),
                          .arrival_tics = dated_tics(grid.arrivals)}));
  const std::vector<Row> least = put_minima(grid, show);
  const char* const program =
      "regression value: least by other code (universal variables of Bate, Mueller and White, bisection) "
      "over "
      "continuous times; a grid with steps of days is a little above";
  const auto check = [&](const std::string& name, const Row& row, double known) {
    show.between(name, {row.value / 1e3, "km/s"}, known / 1e3 * (1 - 1e-9), known / 1e3 * 1.002, program);
  };
  check("least sum of excess speeds", least[0], 5669.37334827);
  check("least excess speed at the departure", least[1], 2968.19185617);
  check("least excess speed at the arrival", least[2], 2697.71255038);
  show.between("departure of the least sum", {least[0].departure / day, "days"}, 1253.4 - 5, 1253.4 + 5,
               "regression value: 1253.4; flat, so that two steps of the grid are allowed");
  show.between("arrival of the least sum", {least[0].arrival / day, "days"}, 1457.1 - 8, 1457.1 + 8,
               "regression value: 1457.1; two steps");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result mars("porkchop-mars",
                           "conics of the mean elements at J2000; short and long way, no revolution",
                           [](bool quick) { return orbit::porkchop(earth_to_mars(quick)); });
  return {{.name = "porkchop",
           .title = "Earth to Mars: excess speeds by departure and arrival",
           .place = "our own, for the future work of chapter 5",
           .content = scene::Content(put_earth_to_mars, mars)}};
}

}  // namespace nlmech::chapters::rbf_inverse::porkchop
