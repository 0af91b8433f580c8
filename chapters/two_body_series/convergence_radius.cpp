#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/two_body_series/ellipses.hpp"
#include "chapters/two_body_series/orbits.hpp"
#include "chapters/two_body_series/scenes.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/expansion.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// Radii along an ellipse, in mean anomaly.
struct Radii {
  double eccentricity = 0;
  std::vector<double> anomaly, radius, closed, by_coefficients;
};

/// From the decay of the coefficients of orders 40 to 100: near r = 0 the motion is a multiple of
/// (t - t_0)^(2/3), whose coefficients fall like k^(-5/3) rho^(-k). Slope by least squares, which averages
/// over the beat of the pair of singularities.
double radius_by_coefficients(orbit::Expansion<double>& series, const orbit::State& s) {
  constexpr int first = 40, last = 100;
  constexpr double middle = (first + last) / 2.0;
  series.expand(s, last);
  double above = 0, below = 0;
  for (int k = first; k <= last; ++k) {
    above += (k - middle) * (std::log(series.coefficient(k).norm()) + 5.0 / 3 * std::log(k));
    below += (k - middle) * (k - middle);
  }
  return std::exp(-above / below);
}

Radii radii(double eccentricity, int half) {
  Radii r{eccentricity, {}, {}, {}, {}};
  orbit::Expansion<double> series(orbit::Gravity{}, 100);
  // acosh(1/e) - sqrt(1 - e^2), the formula as it stands.
  const double least = std::acosh(1 / eccentricity) - std::sqrt((1 - eccentricity) * (1 + eccentricity));
  for (int k = -half; k <= half; ++k) {
    const double m = revolution / 2 * k / half;
    const orbit::State s = on_ellipse(eccentricity, m);
    r.anomaly.push_back(m);
    r.radius.push_back(orbit::convergence_radius(s, 1));
    r.closed.push_back(std::hypot(m, least));
    r.by_coefficients.push_back(radius_by_coefficients(series, s));
  }
  return r;
}

/// What so many steps an orbit come to.
struct Choice {
  double eccentricity;
  int steps;           ///< an orbit
  const char* remark;  ///< "as printed"
  double ratio = 0;    ///< of the step over the radius at the periapsis
  std::vector<double> first,
      orbit;  ///< |dr|/a after the step from the periapsis, and after an orbit, by order
};

constexpr std::array orders{10, 20, 30, 40, 60, 80};

void run(Choice& c) {
  const orbit::State start = on_ellipse(c.eccentricity);
  const double step = revolution / c.steps;
  c.ratio = step / orbit::convergence_radius_at_periapsis(c.eccentricity);
  for (const int order : orders) {
    const auto after = [&](double time) {
      const auto end = orbit::propagate(start, 0, time, orbit::Gravity{},
                                        orbit::FixedContinuation{.step = step, .order = order});
      return end.status.ok() ? position_error(start, time, 1, end.state.position) : HUGE_VAL;
    };
    c.first.push_back(after(step));
    c.orbit.push_back(after(revolution));
  }
}

struct Measured {
  std::vector<Radii> radii;
  std::vector<Choice> choices;
};

Measured measure(bool quick) {
  Measured m;
  for (const double e : {0.1, 0.7, 0.9, 0.99}) m.radii.push_back(radii(e, quick ? 18 : 90));
  m.choices = {{0.1, 25, "as printed, order 10", 0, {}, {}},
               {0.7, 100, "as printed, order 30", 0, {}, {}},
               {0.7, 50, "", 0, {}, {}},
               {0.7, 35, "just within", 0, {}, {}},
               {0.7, 25, "steps of the low orbit", 0, {}, {}},
               {0.99, 100, "steps of the high orbit", 0, {}, {}}};
  for (Choice& c : m.choices) run(c);
  return m;
}

scene::Table table_of(const Measured& m) {
  std::vector<scene::Column> columns = {{"e"}, {"steps an orbit"}, {"remark"}, {"h over radius", 3}};
  for (const int order : orders) columns.push_back({fmt::format("one step, order {}", order), 2});
  for (const int order : orders) columns.push_back({fmt::format("an orbit, order {}", order), 2});
  scene::Table table(std::move(columns));
  for (const Choice& c : m.choices) {
    std::vector<scene::Cell> row = {c.eccentricity, std::int64_t{c.steps}, c.remark, c.ratio};
    for (const auto* errors : {&c.first, &c.orbit}) {
      for (const double error : *errors) {
        // Far away from the orbit one number is as good as another.
        row.emplace_back(error < 100 ? scene::Cell(error) : scene::Cell("> 100"));
      }
    }
    table.add(std::move(row));
  }
  return table;
}

