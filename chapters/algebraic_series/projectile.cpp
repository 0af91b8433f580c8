#include <string>
#include <vector>

#include "chapters/algebraic_series/samples.hpp"
#include "nlmech/ivp/events.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::projectile {
namespace {

using State = ivp::State;

struct Trajectory {
  std::vector<Sample> path;  ///< states at the ends of steps up to landing
  Sample apex, landing;
  double x_without_wind = 0;  ///< x at landing without wind
};

/// Integrates until z = 0 with the printed T = 0.01 and N = 20.
Trajectory trajectory_of(const problems::TextProblem& problem) {
  const ivp::System system(problem);
  const State& x0 = problem.initial_state();
  const std::vector<ivp::Event> events = {
      {[](double, const State& x) { return x[2]; }, ivp::Crossing::falling, true},
      {[](double, const State& x) { return x[5]; }, ivp::Crossing::falling}};
  Trajectory trajectory;
  trajectory.path.push_back({0, x0});
  const auto observe = [&trajectory](const ivp::Step& step) {
    trajectory.path.push_back({step.t1, step.x1});
    return true;
  };
  const auto [end, hits, open] =
      ivp::integrate_with_events(system, x0, 0, 100, published_series(0.01, 20), events, observe);
  if (!end.status.ok() || hits.size() != 2) throw Failure(end.status);
  trajectory.apex = {hits[0].t, hits[0].x};
  trajectory.landing = {end.t, end.x};
  trajectory.path.back() = trajectory.landing;
  return trajectory;
}

Trajectory trajectory_with_and_without_wind() {
  Trajectory trajectory = trajectory_of(problems::TextProblem("projectile"));
  const problems::TextProblem calm("projectile", {{"wind_x", 0}, {"wind_y", 0}});
  trajectory.x_without_wind = trajectory_of(calm).landing.x[0];
  return trajectory;
}

void draw(const Trajectory& trajectory, scene::Show& show) {
  std::vector<Sample> fifths;
  for (std::size_t i = 0; i < trajectory.path.size(); i += 5) fifths.push_back(trajectory.path[i]);
  fifths.push_back(trajectory.landing);
  scene::Plot& plot =
      show.plots("Projectile path: the printed wind makes the range ten times longer").stacked({3, 4});
  plot.data(scene::table_of(
      fifths, {{"t_s", &Sample::t}, {"x_m", Component{0}}, {"y_m", Component{1}}, {"z_m", Component{2}}}));
  plot.panel("", "height {/:Italic z} (m)")
      .x_range(0, 40)
      .y_range(0, 160)
      .set("ytics 40")
      .columns("", "(column('x_m')/1000):z_m", scene::lines(1));
  const std::string ground = "(column('x_m')/1000):(column('y_m')/1000)";
  plot.panel("{/:Italic x} (km)", "{/:Italic y} (km)")
      .x_range(0, 40)
      .set("ytics 5")
      .columns("", ground, {"lines dashtype solid", 2})
      .columns("", "(column('x_m')/1000):(int(column('t_s')*20 + 0.5) % 20 == 0 ? column('y_m')/1000 : NaN)",
               scene::points(2))
      .also("data using " + ground +
            ":(sprintf('%.0f s', column('t_s'))) every 40::80 with labels right offset -0.6,0.6 notitle");
}

void put(const Trajectory& trajectory, scene::Show& show) {
  draw(trajectory, show);
  // oracle: algebraic_series_motions projectile *
  const auto check = [&](const char* name, const scene::Amount& value, double known) {
    show.near(name, value, known, 1e-13,
              "tools/oracles/algebraic_series_motions.py; rounding in a thousand steps");
  };
  check("time of landing", {trajectory.landing.t, "s"}, 9.84601516944855);
  check("x at landing", {trajectory.landing.x[0], "m"}, 38476.6981780052);
  check("y at landing", {trajectory.landing.x[1], "m"}, 17355.9754745922);
  check("greatest height", {trajectory.apex.x[2], "m"}, 121.165897244319719);
  check("time of the greatest height", {trajectory.apex.t, "s"}, 4.88588698119259833);
  check("x at landing without wind", {trajectory.x_without_wind, "m"}, 3764.74722882073);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result trajectory(
      "projectile",
      "Eq. 58 corrected; initial velocity (4, 0, 0.5) read as one a step T = 0.01 s, 400 and 50 m/s; T and N "
      "as printed",
      trajectory_with_and_without_wind);
  return {{.name = "fig-1",
           .title = "Path of a projectile under drag and a wind that grows with height",
           .place = "Figure 1",
           .content = scene::Content(put, trajectory)}};
}

}  // namespace nlmech::chapters::algebraic_series::projectile
