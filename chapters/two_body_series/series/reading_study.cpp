#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/published_runs.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/convergence.hpp"

namespace nlmech::chapters::two_body_series::reading_study {
namespace {

using Norms = std::array<double, 3>;  ///< norms over 5, 10 and 20 orbits

/// Degrees of the position and velocity series.
struct Degrees {
  int position, velocity;
  [[nodiscard]] std::string text() const { return fmt::format("({}, {})", position, velocity); }
  [[nodiscard]] bool operator==(const Degrees&) const = default;
};

/// Energy error norms of Analytic-Cont under one reading.
struct Trial {
  Degrees degrees;
  double steps;  ///< steps per orbit
  Norms norms;
};

/// Printed norms "||eps||" of Tables 3.2 and 3.3.
Norms printed_norms(const Orbit& orbit, Propagator propagator, scene::Show& show) {
  Norms norms{};
  std::ranges::transform(revolutions, norms.begin(),
                         [&](int orbits) { return show.printed(norm_in_source(orbit, propagator, orbits)); });
  return norms;
}

/// Largest deviation of the three norms from the printed ones: max(computed/printed, printed/computed) - 1.
double distance(const Norms& computed, const Norms& printed) {
  double worst = 0;
  for (std::size_t k = 0; k < computed.size(); ++k) {
    const double ratio = computed[k] / printed[k], factor = std::max(ratio, 1 / ratio) - 1;
    if (!(factor <= worst)) worst = factor;
  }
  return worst;
}

/// Are all three norms within 10 % of the printed ones?
bool fits(const Norms& computed, const Norms& printed) { return distance(computed, printed) <= 0.1; }

/// Norms of a run over twenty orbits; infinite if it fails.
Norms norms_of(const Orbit& orbit, const Degrees& degrees, double steps) {
  const double step = period_of(orbit) / steps, before = orbit::energy(orbit.start, earth_mu);
  std::array<std::int64_t, 3> ends{};
  for (std::size_t k = 0; k < ends.size(); ++k) ends[k] = std::llround(revolutions[k] * steps);
  Norms squares{};
  const auto observe = [&](const orbit::Step& s) {
    const double e = orbit::energy(s.x1, earth_mu) / before - 1;
    for (std::size_t k = 0; k < ends.size(); ++k) squares[k] += s.index <= ends[k] ? e * e : 0;
    return true;
  };
  const auto end = orbit::propagate(
      orbit.start, 0, static_cast<double>(ends.back()) * step, orbit::Gravity{.mu = earth_mu},
      orbit::FixedContinuation{.step = step, .order = degrees.position, .velocity_degree = degrees.velocity},
      observe);
  if (!end.status.ok()) return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  for (double& s : squares) s = std::sqrt(s);
  return squares;
}

/// Norms of the textbook form of F and G. @param enough stopping bound of Newton's iteration
Norms norms_of_f_and_g(const Orbit& orbit, double enough) {
  const double step = period_of(orbit) / orbit.steps, before = orbit::energy(orbit.start, earth_mu);
  Norms squares{};
  for (int k = 1; k <= revolutions.back() * orbit.steps; ++k) {
    const orbit::State s = textbook_f_and_g(orbit.start, k * step, earth_mu, enough);
    const double e = orbit::energy(s, earth_mu) / before - 1;
    for (std::size_t i = 0; i < squares.size(); ++i)
      squares[i] += k <= revolutions[i] * orbit.steps ? e * e : 0;
  }
  for (double& s : squares) s = std::sqrt(s);
  return squares;
}

/// Readings tried for an orbit.
struct Plan {
  std::vector<Degrees> degrees;     ///< drawn degrees
  double least, most, distance;     ///< steps per orbit: range and increment
  int lowest_order, highest_order;  ///< orders tried with the printed steps
};

Plan plan_of(const Orbit& orbit) {
  if (orbit.order == low_orbit().order)
    return {{{10, 9}, {10, 10}, {12, 11}, {9, 8}, {9, 9}, {8, 8}}, 19, 25, 0.25, 5, 14};
  return {{{30, 29}, {30, 30}, {17, 18}, {17, 17}, {18, 17}, {17, 16}}, 64, 100, 1, 12, 34};
}

/// All trials for an orbit.
struct Trials {
  std::vector<Trial> drawn;             ///< trials over steps per orbit
  std::vector<Trial> at_printed_steps;  ///< trials over degrees

