#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/drawing.hpp"
#include "chapters/two_body_series/orbits/orbits.hpp"
#include "chapters/two_body_series/orbits/published_runs.hpp"
#include "chapters/two_body_series/series/raw_recursion.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::two_body_series::algorithm {
namespace {

using Real = ExtendedReal<50>;

/// Largest relative error of the derivatives of both orbits computed by the flow chart (doubles, SI units),
/// against n! times the Taylor coefficients in 50 digits.
double error_of_derivatives(int order) {
  double greatest = 0;
  for (const Orbit& orbit : {low_orbit(), high_orbit()}) {
    // Not at the periapsis, where the odd derivatives of f vanish.
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

/// Smallest |r^(30)| in SI units at the printed points of the high orbit.
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

scene::Figure draw() {
  FlowChart chart;
  chart.box({23, 88}, {20, 8},
            {"{/:Bold given}", "r, r′ at {/:Italic t}_0; μ", "order {/:Italic K}, step {/:Italic h}"});
  chart.box({23, 62}, {20, 8}, {"{/:Bold start of a step}", "r^{(0)} = r,  r^{(1)} = r′,  {/:Italic n} = 0"});
  chart.box(
      {23, 17}, {20, 10},
      {"{/:Bold end of the step}", "r ← Σ r^{(k)} {/:Italic h^k}/{/:Italic k}!,  {/:Italic k} ≤ {/:Italic K}",
       "r′ ← Σ r^{(k+1)} {/:Italic h^k}/{/:Italic k}!,  {/:Italic k} < {/:Italic K}"});
  constexpr Spot right{24, 8};
  chart.box({73, 88}, right,
            {"{/:Bold f = r·r}  (3.62)",
             "{/:Italic f}^{(n)} = Σ C({/:Italic n}, {/:Italic m}) r^{(m)}·r^{(n−m)},  {/:Italic m} = 0, …, "
             "{/:Italic n}"});
  chart.box({73, 66}, right,
            {"{/:Bold g_p = f^{−p/2}, p = 3}  (3.66)",
             "{/:Italic g}_3^{(n)} = −[(3/2) {/:Italic f}^{(1)}{/:Italic g}_3^{(n−1)} + Σ C({/:Italic n}−1, "
             "{/:Italic m}) (",
             "(3/2) {/:Italic f}^{(m+1)}{/:Italic g}_3^{(n−1−m)} + {/:Italic f}^{(m)}{/:Italic g}_3^{(n−m)})]"
             "/{/:Italic f},  {/:Italic m} = 1, …, {/:Italic n}−1"});
  chart.box({73, 44}, right,
            {"{/:Bold r″ = −μ g_3 r}  (3.68)",
             "r^{(n+2)} = −μ Σ C({/:Italic n}, {/:Italic m}) r^{(m)}{/:Italic g}_3^{(n−m)}"});
  chart.decision({73, 17}, {18, 9}, {"{/:Italic n} + 2 = {/:Italic K}?"});
  chart.way({{23, 80}, {23, 70}});
  chart.way({{43, 62}, {45.5, 62}, {45.5, 88}, {49, 88}});
  for (const double y : {80.0, 58.0}) chart.way({{73, y}, {73, y - 6}});
  chart.way({{73, 36}, {73, 26}});
  chart.way({{91, 17}, {99.3, 17}, {99.3, 88}, {97, 88}});
  chart.way({{55, 17}, {43, 17}});
  chart.way({{23, 27}, {23, 54}});
  chart.note("yes", {49, 20});
  chart.note("no", {94.5, 20});
  chart.note("next step", {30.5, 40});
  chart.note("{/:Italic n} ← {/:Italic n} + 1", {92, 30});
  return chart.take("Analytic continuation: every derivative follows from the ones before");
}

void put(scene::Show& show) {
  show.draw(draw());
  const char* condition =
      "one rounding a product in sums of positive and negative terms: eps times the "
      "derivatives that the terms have without their signs";
  show.at_most("relative error of 10 derivatives as charted", error_of_derivatives(10), 1e-13, condition);
  show.at_most("relative error of 30 derivatives as charted", error_of_derivatives(30), 1e-10, condition);
  show.between(
      "least derivative of degree 30, SI units", {least_derivative(), "m/s^30"}, 1e-95, 1e-80,
      "30! r/rho^30 with rho about half a period at the apoapsis by hand, 1e-90; doubles end at 1e-308");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-3.21",
           .title = "The analytic continuation algorithm (drawn, with Eq. 3.66 corrected)",
           .place = "Figure 3.21",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::two_body_series::algorithm
