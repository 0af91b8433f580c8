#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::transversal::chaos {
namespace {

constexpr double compared = 200;  // how long errors are looked at

/// The greatest error up to a time.
struct ErrorAt {
  double t, error;
};

struct Regimes {
  std::vector<Point> cycle;             ///< of the periodic one, after the transients
  double period_error = 0;              ///< distance of two states three periods apart
  std::vector<Point> sections;          ///< of the chaotic one, once a period of the force
  std::vector<ErrorAt> periodic_error;  ///< |error| of p = 3, h = 0.02,
  std::vector<ErrorAt> chaotic_error;   ///< the same
  double at_50 = 0;                     ///< the chaotic position at t = 50, p = 5, h = 0.002
};

std::vector<ErrorAt> error_curve(const problems::TextProblem& problem, const ivp::State& x0) {
  const Truth truth(problem, x0.cast<long double>(), 0, compared);
  std::vector<ErrorAt> curve;
  double greatest = 0, next = 1;
  for (const Point& p : course(problem, x0, compared, mtl(0.02, 3), nullptr).points) {
    greatest =
        std::max(greatest, (p.x - truth(std::min(p.t, compared)).cast<double>()).cwiseAbs().maxCoeff());
    if (p.t < next && p.t < compared) continue;
    curve.push_back({p.t, greatest});  // of each unit of time
    greatest = 0;
    next += 1;
  }
  return curve;
}

Regimes regimes(bool quick) {
  Regimes r;
  const problems::TextProblem periodic = stand_in(1);
  constexpr double settled = 60;
  const Course c = course(periodic, {0, 0}, settled + 4, mtl(0.02, 3), nullptr);
  for (const Point& p : c.points) {
    if (p.t >= settled - 1e-9) r.cycle.push_back({p.t - settled, p.x});
  }
  // Three periods are 150 steps, the fewest that are whole blocks.
  r.period_error = (r.cycle[150].x - r.cycle[0].x).cwiseAbs().maxCoeff();

  const double period = 2 * std::numbers::pi;
  const int count = quick ? 300 : 3000;
  // 150 steps a period: every 150th point is a section.
  const Course chaotic = course(ueda(), {3, 4}, count * period, mtl(period / 150, 3), nullptr);
  for (std::size_t i = std::size_t{150} * 20; i < chaotic.points.size(); i += 150)
    r.sections.push_back(chaotic.points[i]);
  r.periodic_error = error_curve(periodic, {0, 0});
  r.chaotic_error = error_curve(ueda(), {3, 4});
  r.at_50 = course(ueda(), {3, 4}, 50, mtl(0.002, 5), nullptr).points.back().x[0];
  return r;
}

/// Growth of an error by least squares of its logarithm, 1/time, between two times.
double growth_rate(const std::vector<ErrorAt>& curve, double from, double to) {
  double n = 0, st = 0, sy = 0, stt = 0, sty = 0;
  for (const ErrorAt& p : curve) {
    if (p.t < from || p.t > to) continue;
    const double y = std::log(p.error);
    n += 1;
    st += p.t;
    sy += y;
    stt += p.t * p.t;
    sty += p.t * y;
  }
  return (n * sty - st * sy) / (n * stt - st * st);
}

void draw(const Regimes& r, scene::Show& show) {
  scene::Plot& plot = show.plots("A periodic and a chaotic regime, and what errors do in them");
  plot.size(1000, 420).columns({"series", "x", "v"});
  plot.panel("{/:Italic x}", "{/:Italic v}")
      .caption("periodic: a cycle")
      .x_range(-1.2, 1.2)
      .set("xtics 0.5")
      .curve("", r.cycle, &Point::position, &Point::velocity);
  plot.panel("{/:Italic x}", "{/:Italic v}")
      .caption("chaotic: sections once a period")
      .x_range(1, 4)
      .y_range(-6, 8)
      .set("ytics 2")
      .curve("", r.sections, &Point::position, &Point::velocity, {"points pointtype 7 pointsize 0.14", 5});
  plot.panel("time", "greatest error in a unit of time")
      .caption("errors, {/:Italic p} = 3, {/:Italic h} = 0.02")
      .x_range(0, 200)
      .log_y(1e-8, 10)
      .key("at graph 0.98, graph 0.22 right samplen 2")
      .curve("periodic", r.periodic_error, &ErrorAt::t, &ErrorAt::error, scene::lines(1))
      .curve("chaotic", r.chaotic_error, &ErrorAt::t, &ErrorAt::error, scene::lines(5));
}

void put(const Regimes& r, scene::Show& show) {
  draw(r, show);
  const auto [low, high] = std::ranges::minmax(r.sections | std::views::transform(&Point::position));
  // oracle: algebraic_series_motions Duffing u(50)
  show.near("chaotic position at t = 50", r.at_50, 1.221946638567542, 1e-7,
            "tools/oracles/algebraic_series_motions.py; p = 5 with h = 0.002");
  show.at_most("distance of two states three periods apart", r.period_error, 1e-9,
               "60 periods damp the transient by exp(-60 pi/4), below all roundings");
  show.between("growth of errors in the chaotic regime", {growth_rate(r.chaotic_error, 5, 100), "1/time"},
               0.03, 0.25,
               "positive; Ueda's attractor has an exponent of 0.1, and a stretch of 45 units of time "
               "scatters about it");
  show.between("growth of errors in the periodic regime", {growth_rate(r.periodic_error, 20, 200), "1/time"},
               -0.02, 0.02, "a stable cycle: what each step adds is damped");
  const char* picture = "Ueda's picture of the attractor: x from about 1 to 4";
  show.between("least position of a section", low, 0.8, 2.2, picture);
  show.between("greatest position of a section", high, 3.2, 4.2, picture);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "regimes",
      "periodic: stand-in e1 = 0.25, e2 = 1, e3 = 0.5 from rest; chaotic: Ueda's oscillator "
      "from (3, 4), sections from the twentieth period on; p = 3",
      regimes);
  return {{.name = "chaos",
           .title = "A periodic and a chaotic regime by MTL, p = 3",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::transversal::chaos