  /// The drawn trial of degrees @p d nearest to the printed norms.
  [[nodiscard]] Trial best_of(const Degrees& d, const Norms& printed) const {
    Trial best{d, 0, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    for (const Trial& t : drawn) {
      if (t.degrees != d) continue;
      if (best.steps == 0 || distance(t.norms, printed) < distance(best.norms, printed)) best = t;
    }
    return best;
  }
};

/// @param quick computes a quarter of the drawn points
Trials try_all(const Orbit& orbit, bool quick) {
  const Plan plan = plan_of(orbit);
  Trials all;
  const double distance = (quick ? 4 : 1) * plan.distance;
  const auto count = static_cast<int>(std::lround((plan.most - plan.least) / distance));
  for (const Degrees& d : plan.degrees) {
    for (int i = 0; i <= count; ++i) {
      const double steps = plan.least + i * distance;
      all.drawn.push_back({d, steps, norms_of(orbit, d, steps)});
    }
  }
  for (int k = plan.lowest_order; k <= plan.highest_order; ++k) {
    for (const int v : {k - 1, k, k + 1})
      all.at_printed_steps.push_back({{k, v}, double(orbit.steps), norms_of(orbit, {k, v}, orbit.steps)});
  }
  return all;
}

/// An orbit with its trials, and the runs of ode45 over 5, 10 and 20 orbits.
struct Study {
  Orbit orbit;
  const Trials& trials;
  const std::vector<const EnergyRecord*>& ode45;
};

/// A table row: computed and printed norms.
struct Row {
  std::string orbit, method, reading;
  std::optional<double> steps;
  Norms computed, printed;
};

void add_rows(std::vector<Row>& rows, const Study& study, scene::Show& show) {
  const Orbit& orbit = study.orbit;
  const Norms series = printed_norms(orbit, Propagator::series, show),
              ode45 = printed_norms(orbit, Propagator::ode45, show),
              f_and_g = printed_norms(orbit, Propagator::f_and_g, show);
  for (const Degrees& d : plan_of(orbit).degrees) {
    const Norms computed = norms_of(orbit, d, orbit.steps);
    rows.push_back({orbit.name, "Analytic-Cont", d.text(), orbit.steps, computed, series});
    const Trial best = study.trials.best_of(d, series);
    if (best.steps != orbit.steps)
      rows.push_back({orbit.name, "Analytic-Cont", d.text() + ", nearest", best.steps, best.norms, series});
  }
  // Possible output points of the printed values of ode45.
  const auto add = [&](const char* reading, std::vector<double> EnergyRecord::*points) {
    Norms computed{};
    for (std::size_t k = 0; k < computed.size(); ++k) computed[k] = norm_of(study.ode45[k]->*points);
    rows.push_back({orbit.name, "ode45", reading, {}, computed, ode45});
  };
  add("points of Analytic-Cont", &EnergyRecord::error);
  add("ends of its steps", &EnergyRecord::at_ends);
  add("four values a step", &EnergyRecord::at_refined);
  rows.push_back({orbit.name, "F&G", "Newton to rounding", {}, norms_of_f_and_g(orbit, 0), f_and_g});
  rows.push_back({orbit.name, "F&G", "Newton to 1e-6", {}, norms_of_f_and_g(orbit, 1e-6), f_and_g});
}

void tabulate(const std::vector<Row>& rows, scene::Show& show) {
  const auto computed = [](std::size_t k) { return [k](const Row& r) { return r.computed[k]; }; };
  const auto ratio = [](std::size_t k) { return [k](const Row& r) { return r.computed[k] / r.printed[k]; }; };
  show.table(rows,
             {{"orbit", &Row::orbit},
              {"method", &Row::method},
              {"reading", &Row::reading},
              {"steps an orbit", &Row::steps, 4},
              {"5 orbits", computed(0)},
              {"10 orbits", computed(1)},
              {"20 orbits", computed(2)},
              {"times printed, 5", ratio(0), 2},
              {"10", ratio(1), 2},
              {"20", ratio(2), 2},
              {"all within 10 %", [](const Row& r) { return fits(r.computed, r.printed) ? "yes" : "no"; }}});
}

/// Adds one curve per pair of degrees.
void add_panel(scene::Panel& panel, int first_block, scene::Table& data, const Study& study,
               scene::Show& show) {
  const Norms printed = printed_norms(study.orbit, Propagator::series, show);
  panel.set("key at graph 0.5, graph 1.01 center bottom horizontal maxrows 3 samplen 3 width -1");
  panel.set(
      fmt::format("label 3 '{}, printed with {} steps' at graph 0.04, graph 0.07 textcolor rgb soft_ink",
                  study.orbit.name, study.orbit.steps));
  panel.also("0.1 with lines linestyle 13 dashtype 3");
  int curve = 0;
  for (const Degrees& d : plan_of(study.orbit).degrees) {
    panel.columns(d.text(), "steps:distance", scene::lines(), first_block + curve);
    ++curve;
    for (const Trial& t : study.trials.drawn) {
      const double off = distance(t.norms, printed);
      if (t.degrees == d && std::isfinite(off))
        data.add({fmt::format("{} {}", study.orbit.name, curve), t.steps, off});
    }
  }
}

void draw(const Study& low, const Study& high, scene::Show& show) {
  scene::Plot& plot =
      show.plots("Ratio of errors: no pair of degrees fits the printed errors at the printed steps");
  scene::Table data({{"curve", 3, true}, {"steps"}, {"distance"}});
  scene::Panel& left = plot.panel("steps an orbit", "max(computed/printed, printed/computed) − 1");
  left.x_range(18.8, 25.2).log_y(1e-2, 1e4).set("margins screen 0.12, screen 0.52, screen 0.13, screen 0.74");
  left.set("label 4 '10 %' at graph 0.97, first 0.14 right textcolor rgb soft_ink");
  add_panel(left, 0, data, low, show);
  scene::Panel& right = plot.panel("steps an orbit", "");
  right.x_range(63, 101).log_y(1e-2, 1e8);
  right.set("margins screen 0.60, screen 0.985, screen 0.13, screen 0.74");
  right.set("label 4 '10 %' at graph 0.03, first 0.17 left textcolor rgb soft_ink");
  add_panel(right, static_cast<int>(plan_of(low.orbit).degrees.size()), data, high, show);
  plot.data(std::move(data));
}

/// Reference norms of two to four digits.
struct Known {
  Orbit orbit;
  Degrees degrees;
  double steps;
  Norms norms;
  double share;
};

void check_norms(scene::Show& show) {
  // oracle: two_body_series_steps LEO (10 10) *, LEO (12 11) *, LEO (9 *, LEO (8 8) *, HEO (17 18) *, HEO (30
  // 29) 72 *
  const std::vector<Known> all = {{low_orbit(), {10, 10}, 25, {4.98e-9, 6.40e-9, 7.51e-9}, 0.01},
                                  {low_orbit(), {12, 11}, 25, {4.3e-10, 6.4e-10, 9.9e-10}, 0.02},
                                  {low_orbit(), {9, 8}, 25, {3.84e-7, 4.73e-7, 5.33e-7}, 0.01},
                                  {low_orbit(), {8, 8}, 25, {4.5e-7, 5.1e-7, 7.4e-7}, 0.02},
                                  {low_orbit(), {9, 9}, 19.75, {4.467e-7, 7.573e-7, 1.438e-6}, 0.001},
                                  {high_orbit(), {17, 18}, 100, {3.557e-8, 9.163e-8, 2.466e-7}, 0.001},
                                  {high_orbit(), {30, 29}, 72, {3.237e-8, 8.609e-8, 2.357e-7}, 0.001}};
  for (const Known& k : all) {
    const Norms computed = norms_of(k.orbit, k.degrees, k.steps);
    for (std::size_t i = 0; i < computed.size(); ++i)
      show.near(fmt::format("norm of {} {}, {:g} steps, {} orbits", k.orbit.name, k.degrees.text(), k.steps,
                            revolutions[i]),
                computed[i], k.norms[i], k.share, "tools/oracles/two_body_series_steps.py, to its digits");
  }
  // Newton's iteration stopped at 1e-6 gives the same error in every orbit, like the printed values.
  const Norms computed = norms_of_f_and_g(high_orbit(), 1e-6), known = {3.85e-12, 5.53e-12, 7.81e-12};
  for (std::size_t i = 0; i < computed.size(); ++i)
    show.near(fmt::format("norm of HEO F&G, Newton to 1e-6, {} orbits", revolutions[i]), computed[i],
              known[i], 0.1, "regression value; a tenth of it is rounding of both");
}

void check_fits(const Study& study, double share, scene::Show& show) {
  const Orbit& orbit = study.orbit;
  const Norms printed = printed_norms(orbit, Propagator::series, show);
  show.equals(fmt::format("readings within 10 % with the printed steps, {}", orbit.name),
              std::ranges::count_if(study.trials.at_printed_steps,
                                    [&](const Trial& t) { return fits(t.norms, printed); }),
              0, "regression value: none");
  show.near(fmt::format("step over radius of convergence at the periapsis, {}", orbit.name),
            period_of(orbit) / orbit.steps / orbit::convergence_radius(orbit.start, earth_mu), share, 0.005,
            "2 pi/steps over acosh(1/e) - sqrt(1 - e^2) by hand, three digits");
}

void put(const Trials& of_low, const Trials& of_high, const std::vector<const EnergyRecord*>& low_ode45,
         const std::vector<const EnergyRecord*>& high_ode45, scene::Show& show) {
  const Study low{low_orbit(), of_low, low_ode45}, high{high_orbit(), of_high, high_ode45};
  std::vector<Row> rows;
  add_rows(rows, low, show);
  add_rows(rows, high, show);
  tabulate(rows, show);
  draw(low, high, show);
  check_norms(show);
  check_fits(low, 0.126, show);
  check_fits(high, 0.346, show);
}

scene::Result<Trials> trials_of(const char* name, const Orbit& orbit) {
  return {name, "(K, L): r to degree K, v to degree L; output after every step; 5, 10, 20 orbits of a run",
          [orbit](bool quick) { return try_all(orbit, quick); }};
}

std::vector<scene::Result<EnergyRecord>> ode45_of(const Orbit& orbit) {
  std::vector<scene::Result<EnergyRecord>> all;
  for (const int orbits : revolutions) all.push_back(followed(orbit, orbits, Propagator::ode45));
  return all;
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "reading-study",
           .title = "Degrees and steps that fit the printed energy errors",
           .place = "our own, for Tables 3.2 and 3.3",
           .content = scene::Content(put, trials_of("leo-readings", low_orbit()),
                                     trials_of("heo-readings", high_orbit()), ode45_of(low_orbit()),
                                     ode45_of(high_orbit()))}};
}

}  // namespace nlmech::chapters::two_body_series::reading_study
