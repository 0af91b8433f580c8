#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/two_body_series/scenes.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/convergence.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using Norms = std::array<double, 3>;  ///< over 5, 10 and 20 orbits

/// Degrees of the two series.
struct Degrees {
  int position, velocity;
  [[nodiscard]] std::string text() const { return fmt::format("({}, {})", position, velocity); }
};

/// Energy error norms of Analytic-Cont under one reading.
struct Trial {
  Degrees degrees;
  double steps;  ///< an orbit
  Norms norms;
};

/// "||eps||" of Tables 3.2 and 3.3.
Norms printed_norms(const Orbit& orbit) {
  return orbit.order == low_orbit().order ? Norms{4.45e-7, 7.38e-7, 1.55e-6}
                                          : Norms{3.73e-8, 1.21e-7, 2.27e-7};
}

/// How far the worst of the three is from print: max(ours/printed, printed/ours) - 1.
double distance(const Norms& ours, const Norms& printed) {
  double worst = 0;
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const double ratio = ours[k] / printed[k], factor = std::max(ratio, 1 / ratio) - 1;
    if (!(factor <= worst)) worst = factor;
  }
  return worst;
}

/// Within 10 % of all three.
bool fits(const Norms& ours, const Norms& printed) { return distance(ours, printed) <= 0.1; }

