#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "chapters/transversal/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double compared = 200;  // how long errors are looked at

struct Regimes {
  std::vector<Point> cycle;           ///< of the periodic one, after the transients
  double period_error = 0;            ///< distance of two states three periods apart
  std::vector<Point> sections;        ///< of the chaotic one, once a period of the force
  std::vector<Point> periodic_error;  ///< |error| of p = 3, h = 0.02, in x[0]
  std::vector<Point> chaotic_error;   ///< the same
  double at_50 = 0;                   ///< the chaotic position at t = 50, p = 5, h = 0.002
};

std::vector<Point> error_curve(const problems::DrivenDuffing& problem, const ivp::State<2>& x0) {
  const Truth truth(problem, x0.cast<long double>(), 0, compared);
  std::vector<Point> curve;
  double greatest = 0, next = 1;
  for (const Point& p : course(problem, x0, compared, transversal(0.02, 3), nullptr).points) {
    greatest =
        std::max(greatest, (p.x - truth(std::min(p.t, compared)).cast<double>()).cwiseAbs().maxCoeff());
    if (p.t < next && p.t < compared) continue;
    curve.push_back({p.t, {greatest, 0}});  // of each unit of time
    greatest = 0;
    next += 1;
  }
  return curve;
}

Regimes regimes(bool quick) {
  Regimes r;
  const problems::DrivenDuffing periodic = stand_in(1);
  constexpr double settled = 60;
  const Course c = course(periodic, {0, 0}, settled + 4, transversal(0.02, 3), nullptr);
  for (const Point& p : c.points) {
    if (p.t >= settled - 1e-9) r.cycle.push_back({p.t - settled, p.x});
  }
  // Three periods are 150 steps, the fewest that are whole blocks.
  r.period_error = (r.cycle[150].x - r.cycle[0].x).cwiseAbs().maxCoeff();

  const double period = 2 * std::numbers::pi;
  const int count = quick ? 300 : 3000;
  // 150 steps a period: every 150th point is a section.
  const Course chaotic = course(ueda(), {3, 4}, count * period, transversal(period / 150, 3), nullptr);
  for (std::size_t i = std::size_t{150} * 20; i < chaotic.points.size(); i += 150)
    r.sections.push_back(chaotic.points[i]);
  r.periodic_error = error_curve(periodic, {0, 0});
  r.chaotic_error = error_curve(ueda(), {3, 4});
  r.at_50 = course(ueda(), {3, 4}, 50, transversal(0.002, 5), nullptr).points.back().x[0];
  return r;
}

/// Growth of an error by least squares of its logarithm, 1/time, between two times.
double growth_rate(const std::vector<Point>& curve, double from, double to) {
  double n = 0, st = 0, sy = 0, stt = 0, sty = 0;
  for (const Point& p : curve) {
    if (p.t < from || p.t > to) continue;
    const double y = std::log(p.x[0]);
    n += 1;
    st += p.t;
    sy += y;
    stt += p.t * p.t;
    sty += p.t * y;
  }
  return (n * sty - st * sy) / (n * stt - st * st);
}

scene::Showing show(const Regimes& r) {
  scene::Table data({{"series", 3, true}, {"x"}, {"v"}});
  for (const Point& p : r.cycle) data.add({std::int64_t{1}, p.x[0], p.x[1]});
  for (const Point& p : r.sections) data.add({std::int64_t{2}, p.x[0], p.x[1]});
  for (const Point& p : r.periodic_error) data.add({std::int64_t{3}, p.t, p.x[0]});
  for (const Point& p : r.chaotic_error) data.add({std::int64_t{4}, p.t, p.x[0]});
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "transversal-chaos",
                    {{"heading", "A periodic and a chaotic regime, and what errors do in them"},
                     {"height", "420"},
                     {"width", "1000"}}};
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Point& p : r.sections) {
    low = std::min(low, p.x[0]);
    high = std::max(high, p.x[0]);
  }
  showing.quantities = {
      scene::near("chaotic position at t = 50", "1", r.at_50, 1.221946638567542, 1e-7,
                  "70-digit Taylor solution; p = 5 with h = 0.002"),
      scene::at_most("distance of two states three periods apart", "1", r.period_error, 1e-9,
                     "60 periods damp the transient by exp(-60 pi/4), below all roundings"),
      {"growth of errors in the chaotic regime", "1/time", growth_rate(r.chaotic_error, 5, 100), 0.03, 0.25,
       "positive; Ueda's attractor has an exponent of 0.1, and a stretch of 45 units of time scatters about "
       "it"},
      {"growth of errors in the periodic regime", "1/time", growth_rate(r.periodic_error, 20, 200), -0.02,
       0.02, "a stable cycle: what each step adds is damped"},
      {"least position of a section", "1", low, 0.8, 2.2,
       "Ueda's picture of the attractor: x from about 1 to 4"},
      {"greatest position of a section", "1", high, 3.2, 4.2,
       "Ueda's picture of the attractor: x from about 1 to 4"}};
  return showing;
}

}  // namespace

void add_transversal_chaos(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Regimes>("regimes",
                                             "periodic: stand-in e1 = 0.25, e2 = 1, e3 = 0.5 from rest; "
                                             "chaotic: Ueda's oscillator from (3, 4), sections "
                                             "from the twentieth period on; p = 3",
                                             {}, [](Workshop& w) { return regimes(w.quick()); });
  chapter.add({.name = "chaos",
               .title = "A periodic and a chaotic regime by MTL, p = 3",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
