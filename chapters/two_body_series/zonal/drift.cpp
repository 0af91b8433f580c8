#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::two_body_series::drift {
namespace {

/// Settings of analytic continuation on an ellipse from several starts.
struct DriftTask {
  std::string name;
  double eccentricity;
  int order;  ///< order of the series; 0: adaptive
  int steps;  ///< steps per orbit
  bool compensated = true;
  bool true_division = true;
  double tolerance = 0;  ///< tolerance of adaptive steps
  int phases = 8;        ///< number of equidistant initial mean anomalies
};

/// Errors as root mean squares over the phases.
struct Drift {
  std::vector<int> orbits;
  std::vector<double> energy;    ///< |E/E_0 - 1|
  std::vector<double> position;  ///< |dr|/a

  /// Exponent of the growth of errors from 100 orbits on, by least squares of logarithms.
  [[nodiscard]] double exponent(const std::vector<double>& errors) const {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < orbits.size(); ++i) {
      if (orbits[i] < 100) continue;
      const double a = std::log(orbits[i]), b = std::log(errors[i]);
      n += 1;
      x += a;
      y += b;
      xx += a * a;
      xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
  }
};

using Wide = orbit::BasicState<long double>;

Wide widened(const orbit::State& s) {
  return {s.position.cast<long double>(), s.velocity.cast<long double>()};
}

/// Checkpoints after 10, 18, 32, 56, 100, ... orbits and at the end.
std::vector<int> checkpoints(int orbits) {
  std::vector<int> all;
  for (int i = 4; std::pow(10, i / 4.0) < 0.99 * orbits; ++i)
    all.push_back(static_cast<int>(std::lround(std::pow(10, i / 4.0))));
  all.push_back(orbits);
  return all;
}

/// Adds the squared errors of one start to the sums.
class Track {
 public:
  Track(const orbit::State& start, Drift& sums)
      : start_(widened(start)), energy_(orbit::energy(start_, 1.0L)), sums_(sums) {}

  /// Is there another checkpoint? orbits() is its time, in orbits.
  [[nodiscard]] bool waits() const { return next_ < sums_.orbits.size(); }
  [[nodiscard]] int orbits() const { return sums_.orbits[next_]; }
  /// Adds the errors of the state at a checkpoint.
  void add(double t, const orbit::State& state) {
    const Wide s = widened(state);
    const long double energy = orbit::energy(s, 1.0L) / energy_ - 1;
    const orbit::Vector3<long double> miss =
        s.position - orbit::kepler_state<long double>(start_, t, 1).position;
    sums_.energy[next_] += static_cast<double>(energy * energy);
    sums_.position[next_] += static_cast<double>(miss.dot(miss));
    ++next_;
  }

 private:
  Wide start_;
  long double energy_;
  Drift& sums_;
  std::size_t next_ = 0;
};

/// Step size of an orbit over @p steps, rounded to a multiple of 2^-30 so that its multiples are exact.
double step_of(int steps) { return std::round(revolution / steps * 0x1p30) * 0x1p-30; }

Status run_fixed(const DriftTask& task, const orbit::State& start, Track& track, int orbits) {
  const double step = step_of(task.steps);
  const orbit::FixedContinuation method{.step = step,
                                        .order = task.order,
                                        .compensated = task.compensated,
                                        .true_division = task.true_division};
  const auto observe = [&](const orbit::Step& s) {
    if (track.waits() && s.index == std::int64_t{task.steps} * track.orbits()) track.add(s.t1, s.x1);
    return true;
  };
  return orbit::propagate(start, 0, step * task.steps * orbits, orbit::Gravity{}, method, observe).status;
}

Status run_adaptive(const DriftTask& task, const orbit::State& start, Track& track, int orbits) {
  const orbit::AnalyticContinuation method{.tolerance = task.tolerance, .compensated = task.compensated};
  const auto observe = [&](const orbit::Step& s) {
    while (track.waits() && s.t1 >= revolution * track.orbits()) {
      const double t = revolution * track.orbits();
      orbit::State x;
      s.dense.at(t, x);
      track.add(t, x);
    }
    return true;
  };
  return orbit::propagate(start, 0, revolution * orbits, orbit::Gravity{}, method, observe).status;
}

/// Computes the errors against energy and Kepler's solution in long double. @throws Failure if a run fails
Drift drift_of(const DriftTask& task, int orbits) {
  Drift d{checkpoints(orbits), {}, {}};
  d.energy.assign(d.orbits.size(), 0);
  d.position = d.energy;
  for (int phase = 0; phase < task.phases; ++phase) {
    const orbit::State start = on_ellipse(task.eccentricity, revolution * (phase + 0.3) / task.phases);
    Track track(start, d);
    const Status status =
        task.order > 0 ? run_fixed(task, start, track, orbits) : run_adaptive(task, start, track, orbits);
    if (!status.ok()) throw Failure(status);
  }
  for (auto* errors : {&d.energy, &d.position}) {
    for (double& error : *errors) error = std::sqrt(error / task.phases);
  }
  return d;
}

std::vector<DriftTask> tasks() {
  return {{"rounded reciprocals", 0.1, 22, 30, false, false, 0, 2},
          {"rounded reciprocals, compensated", 0.1, 22, 30, true, false, 0, 2},
          {"division", 0.1, 22, 30, false, true, 0, 8},
          {"division, compensated", 0.1, 22, 30, true, true, 0, 8},
          {"adaptive, tolerance 1e-15", 0.1, 0, 0, true, true, 1e-15, 8},
          {"adaptive, tolerance 1e-17", 0.1, 0, 0, true, true, 1e-17, 8},
          {"rounded reciprocals, compensated", 0.7, 36, 120, true, false, 0, 1},
          {"division", 0.7, 36, 120, false, true, 0, 8},
          {"division, compensated", 0.7, 36, 120, true, true, 0, 8},
          {"adaptive, tolerance 1e-15", 0.7, 0, 0, true, true, 1e-15, 8},
          {"adaptive, tolerance 1e-17", 0.7, 0, 0, true, true, 1e-17, 8}};
}

/// A task and its result.
struct Outcome {
  DriftTask task;
  Drift drift;

