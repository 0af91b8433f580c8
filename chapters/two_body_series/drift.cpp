#include "chapters/two_body_series/drift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/two_body_series/ellipses.hpp"
#include "chapters/two_body_series/scenes.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using Wide = orbit::BasicState<long double>;

Wide widened(const orbit::State& s) {
  return {s.position.cast<long double>(), s.velocity.cast<long double>()};
}

/// 10, 18, 32, 56, 100, ... and the last.
std::vector<int> checkpoints(int orbits) {
  std::vector<int> all;
  for (int i = 4; std::pow(10, i / 4.0) < 0.99 * orbits; ++i)
    all.push_back(static_cast<int>(std::lround(std::pow(10, i / 4.0))));
  all.push_back(orbits);
  return all;
}

/// Squares of the errors of one start, added up.
class Track {
 public:
  Track(const orbit::State& start, Drift& sums)
      : start_(widened(start)), energy_(orbit::energy(start_, 1.0L)), sums_(sums) {}

  /// When the next checkpoint is, in orbits; none left: false.
  [[nodiscard]] bool waits() const { return next_ < sums_.orbits.size(); }
  [[nodiscard]] int orbits() const { return sums_.orbits[next_]; }
  /// The state at a checkpoint.
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

/// The step of a share of an orbit, rounded to 30 bits so that multiples of it are exact.
double step_of(int steps) { return std::round(revolution / steps * 0x1p30) * 0x1p-30; }

Status run_fixed(const DriftTask& task, const orbit::State& start, Track& track, int orbits) {
  const double step = step_of(task.steps);
  const orbit::FixedContinuation method{.step = step,
                                        .order = task.order,
                                        .compensated = task.compensated,
                                        .true_division = task.true_division};
  const auto observe = [&](const orbit::ContinuationStep& s) {
    if (track.waits() && s.index == std::int64_t{task.steps} * track.orbits()) track.add(s.t1, s.state1);
    return true;
  };
  return orbit::propagate(start, 0, step * task.steps * orbits, orbit::Gravity{}, method, observe).status;
}

Status run_adaptive(const DriftTask& task, const orbit::State& start, Track& track, int orbits) {
  const orbit::AnalyticContinuation method{.tolerance = task.tolerance, .compensated = task.compensated};
  const auto observe = [&](const orbit::ContinuationStep& s) {
    while (track.waits() && s.t1 >= revolution * track.orbits()) {
      const double t = revolution * track.orbits();
      track.add(t, s.arc.at(t));
    }
    return true;
  };
  return orbit::propagate(start, 0, revolution * orbits, orbit::Gravity{}, method, observe).status;
}

}  // namespace