scene::Table data_of(const Measured& m) {
  scene::Table data({{"e", 3, true}, {"mean_anomaly_deg"}, {"radius_orbits"}, {"by_coefficients_orbits"}});
  for (const Radii& r : m.radii) {
    for (std::size_t i = 0; i < r.anomaly.size(); ++i) {
      data.add({r.eccentricity, 360 * r.anomaly[i] / revolution, r.radius[i] / revolution,
                r.by_coefficients[i] / revolution});
    }
  }
  return data;
}

double greatest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a[i] / b[i] - 1));
  return greatest;
}

/// By what an error grows from order 40 to order 80, a degree.
double growth(const Choice& c) { return std::pow(c.first[5] / c.first[3], 1.0 / 40); }

scene::Showing show(const Measured& m) {
  scene::Showing showing;
  showing.table = table_of(m);
  showing.figure = {data_of(m),
                    "two_body_series-convergence-radius",
                    {{"heading", "Near the periapsis a step must be short to converge at all"}}};
  double closed = 0, decay = 0;
  for (const Radii& r : m.radii) {
    closed = std::max(closed, greatest_difference(r.radius, r.closed));
    decay = std::max(decay, greatest_difference(r.by_coefficients, r.closed));
  }
  const auto periapsis = [&](std::size_t i) { return m.radii[i].radius[m.radii[i].radius.size() / 2]; };
  const Choice &low = m.choices[0], &high = m.choices[1], &fifty = m.choices[2], &divergent = m.choices[4];
  const char* program = "recorded, four digits";
  showing.quantities = {
      scene::at_most("difference from the closed form", "1", closed, 1e-12,
                     "acosh(1/e) - sqrt(1 - e^2) cancels: (1 - e)^(-3/2) eps at e = 0.99, and as much of M"),
      scene::at_most("difference from the decay of coefficients", "1", decay, 0.02,
                     "the next terms of the singularity, of the order 1/70 of the first"),
      scene::near("radius at the periapsis, e = 0.1", "1", periapsis(0), 1.998, 3e-4, program),
      scene::near("radius at the periapsis, e = 0.7", "1", periapsis(1), 0.1815, 5e-4, program),
      scene::near("h over radius, low orbit", "1", low.ratio, 0.126, 4e-3, program),
      scene::near("h over radius, high orbit", "1", high.ratio, 0.346, 2e-3, program),
      {"least steps an orbit that converge, e = 0.7", "1", std::floor(revolution / periapsis(1)) + 1, 35, 35,
       "2 pi / 0.1815 = 34.6"},
      {"least steps an orbit that converge, e = 0.99", "1", std::floor(revolution / periapsis(3)) + 1, 6635,
       6635, "2 pi over b^3 (1/3 + b^2/5 + b^4/7) with b^2 = 1 - e^2: 6634.2"},
      scene::near("growth a degree of the error of a step, 25 steps an orbit, e = 0.7", "1",
                  growth(divergent), divergent.ratio * std::pow(0.5, 1.0 / 24), 0.01,
                  "h over radius, with k^(-5/3) over the degrees from 40 to 80"),
      scene::at_most(
          "error after an orbit, 50 steps, order 80, e = 0.7", "1", fifty.orbit[5], 5e-11,
          "(h/rho)^80 = 2e-13 of the velocity at the periapsis, 2.4, times the condition, about 100"),
      {"error after an orbit, 25 steps, order 30, e = 0.7", "1", divergent.orbit[2], 1, HUGE_VAL,
       "the first step leaves the ellipse by more than its size"}};
  return showing;
}

}  // namespace

void add_convergence_radius(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Measured>(
      "convergence-radius",
      "units a = 1, mu = 1; positions to the order, velocities one less; errors |dr|/a from the periapsis",
      {}, [](Workshop& w) { return measure(w.quick()); });
  chapter.add({.name = "convergence-radius",
               .title = "Printed steps against the radius of convergence along the orbit",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
