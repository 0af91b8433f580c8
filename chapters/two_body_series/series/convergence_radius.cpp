#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::two_body_series::convergence_radius {
namespace {

/// Radii of convergence along an ellipse, in mean anomaly.
struct Radius {
  double anomaly, radius, closed, by_coefficients;
};
struct Radii {
  double eccentricity = 0;
  std::vector<Radius> at = {};
};

/// Radius from the decay of the coefficients of orders 40 to 100. Near r = 0 the motion is proportional to
/// (t - t_0)^(2/3), whose coefficients decay like k^(-5/3) rho^(-k). The least-squares slope averages the
/// oscillation due to the pair of singularities.
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
  Radii r{eccentricity};
  orbit::Expansion<double> series(orbit::Gravity{}, 100);
  // acosh(1/e) - sqrt(1 - e^2), evaluated directly.
  const double least = std::acosh(1 / eccentricity) - std::sqrt((1 - eccentricity) * (1 + eccentricity));
  for (int k = -half; k <= half; ++k) {
    const double m = revolution / 2 * k / half;
    const orbit::State s = on_ellipse(eccentricity, m);
    r.at.push_back(
        {m, orbit::convergence_radius(s, 1), std::hypot(m, least), radius_by_coefficients(series, s)});
  }
  return r;
}

/// Errors for a number of steps per orbit.
struct Choice {
  double eccentricity;
  int steps;                                   ///< steps per orbit
  const char* remark;                          ///< remark in the table, such as "as printed"
  double ratio = 0;                            ///< step over the radius of convergence at the periapsis
  std::vector<double> first = {}, orbit = {};  ///< |dr|/a after one step and an orbit, by order
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
      return end.status.ok() ? position_error(start, time, 1, end.x.position) : HUGE_VAL;
    };
    c.first.push_back(after(step));
    c.orbit.push_back(after(revolution));
  }
}

struct Outcome {
  std::vector<Radii> radii;
  std::vector<Choice> choices;
};

Outcome measure(bool quick) {
  Outcome m;
  for (const double e : {0.1, 0.7, 0.9, 0.99}) m.radii.push_back(radii(e, quick ? 18 : 90));
  m.choices = {{0.1, 25, "as printed, order 10"},
               {0.7, 100, "as printed, order 30"},
               {0.7, 50, ""},
               {0.7, 35, "just within"},
               {0.7, 25, "steps of the low orbit"},
               {0.99, 100, "steps of the high orbit"}};
  for (Choice& c : m.choices) run(c);
  return m;
}

/// A table row: errors after one step, or after an orbit.
struct Line {
  const Choice* choice;
  const char* after;
  std::vector<double> Choice::*errors;
};

void tabulate(const std::vector<Choice>& choices, scene::Show& show) {
  std::vector<Line> lines;
  for (const Choice& c : choices) {
    lines.push_back({&c, "one step", &Choice::first});
    lines.push_back({&c, "an orbit", &Choice::orbit});
  }
  scene::ColumnsOf<std::vector<Line>> columns = {
      {"e", [](const Line& l) { return l.choice->eccentricity; }},
      {"steps an orbit", [](const Line& l) { return l.choice->steps; }},
      {"remark", [](const Line& l) { return l.choice->remark; }},
      {"h over radius", [](const Line& l) { return l.choice->ratio; }},
      {"error after", &Line::after}};
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const auto cell = [i](const Line& l) {
      // Larger errors carry no information.
      const double error = (l.choice->*l.errors)[i];
      return error < 100 ? scene::Cell(error) : scene::Cell("> 100");
    };
    columns.emplace_back(fmt::format("order {}", orders[i]), cell, 2);
  }
  show.table(lines, columns);
}