double Drift::slope(const std::vector<int>& orbits, const std::vector<double>& errors) {
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

Drift drift(const DriftTask& task, int orbits) {
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

namespace {

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

struct Measured {
  std::vector<DriftTask> tasks;
  std::vector<Drift> drifts;

  [[nodiscard]] const Drift& of(double e, const std::string& name) const {
    std::size_t i = 0;
    while (tasks[i].eccentricity != e || tasks[i].name != name) ++i;
    return drifts[i];
  }
};

Measured measure(bool quick) {
  Measured m{tasks(), {}};
  for (DriftTask& task : m.tasks) {
    if (quick) task.phases = std::min(task.phases, 4);
    m.drifts.push_back(drift(task, quick ? 1000 : 10'000));
  }
  return m;
}

scene::Table table_of(const Measured& m) {
  scene::Table table({{"e"},
                      {"method"},
                      {"order"},
                      {"steps an orbit"},
                      {"starts"},
                      {"energy error, 100 orbits", 2},
                      {"energy error, all orbits", 2},
                      {"exponent", 2},
                      {"position error over a, all orbits", 2},
                      {"exponent of position", 2}});
  for (std::size_t i = 0; i < m.tasks.size(); ++i) {
    const DriftTask& t = m.tasks[i];
    const Drift& d = m.drifts[i];
    const bool fixed = t.order > 0;
    table.add({t.eccentricity, t.name, fixed ? scene::Cell(std::int64_t{t.order}) : scene::Cell("chosen"),
               fixed ? scene::Cell(std::int64_t{t.steps}) : scene::Cell("chosen"), std::int64_t{t.phases},
               d.energy[4], d.energy.back(), Drift::slope(d.orbits, d.energy), d.position.back(),
               Drift::slope(d.orbits, d.position)});
  }
  return table;
}

scene::Table data_of(const Measured& m) {
  scene::Table data({{"line", 3, true}, {"e"}, {"method"}, {"orbits"}, {"energy_error"}, {"position_error"}});
  for (std::size_t i = 0; i < m.tasks.size(); ++i) {
    const Drift& d = m.drifts[i];
    for (std::size_t k = 0; k < d.orbits.size(); ++k) {
      data.add({static_cast<std::int64_t>(i), m.tasks[i].eccentricity, m.tasks[i].name,
                std::int64_t{d.orbits[k]}, d.energy[k], d.position[k]});
    }
  }
  return data;
}

scene::Showing show(const Measured& m, bool quick) {
  scene::Showing showing;
  showing.table = table_of(m);
  showing.figure = {
      data_of(m),
      "two_body_series-drift",
      {{"width", "1000"},
       {"height", "500"},
       {"heading", "Rounded reciprocals drift in proportion to time, divisions like its root"}}};
  const auto slope = [&](double e, const std::string& name) {
    const Drift& d = m.of(e, name);
    return Drift::slope(d.orbits, d.energy);
  };
  // A decade says less than two.
  const double scatter = quick ? 0.45 : 0.25;
  const char* walk =
      "Brouwer's law; root mean squares of eight walks scatter by a quarter, of four by a third";
  const char* line = "the same share in every step; the walk of rounding is still felt at 100 orbits";
  const auto end = [&](double e, const std::string& name) { return m.of(e, name).energy.back(); };
  const std::string division = "division", compensated = "division, compensated",
                    reciprocals = "rounded reciprocals, compensated", adaptive = "adaptive, tolerance 1e-17";
  showing.quantities = {
      {"exponent of the energy, division, e = 0.1", "1", slope(0.1, division), 0.5 - scatter, 0.5 + scatter,
       walk},
      {"exponent of the energy, division, compensated, e = 0.1", "1", slope(0.1, compensated), 0.5 - scatter,
       0.5 + scatter, walk},
      {"exponent of the energy, division, e = 0.7", "1", slope(0.7, division), 0.5 - scatter, 0.5 + scatter,
       walk},
      {"exponent of the energy, division, compensated, e = 0.7", "1", slope(0.7, compensated), 0.5 - scatter,
       0.5 + scatter, walk},
      {"exponent of the energy, reciprocals, compensated, e = 0.1", "1", slope(0.1, reciprocals), 1 - scatter,
       1 + scatter, line},
      {"exponent of the energy, reciprocals, compensated, e = 0.7", "1", slope(0.7, reciprocals), 1 - scatter,
       1 + scatter, line},
      {"exponent of the energy, adaptive, e = 0.1", "1", slope(0.1, adaptive), 0.5 - scatter, 0.5 + scatter,
       walk},
      {"exponent of the energy, adaptive, e = 0.7", "1", slope(0.7, adaptive), 0.5 - scatter, 0.5 + scatter,
       walk},
      scene::at_most("energy error at the end, division, e = 0.1", "1", end(0.1, division), 2e-13,
                     "recorded: 5e-14 after ten thousand orbits; walks scatter"),
      scene::at_most("energy error at the end, division, compensated, e = 0.1", "1", end(0.1, compensated),
                     7e-14, "recorded: 1.7e-14 after ten thousand orbits; walks scatter"),
      scene::at_most("energy error at the end, division, e = 0.7", "1", end(0.7, division), 5e-13,
                     "recorded: 1.3e-13 after ten thousand orbits; walks scatter"),
      scene::at_most("energy error at the end, division, compensated, e = 0.7", "1", end(0.7, compensated),
                     2e-13, "recorded: 4.8e-14 after ten thousand orbits; walks scatter"),
      scene::at_most("position error at the end, division, compensated, e = 0.1", "1",
                     m.of(0.1, compensated).position.back(), 5e-9,
                     "recorded: 1.1e-9 after ten thousand orbits; walks scatter"),
      {"energy error at the end, reciprocals, compensated, e = 0.1", "1", end(0.1, reciprocals), 1e-14, 2e-12,
       "recorded: 5.1e-13 after ten thousand orbits, in proportion to their number"}};
  showing.quantities.push_back(
      {"reciprocals over division at the end, compensated, e = 0.1", "1",
       end(0.1, reciprocals) / end(0.1, compensated), 3, 100,
       "recorded: 30 after ten thousand orbits, and a third of the exponent's gap before"});
  return showing;
}

}  // namespace

void add_drift(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Measured>(
      "drift",
      "units a = 1, mu = 1; root mean square over 8 starts along the orbit, 4 with --quick, and for rounded "
      "reciprocals, "
      "whose drift is systematic and whose plain loops are slow, 2 at e = 0.1 and 1 at e = 0.7; states after "
      "whole orbits; fixed steps are rounded to 30 bits, so that times are exact",
      {}, [](Workshop& w) { return measure(w.quick()); });
  chapter.add({.name = "drift",
               .title = "Energy over ten thousand orbits: what compensation and divisions are worth",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run), w.quick()); }});
}

}  // namespace nlmech::chapters