  [[nodiscard]] bool fixed() const { return task.order > 0; }
  [[nodiscard]] double energy_slope() const { return drift.exponent(drift.energy); }
};

std::vector<Outcome> measure(bool quick) {
  std::vector<Outcome> all;
  for (DriftTask task : tasks()) {
    if (quick) task.phases = std::min(task.phases, 4);
    all.push_back({task, drift_of(task, quick ? 1000 : 10'000)});
  }
  return all;
}

void tabulate(const std::vector<Outcome>& all, scene::Show& show) {
  using O = Outcome;
  using scene::Cell;
  show.table(all,
             {{"e", [](const O& o) { return o.task.eccentricity; }},
              {"method", [](const O& o) { return o.task.name; }},
              {"order", [](const O& o) { return o.fixed() ? Cell(o.task.order) : Cell("chosen"); }},
              {"steps an orbit", [](const O& o) { return o.fixed() ? Cell(o.task.steps) : Cell("chosen"); }},
              {"starts", [](const O& o) { return o.task.phases; }},
              {"energy error, 100 orbits", [](const O& o) { return o.drift.energy[4]; }, 2},
              {"energy error, all orbits", [](const O& o) { return o.drift.energy.back(); }, 2},
              {"exponent", &O::energy_slope, 2},
              {"position error over a, all orbits", [](const O& o) { return o.drift.position.back(); }, 2},
              {"exponent of position", [](const O& o) { return o.drift.exponent(o.drift.position); }, 2}});
}

/// Adds guide lines proportional to t and t^(1/2).
void add_guides(scene::Panel& panel) {
  const char* small = "left offset 0.3,0 font 'sans-serif,11' textcolor rgb soft_ink";
  panel.also("1.5e-15*sqrt(x/100) with lines linestyle 13").also("6e-15*(x/100) with lines linestyle 13");
  panel.set(fmt::format("label 3 't' at 12500, 7.5e-13 {}", small));
  panel.set(fmt::format("label 4 't^{{1/2}}' at 12500, 1.68e-14 {}", small));
}

void draw(const std::vector<Outcome>& all, scene::Show& show) {
  const std::map<std::string, std::pair<std::string, int>> looks = {
      {"rounded reciprocals", {"rounded reciprocals", 5}},
      {"rounded reciprocals, compensated", {"rounded reciprocals, compensated", 2}},
      {"division", {"division", 3}},
      {"division, compensated", {"division, compensated", 1}},
      {"adaptive, tolerance 1e-15", {"adaptive, tolerance 10^{−15}", 7}},
      {"adaptive, tolerance 1e-17", {"adaptive, tolerance 10^{−17}", 4}}};
  scene::Plot& plot = show.plots(
      "Energy error: grows as {/:Italic t} with rounded reciprocals, as {/:Italic t}^{1/2} with divisions");
  plot.size(1000, 500);
  scene::Table data({{"line", 3, true}, {"e"}, {"method"}, {"orbits"}, {"energy_error"}, {"position_error"}});
  for (const double e : {0.1, 0.7}) {
    scene::Panel& panel = plot.panel("orbits", e == 0.1 ? "energy error |E/E_0 − 1|" : "");
    panel.caption(fmt::format("e = {:g}", e))
        .log_x(8, 12500)
        .log_y(2e-16, 1e-10)
        .key("top left font 'sans-serif,11' spacing 1.15");
    panel.set("xtics ('10' 10, '100' 100, '1000' 1000, '10 000' 10000)");
    panel.set(fmt::format("margins screen {}, screen {}, screen 0.135, screen 0.87", e == 0.1 ? 0.095 : 0.57,
                          e == 0.1 ? 0.46 : 0.935));
    for (int line = 0; line < static_cast<int>(all.size()); ++line) {
      const auto& [task, d] = all[static_cast<std::size_t>(line)];
      if (task.eccentricity != e) continue;
      const auto& [name, style] = looks.at(task.name);
      panel.columns(name, "orbits:energy_error", {"linespoints", style}, line);
      for (std::size_t k = 0; k < d.orbits.size(); ++k)
        data.add({line, e, task.name, d.orbits[k], d.energy[k], d.position[k]});
    }
    add_guides(panel);
  }
  plot.data(std::move(data));
}

void check(const std::vector<Outcome>& all, scene::Show& show) {
  const auto of = [&](double e, const std::string& name) -> const Outcome& {
    return *std::ranges::find_if(
        all, [&](const Outcome& o) { return o.task.eccentricity == e && o.task.name == name; });
  };
  const auto end = [&](double e, const std::string& name) { return of(e, name).drift.energy.back(); };
  const std::string division = "division", compensated = "division, compensated",
                    reciprocals = "rounded reciprocals, compensated", adaptive = "adaptive, tolerance 1e-17";
  const double scatter = show.quick() ? 0.45 : 0.25;  // larger scatter for a fit over one decade
  const auto exponent = [&](const std::string& what, double e, const std::string& name, double expected,
                            const char* reason) {
    show.between(fmt::format("exponent of the energy, {}, e = {:g}", what, e), of(e, name).energy_slope(),
                 expected - scatter, expected + scatter, reason);
  };
  const char* random_walk =
      "Brouwer's law; root mean squares of eight random walks scatter by a quarter, of four by a third";
  const char* line =
      "the same relative error in every step; at 100 orbits the random walk of rounding still contributes";
  for (const double e : {0.1, 0.7}) {
    exponent(division, e, division, 0.5, random_walk);
    exponent(compensated, e, compensated, 0.5, random_walk);
  }
  for (const double e : {0.1, 0.7}) exponent("reciprocals, compensated", e, reciprocals, 1, line);
  for (const double e : {0.1, 0.7}) exponent("adaptive", e, adaptive, 0.5, random_walk);

  struct Bound {
    double e;
    std::string method;
    double most;
    const char* recorded;
  };
  for (const auto& [e, method, most, recorded] : std::vector<Bound>{{0.1, division, 2e-13, "5e-14"},
                                                                    {0.1, compensated, 7e-14, "1.7e-14"},
                                                                    {0.7, division, 5e-13, "1.3e-13"},
                                                                    {0.7, compensated, 2e-13, "4.8e-14"}})
    show.at_most(fmt::format("energy error at the end, {}, e = {:g}", method, e), end(e, method), most,
                 fmt::format("regression value: {} after ten thousand orbits; walks scatter", recorded));
  show.at_most("position error at the end, division, compensated, e = 0.1",
               of(0.1, compensated).drift.position.back(), 5e-9,
               "regression value: 1.1e-9 after ten thousand orbits; walks scatter");
  show.between("energy error at the end, reciprocals, compensated, e = 0.1", end(0.1, reciprocals), 1e-14,
               2e-12, "regression value: 5.1e-13 after ten thousand orbits, in proportion to their number");
  show.between("reciprocals over division at the end, compensated, e = 0.1",
               end(0.1, reciprocals) / end(0.1, compensated), 3, 100,
               "regression value: 30 after ten thousand orbits, and a third of the exponent's gap before");
}

void put(const std::vector<Outcome>& all, scene::Show& show) {
  tabulate(all, show);
  draw(all, show);
  check(all, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result outcomes(
      "drift",
      "units a = 1, mu = 1; root mean square over 8 starts along the orbit, 4 with --quick, and for rounded "
      "reciprocals, whose drift is systematic and whose plain loops are slow, 2 at e = 0.1 and 1 at e = 0.7; "
      "states after whole orbits; fixed steps are rounded to 30 bits, so that times are exact",
      measure);
  return {{.name = "drift",
           .title = "Energy error over ten thousand orbits: effect of compensated sums and of divisions",
           .place = "our own, stability over ten thousand orbits",
           .content = scene::Content(put, outcomes)}};
}

}  // namespace nlmech::chapters::two_body_series::drift
