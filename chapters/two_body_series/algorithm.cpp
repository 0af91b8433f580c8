#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "chapters/two_body_series/raw_recursion.hpp"
#include "chapters/two_body_series/scenes.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kepler.hpp"

namespace nlmech::chapters {
namespace {

/// Boxes and arrows on a page of 100 by 100.
class FlowChart {
 public:
  void box(double x, double y, double half_width, double half_height) {
    table_.add({"box", x, y, half_width, half_height});
  }
  void diamond(double x, double y, double half_width, double half_height) {
    const double px[] = {x - half_width, x, x + half_width, x, x - half_width};
    const double py[] = {y, y + half_height, y, y - half_height, y};
    for (int i = 0; i < 4; ++i) table_.add({"line", px[i], py[i], px[i + 1] - px[i], py[i + 1] - py[i]});
  }
  /// A path with an arrow's head at its end.
  void arrow(const std::vector<std::pair<double, double>>& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const auto [x, y] = path[i];
      const auto [to_x, to_y] = path[i + 1];
      table_.add({i + 2 == path.size() ? "arrow" : "line", x, y, to_x - x, to_y - y});
    }
  }
  scene::Table take() { return std::move(table_); }

 private:
  scene::Table table_{{{"kind"}, {"x"}, {"y"}, {"dx"}, {"dy"}}};
};

using Real = boost::multiprecision::cpp_bin_float_50;

/// Derivatives of both orbits as the chart computes them, in doubles and SI units, against Taylor
/// coefficients in 50 digits times n!: greatest relative error.
double error_of_derivatives(int order) {
  double greatest = 0;
  for (const Orbit& orbit : {low_orbit(), high_orbit()}) {
    // Off the periapsis, where every other derivative of f vanishes.
    const orbit::State s = orbit::propagate_kepler(orbit.start, 500, earth_mu).state;
    const auto raw = raw_derivatives<double>(s, earth_mu, order);
    orbit::BasicGravity<Real> field;
    field.mu = earth_mu;
    orbit::Expansion<Real> series(field, order);
    series.expand({s.position.cast<Real>(), s.velocity.cast<Real>()}, order);
    Real factorial = 1;
    for (int n = 1; n <= order; ++n) {
      factorial *= n;
      const orbit::Vector3<Real> exact = factorial * series.coefficient(n),
                                 d = raw[static_cast<std::size_t>(n)].cast<Real>() - exact;
      greatest = std::max(greatest, static_cast<double>(Real(sqrt(d.dot(d) / exact.dot(exact)))));
    }
  }
  return greatest;
}

/// Least |r^(30)| in SI units at the printed points of a high orbit.
double least_derivative() {
  const Orbit orbit = high_orbit();
  double least = HUGE_VAL;
  for (int k = 0; k < orbit.steps; ++k) {
    const orbit::State s =
        orbit::propagate_kepler(orbit.start, k * period_of(orbit) / orbit.steps, earth_mu).state;
    least = std::min(least, raw_derivatives<double>(s, earth_mu, 30).back().norm());
  }
  return least;
}

scene::Showing draw() {
  FlowChart chart;
  chart.box(23, 88, 20, 8);                                           // given
  chart.box(23, 62, 20, 8);                                           // begin of a step
  for (const double y : {88.0, 66.0, 44.0}) chart.box(73, y, 24, 8);  // f, g, r
  chart.diamond(73, 17, 18, 9);                                       // enough?
  chart.box(23, 17, 20, 10);                                          // Taylor's formula
  chart.arrow({{23, 80}, {23, 70}});
  chart.arrow({{43, 62}, {45.5, 62}, {45.5, 88}, {49, 88}});
  for (const double y : {80.0, 58.0}) chart.arrow({{73, y}, {73, y - 6}});
  chart.arrow({{73, 36}, {73, 26}});
  chart.arrow({{91, 17}, {99.3, 17}, {99.3, 88}, {97, 88}});
  chart.arrow({{55, 17}, {43, 17}});
  chart.arrow({{23, 27}, {23, 54}});
  const char* condition =
      "one rounding a product in sums of positive and negative terms: eps times the "
      "derivatives that the terms have without their signs";
  return {
      scene::Figure{chart.take(), "two_body_series-algorithm", {}},
      {},
      {scene::at_most("relative error of 10 derivatives as charted", "1", error_of_derivatives(10), 1e-13,
                      condition),
       scene::at_most("relative error of 30 derivatives as charted", "1", error_of_derivatives(30), 1e-10,
                      condition),
       {"least derivative of degree 30, SI units", "m/s^30", least_derivative(), 1e-95, 1e-80,
        "30! r/rho^30 with rho about half a period at the apoapsis by hand, 1e-90; doubles end at 1e-308"}}};
}

}  // namespace

void add_algorithm(scene::Chapter& chapter) {
  chapter.add({.name = "fig-3.21",
               .title = "The analytic continuation algorithm (drawn, with Eq. 3.66 corrected)",
               .place = "Figure 3.21",
               .needs = {},
               .seconds = 0.1,
               .show = [](scene::Workshop&) { return draw(); }});
}

}  // namespace nlmech::chapters