/// Twenty orbits; a run that overflows has infinite norms.
Norms norms_of(const Orbit& orbit, const Degrees& degrees, double steps) {
  const double step = period_of(orbit) / steps, before = orbit::energy(orbit.start, earth_mu);
  std::array<std::int64_t, 3> ends{};
  for (std::size_t k = 0; k < ends.size(); ++k) ends[k] = std::llround(revolutions[k] * steps);
  Norms squares{};
  const auto observe = [&](const orbit::ContinuationStep& s) {
    const double e = orbit::energy(s.state1, earth_mu) / before - 1;
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

/// What is tried on an orbit.
struct Plan {
  std::vector<Degrees> degrees;     ///< that are drawn
  double least, most, distance;     ///< steps an orbit
  int lowest_order, highest_order;  ///< of all readings that are tried with the printed steps
};

Plan plan_of(const Orbit& orbit) {
  if (orbit.order == low_orbit().order)
    return {{{10, 9}, {10, 10}, {12, 11}, {9, 8}, {9, 9}, {8, 8}}, 19, 25, 0.25, 5, 14};
  return {{{30, 29}, {30, 30}, {17, 18}, {17, 17}, {18, 17}, {17, 16}}, 64, 100, 1, 12, 34};
}

/// All trials on an orbit.
struct Trials {
  std::vector<Trial> drawn;             ///< steps varied
  std::vector<Trial> at_printed_steps;  ///< degrees varied

  /// The nearest to print of a pair of degrees that is drawn.
  [[nodiscard]] Trial best_of(const Degrees& d, const Norms& printed) const {
    Trial best{d, 0, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    for (const Trial& t : drawn) {
      if (t.degrees.position != d.position || t.degrees.velocity != d.velocity) continue;
      if (best.steps == 0 || distance(t.norms, printed) < distance(best.norms, printed)) best = t;
    }
    return best;
  }
};

/// @param quick a quarter of the points that are drawn
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

/// The first cells of a row.
struct Head {
  std::string method, reading;
  std::optional<double> steps;
};

/// A row: norms and how many times the printed ones they are.
void add_row(scene::Table& table, const Orbit& orbit, const Head& head, const Norms& ours,
             const Norms& printed) {
  table.add({orbit.name, head.method, head.reading, scene::to_cell(head.steps), ours[0], ours[1], ours[2],
             ours[0] / printed[0], ours[1] / printed[1], ours[2] / printed[2],
             fits(ours, printed) ? "yes" : "no"});
}

void add_series_rows(scene::Table& table, const Orbit& orbit, const Trials& trials) {
  const Norms printed = printed_norms(orbit);
  for (const Degrees& d : plan_of(orbit).degrees) {
    add_row(table, orbit, {"Analytic-Cont", d.text(), orbit.steps}, norms_of(orbit, d, orbit.steps), printed);
    const Trial best = trials.best_of(d, printed);
    if (best.steps != orbit.steps)
      add_row(table, orbit, {"Analytic-Cont", d.text() + ", nearest", best.steps}, best.norms, printed);
  }
}

/// Printed norms of the methods that are the same under every reading of the order.
struct PrintedNorms {
  Norms ode45, f_and_g;
};

PrintedNorms printed_of_others(const Orbit& orbit) {
  if (orbit.order == low_orbit().order) return {{1.15e-5, 3.43e-5, 1.01e-4}, {3.6e-13, 3.6e-13, 6.3e-13}};
  return {{1.65e-4, 5.18e-4, 1.5e-3}, {5.23e-12, 7.47e-12, 6.3e-13}};
}

/// Where the printed values of ode45 may have been taken.
void add_ode45_rows(scene::Table& table, const PublishedRuns& runs, Workshop& w) {
  const auto add = [&](const char* reading, std::vector<double> EnergyRecord::*points) {
    Norms ours{};
    for (std::size_t k = 0; k < ours.size(); ++k)
      ours[k] = norm_of(w.result(runs.of(Propagator::ode45, k)).*points);
    add_row(table, runs.orbit, {"ode45", reading, {}}, ours, printed_of_others(runs.orbit).ode45);
  };
  add("points of Analytic-Cont", &EnergyRecord::error);
  add("ends of its steps", &EnergyRecord::at_ends);
  add("four values a step", &EnergyRecord::at_refined);
}

/// The textbook form with Newton's iteration stopped early.
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

void add_f_and_g_rows(scene::Table& table, const Orbit& orbit) {
  const Norms printed = printed_of_others(orbit).f_and_g;
  add_row(table, orbit, {"F&G", "Newton to rounding", {}}, norms_of_f_and_g(orbit, 0), printed);
  add_row(table, orbit, {"F&G", "Newton to 1e-6", {}}, norms_of_f_and_g(orbit, 1e-6), printed);
}

void add_points(scene::Table& data, const Orbit& orbit, const Trials& trials) {
  std::int64_t curve = 0;
  for (const Degrees& d : plan_of(orbit).degrees) {
    ++curve;
    for (const Trial& t : trials.drawn) {
      const double off = distance(t.norms, printed_norms(orbit));
      if (t.degrees.position == d.position && t.degrees.velocity == d.velocity && std::isfinite(off))
        data.add({fmt::format("{} {}", orbit.name, curve), t.steps, off});
    }
  }
}

std::string labels_of(const Orbit& orbit) {
  std::vector<std::string> labels;
  for (const Degrees& d : plan_of(orbit).degrees) labels.push_back(d.text());
  return fmt::format("{}", fmt::join(labels, "|"));
}

/// Norms of two to four digits.
struct Known {
  Degrees degrees;
  double steps;
  Norms norms;
  double share;
};

void promise_norms(std::vector<scene::Quantity>& all, const Orbit& orbit, const std::vector<Known>& known) {
  for (const Known& k : known) {
    const Norms ours = norms_of(orbit, k.degrees, k.steps);
    for (std::size_t i = 0; i < ours.size(); ++i) {
      all.push_back(scene::near(fmt::format("norm of {} {}, {:g} steps, {} orbits", orbit.name,
                                            k.degrees.text(), k.steps, revolutions[i]),
                                "1", ours[i], k.norms[i], k.share,
                                "tools/oracles/two_body_series_steps.py, to its digits"));
    }
  }
}

/// Ended at 1e-6, Newton's iteration leaves the same error in every orbit, as the printed values have it.
void promise_early_end(std::vector<scene::Quantity>& all) {
  const Norms ours = norms_of_f_and_g(high_orbit(), 1e-6), known = {3.85e-12, 5.53e-12, 7.81e-12};
  for (std::size_t i = 0; i < ours.size(); ++i) {
    all.push_back(scene::near(fmt::format("norm of HEO F&G, Newton to 1e-6, {} orbits", revolutions[i]), "1",
                              ours[i], known[i], 0.1, "recorded; a tenth of it is rounding of both"));
  }
}

void promise_fits(std::vector<scene::Quantity>& all, const Orbit& orbit, const Trials& trials) {
  const Norms printed = printed_norms(orbit);
  int fit = 0;
  for (const Trial& t : trials.at_printed_steps) fit += fits(t.norms, printed) ? 1 : 0;
  all.push_back({fmt::format("readings within 10 % with the printed steps, {}", orbit.name), "1", double(fit),
                 0, 0, "recorded: none"});
  const double share = period_of(orbit) / orbit.steps / orbit::convergence_radius(orbit.start, earth_mu);
  all.push_back(scene::near(fmt::format("step over radius of convergence at the periapsis, {}", orbit.name),
                            "1", share, orbit.order == low_orbit().order ? 0.126 : 0.346, 0.005,
                            "2 pi/steps over acosh(1/e) - sqrt(1 - e^2) by hand, three digits"));
}

scene::Showing show(const PublishedRuns& low, const PublishedRuns& high, const Trials& of_low,
                    const Trials& of_high, Workshop& w) {
  scene::Table table({{"orbit"},
                      {"method"},
                      {"reading"},
                      {"steps an orbit", 4},
                      {"5 orbits"},
                      {"10 orbits"},
                      {"20 orbits"},
                      {"times printed, 5", 2},
                      {"10", 2},
                      {"20", 2},
                      {"all within 10 %"}});
  scene::Table data({{"curve", 3, true}, {"steps"}, {"distance"}});
  scene::Showing showing;
  add_series_rows(table, low.orbit, of_low);
  add_ode45_rows(table, low, w);
  add_f_and_g_rows(table, low.orbit);
  add_series_rows(table, high.orbit, of_high);
  add_ode45_rows(table, high, w);
  add_f_and_g_rows(table, high.orbit);
  add_points(data, low.orbit, of_low);
  add_points(data, high.orbit, of_high);
  // oracle: two_body_series_steps LEO (10 10) *, LEO (12 11) *, LEO (9 *, LEO (8 8) *, HEO (17 18) *, HEO (30
  // 29) 72 *
  promise_norms(showing.quantities, low.orbit,
                {{{10, 10}, 25, {4.98e-9, 6.40e-9, 7.51e-9}, 0.01},
                 {{12, 11}, 25, {4.3e-10, 6.4e-10, 9.9e-10}, 0.02},
                 {{9, 8}, 25, {3.84e-7, 4.73e-7, 5.33e-7}, 0.01},
                 {{8, 8}, 25, {4.5e-7, 5.1e-7, 7.4e-7}, 0.02},
                 {{9, 9}, 19.75, {4.467e-7, 7.573e-7, 1.438e-6}, 0.001}});
  promise_norms(showing.quantities, high.orbit,
                {{{17, 18}, 100, {3.557e-8, 9.163e-8, 2.466e-7}, 0.001},
                 {{30, 29}, 72, {3.237e-8, 8.609e-8, 2.357e-7}, 0.001}});
  promise_early_end(showing.quantities);
  promise_fits(showing.quantities, low.orbit, of_low);
  promise_fits(showing.quantities, high.orbit, of_high);
  showing.figure = {std::move(data),
                    "two_body_series-readings",
                    {{"heading", "No pair of degrees gives the printed errors with the printed steps"},
                     {"low", labels_of(low.orbit)},
                     {"high", labels_of(high.orbit)}}};
  showing.table = std::move(table);
  return showing;
}

}  // namespace

void add_reading_study(scene::Chapter& chapter, const PublishedRuns& low, const PublishedRuns& high) {
  const auto add = [&chapter](const char* name, const Orbit& orbit) -> const scene::Run<Trials>& {
    return chapter.add_run<Trials>(
        name, "(K, L): r to degree K, v to degree L; output after every step; 5, 10, 20 orbits of a run", {},
        [orbit](Workshop& w) { return try_all(orbit, w.quick()); });
  };
  const auto &of_low = add("leo-readings", low.orbit), &of_high = add("heo-readings", high.orbit);
  std::vector<const scene::AnyRun*> needs = {&of_low, &of_high};
  for (const PublishedRuns* runs : {&low, &high}) {
    for (std::size_t k = 0; k < revolutions.size(); ++k) needs.push_back(&runs->of(Propagator::ode45, k));
  }
  chapter.add({.name = "reading-study",
               .title = "Which degrees and steps the printed energy errors fit",
               .place = "our own, for Tables 3.2 and 3.3",
               .needs = needs,
               .show = [low, high, &of_low, &of_high](Workshop& w) {
                 return show(low, high, w.result(of_low), w.result(of_high), w);
               }});
}

}  // namespace nlmech::chapters