/// Draws the radii; marks are radii from the coefficients.
void draw(const std::vector<Radii>& all, scene::Show& show) {
  scene::Panel& panel = show.plot("Radius of convergence along the orbit: smallest at the periapsis",
                                  "mean anomaly (deg); periapsis at 0", "radius of convergence (orbits)");
  panel.x_range(-180, 180).log_y(1e-4, 2).set("xtics 60").key("bottom left");
  const char* small = "right font 'sans-serif,11' textcolor rgb soft_ink";
  panel.level(0.04).level(0.01);
  panel.set(fmt::format("label 1 '25 steps an orbit' at 176, 0.04 offset 0,-0.6 {}", small));
  panel.set(fmt::format("label 2 '100 steps an orbit' at 176, 0.01 offset 0,-0.6 {}", small));
  panel.set(
      fmt::format("label 3 'marks: from the coefficients of orders 40 to 100' at 176, 1.4e-4 {}", small));
  scene::Table data({{"e", 3, true}, {"mean_anomaly_deg"}, {"radius_orbits"}, {"by_coefficients_orbits"}});
  for (int k = 0; k < static_cast<int>(all.size()); ++k) {
    const Radii& r = all[static_cast<std::size_t>(k)];
    panel.columns(fmt::format("e = {:g}", r.eccentricity), "mean_anomaly_deg:radius_orbits", scene::lines(),
                  k);
    panel.also(
        fmt::format("data using \"mean_anomaly_deg\":\"by_coefficients_orbits\" every 10:::{0}::{0} with "
                    "points linestyle {1}",
                    k, k + 1));
    for (const Radius& at : r.at)
      data.add({r.eccentricity, 360 * at.anomaly / revolution, at.radius / revolution,
                at.by_coefficients / revolution});
  }
  show.figure().data(std::move(data));
}

/// Growth factor of an error per degree from order 40 to order 80.
double growth(const Choice& c) { return std::pow(c.first[5] / c.first[3], 1.0 / 40); }

void check_radii(const std::vector<Radii>& all, scene::Show& show) {
  double closed = 0, decay = 0;
  for (const Radii& r : all) {
    for (const Radius& at : r.at) {
      closed = std::max(closed, std::abs(at.radius / at.closed - 1));
      decay = std::max(decay, std::abs(at.by_coefficients / at.closed - 1));
    }
  }
  show.at_most("difference from the closed form", closed, 1e-12,
               "acosh(1/e) - sqrt(1 - e^2) cancels: (1 - e)^(-3/2) eps at e = 0.99, and as much of M");
  show.at_most("difference from the decay of coefficients", decay, 0.02,
               "the next terms of the singularity, of the order 1/70 of the first");
}

void put(const Outcome& m, scene::Show& show) {
  tabulate(m.choices, show);
  draw(m.radii, show);
  check_radii(m.radii, show);
  const auto periapsis = [&](std::size_t i) { return m.radii[i].at[m.radii[i].at.size() / 2].radius; };
  const Choice &low = m.choices[0], &high = m.choices[1], &fifty = m.choices[2], &divergent = m.choices[4];
  const char* program = "regression value, four digits";
  show.near("radius at the periapsis, e = 0.1", periapsis(0), 1.998, 3e-4, program);
  show.near("radius at the periapsis, e = 0.7", periapsis(1), 0.1815, 5e-4, program);
  show.near("h over radius, low orbit", low.ratio, 0.126, 4e-3, program);
  show.near("h over radius, high orbit", high.ratio, 0.346, 2e-3, program);
  show.equals("least steps an orbit that converge, e = 0.7", std::floor(revolution / periapsis(1)) + 1, 35,
              "2 pi / 0.1815 = 34.6");
  show.equals("least steps an orbit that converge, e = 0.99", std::floor(revolution / periapsis(3)) + 1, 6635,
              "2 pi over b^3 (1/3 + b^2/5 + b^4/7) with b^2 = 1 - e^2: 6634.2");
  show.near("growth a degree of the error of a step, 25 steps an orbit, e = 0.7", growth(divergent),
            divergent.ratio * std::pow(0.5, 1.0 / 24), 0.01,
            "h over radius, with k^(-5/3) over the degrees from 40 to 80");
  show.at_most("error after an orbit, 50 steps, order 80, e = 0.7", fifty.orbit[5], 5e-11,
               "(h/rho)^80 = 2e-13 of the velocity at the periapsis, 2.4, times the condition, about 100");
  show.between("error after an orbit, 25 steps, order 30, e = 0.7", divergent.orbit[2], 1, HUGE_VAL,
               "the first step leaves the ellipse by more than its size");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result outcome(
      "convergence-radius",
      "units a = 1, mu = 1; positions to the order, velocities one less; errors |dr|/a from the periapsis",
      measure);
  return {{.name = "convergence-radius",
           .title = "Printed steps against the radius of convergence along the orbit",
           .place = "our own, stability of the fixed steps of Tables 3.2 and 3.3",
           .content = scene::Content(put, outcome)}};
}

}  // namespace nlmech::chapters::two_body_series::convergence_radius
