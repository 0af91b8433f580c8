#include <vector>

#include "chapters/algebraic_series/samples.hpp"
#include "chapters/algebraic_series/scenes.hpp"
#include "nlmech/ivp/events.hpp"
#include "nlmech/problems/projectile.hpp"

namespace nlmech::chapters {
namespace {

using problems::Projectile;
using scene::Workshop;
using State = ivp::State<6>;

struct Flight {
  std::vector<Sample<6>> path;  ///< up to the landing
  Sample<6> apex, landing;
  double x_without_wind = 0;  ///< at landing
};

/// Flies until z = 0 with the printed T = 0.01 and N = 20.
Flight fly(const Projectile& problem) {
  const ivp::System<6> system(problem);
  const State x0 = Projectile::initial_state();
  const std::vector<ivp::Event<6>> events = {
      {[](double, const State& x) { return x[2]; }, ivp::Crossing::falling, true},
      {[](double, const State& x) { return x[5]; }, ivp::Crossing::falling}};
  Flight flight;
  flight.path.push_back({0, x0});
  const auto observe = [&flight](const ivp::Step<6>& step) {
    flight.path.push_back({step.t1, step.x1});
    return true;
  };
  const auto [end, hits] =
      ivp::integrate_with_events(system, x0, 0, 100, published_series(0.01, 20), events, observe);
  if (!end.status.ok() || hits.size() != 2) throw Failure(end.status);
  flight.apex = {hits[0].t, hits[0].x};
  flight.landing = {end.t, end.x};
  flight.path.back() = flight.landing;
  return flight;
}

Flight fly_with_and_without_wind() {
  Flight flight = fly({});
  Projectile calm;
  calm.wind_x = calm.wind_y = 0;
  flight.x_without_wind = fly(calm).landing.x[0];
  return flight;
}

scene::Showing show(const Flight& flight) {
  scene::Table data({{"t_s"}, {"x_m"}, {"y_m"}, {"z_m"}});
  for (std::size_t i = 0; i < flight.path.size(); i += 5) {
    const auto& s = flight.path[i];
    data.add({s.t, s.x[0], s.x[1], s.x[2]});
  }
  const auto& last = flight.landing;
  data.add({last.t, last.x[0], last.x[1], last.x[2]});
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "algebraic_series-projectile",
                    {{"heading", "The printed wind carries the projectile sideways and ten times too far"}}};
  // oracle: algebraic_series_motions projectile *
  const char* known = "tools/oracles/algebraic_series_motions.py; rounding in a thousand steps";
  const double rounding = 1e-13;
  showing.quantities = {
      scene::near("time of landing", "s", last.t, 9.84601516944855, rounding, known),
      scene::near("x at landing", "m", last.x[0], 38476.6981780052, rounding, known),
      scene::near("y at landing", "m", last.x[1], 17355.9754745922, rounding, known),
      scene::near("greatest height", "m", flight.apex.x[2], 121.165897244319719, rounding, known),
      scene::near("time of the greatest height", "s", flight.apex.t, 4.88588698119259833, rounding, known),
      scene::near("x at landing without wind", "m", flight.x_without_wind, 3764.74722882073, rounding,
                  known)};
  return showing;
}

}  // namespace

void add_projectile(scene::Chapter& chapter) {
  const auto& flight = chapter.add_run<Flight>(
      "projectile",
      "Eq. 58 corrected; initial velocity (4, 0, 0.5) read as one a step T = 0.01 s, 400 and 50 m/s; T and N "
      "as printed",
      {}, [](Workshop&) { return fly_with_and_without_wind(); });
  chapter.add({.name = "fig-1",
               .title = "Path of a projectile under drag and a wind that grows with height",
               .place = "Figure 1",
               .needs = {&flight},
               .show = [&flight](Workshop& w) { return show(w.result(flight)); }});
}

}  // namespace nlmech::chapters
