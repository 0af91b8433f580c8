#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "chapters/gss_control/control/histories.hpp"
#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control::manoeuvres {
namespace {

using spacecraft::ExponentialSum;
using spacecraft::Extremes;
using spacecraft::TimeResponse;

/// Checks a value against a reference with an error of one unit of its last digit.
void known(scene::Show& show, const std::string& name, const scene::Amount& value, double reference,
           double digit) {
  show.between(name, value, reference - digit, reference + digit,
               "residues at 61 poles, tools/oracles/gss_control_loop.py; a unit of its last digit");
}

double settled(const ExponentialSum& f, double end, double band) {
  return settling_time(f, end, band, 5000).time;
}

// oracle: gss_control_loop designed largest angle*, designed angle settles
void check_angle(const ExponentialSum& f, const Extremes& e, scene::Show& show) {
  known(show, "largest angle", {e.largest.value, "rad"}, 1.136136789, 1e-9);
  known(show, "time of it", {e.largest.time, "s"}, 4.5081, 1e-4);
  known(show, "settling time, 2 %", {settled(f, 1, 0.02), "s"}, 7.1421, 1e-4);
}

// oracle: gss_control_loop designed largest rate*
void check_rate(const ExponentialSum& /*f*/, const Extremes& e, scene::Show& show) {
  known(show, "largest rate", {e.largest.value, "rad/s"}, 0.4757198, 1e-7);
  known(show, "time of it", {e.largest.time, "s"}, 1.2153, 1e-4);
}

double peak(const Extremes& e) { return std::max(std::abs(e.least.value), std::abs(e.largest.value)); }

// oracle: gss_control_loop designed least deflection, designed least deflection at, designed largest
// deflection, designed largest deflection at, designed deflection settles
void check_deflection(const ExponentialSum& f, const Extremes& e, scene::Show& show) {
  known(show, "least deflection", {e.least.value, "ft"}, -0.08167668, 1e-8);
  known(show, "time of it", {e.least.time, "s"}, 0.4316, 1e-4);
  known(show, "largest deflection", {e.largest.value, "ft"}, 0.0308833, 1e-7);
  known(show, "time of the largest", {e.largest.time, "s"}, 1.9358, 1e-4);
  known(show, "settling time, 2 % of the peak", {settled(f, 0, 0.02 * peak(e)), "s"}, 9.37, 1e-2);
}

// oracle: gss_control_loop designed largest deflection rate, designed least deflection rate, designed
// deflection rate settles*
void check_deflection_rate(const ExponentialSum& f, const Extremes& e, scene::Show& show) {
  known(show, "largest deflection rate", {e.largest.value, "ft/s"}, 0.3346, 1e-4);
  known(show, "least deflection rate", {e.least.value, "ft/s"}, -0.3026, 1e-4);
  known(show, "settling time, 2 % of the peak", {settled(f, 0, 0.02 * peak(e)), "s"}, 88.5, 0.1);
  known(show, "settling time, 5 % of the peak", {settled(f, 0, 0.05 * peak(e)), "s"}, 39.9, 0.1);
}

/// Figure: history, checks, and bound of the difference from the Bromwich integral.
struct Figure {
  const char* name;
  History history;
  const char* heading;
  double target, end;
  void (*check)(const ExponentialSum&, const Extremes&, scene::Show&);
  double bound;
};
constexpr std::array figures = {
    Figure{"fig-3.17", hub_angle, "Designed gains: hub angle with 14 % overshoot", 1, 15, check_angle, 1e-12},
    Figure{"fig-3.18", hub_rate, "Designed gains: hub rate", 0, 15, check_rate, 1e-7},
    Figure{"fig-3.19", deflection, "Designed gains: the first mode of the deflection decays in ten seconds",
           0, 15, check_deflection, 1e-8},
    Figure{"fig-3.20", deflection_rate,
           "Designed gains: the second mode of the deflection decays over minutes", 0, 20,
           check_deflection_rate, 2e-5}};

void put_figure(const Figure& f, const TimeResponse& response, scene::Show& show) {
  const ExponentialSum& sum = f.history.of(response);
  scene::Panel& panel = show.plot(f.heading, "{/:Italic t} (s)", f.history.label);
  panel.x_range(0, f.end);
  show.figure().columns({"curve", "panel", "x", "y"});
  panel.curve("", equidistant(0, f.end, 1501), std::identity(), [&](double t) { return sum.value(t); });
  panel.curve("", {0, f.end}, {f.target, f.target}, scene::thin_lines(13));
  f.check(sum, extremes(sum, 0, 60), show);
  const spacecraft::ClosedLoop loop(craft(true), designed_gains);
  show.at_most("distance of the residue sum from the Bromwich integral",
               {distance_from_inversion(sum, f.history, loop), f.history.unit}, f.bound,
               "aliasing e^(-30), and the integral's rest beyond 1.2e4 rad/s");
}

/// Row of the table: a history with a set of gains.
struct Row {
  const char *gains, *history;
  Extremes extremes;
  spacecraft::Settling settling;

  [[nodiscard]] scene::Cell settled() const {
    return settling.status.ok() ? scene::Cell(settling.time) : scene::Cell("not in 5000 s");
  }
};

std::vector<Row> rows_of(const char* gains, const TimeResponse& r, double end) {
  std::vector<Row> rows;
  for (const Figure& f : figures) {
    const ExponentialSum& sum = f.history.of(r);
    const Extremes e = extremes(sum, 0, end);
    const double band = 0.02 * (f.target == 1 ? 1 : peak(e));
    rows.push_back({gains, f.history.name, e, settling_time(sum, f.target, band, 5000)});
  }
  return rows;
}

// oracle: gss_control_loop unit largest angle*, unit largest rate, unit largest deflection, unit least
// *, unit angle settles
void put_both(const TimeResponse& designed, const TimeResponse& unit, scene::Show& show) {
  std::vector<Row> rows = rows_of("designed", designed, 60);
  const std::vector<Row> by_unit = rows_of("unit", unit, 200);
  rows.insert(rows.end(), by_unit.begin(), by_unit.end());
  show.table(rows, {{"gains", &Row::gains},
                    {"history", &Row::history},
                    {"least", [](const Row& r) { return r.extremes.least.value; }, 10},
                    {"at (s)", [](const Row& r) { return r.extremes.least.time; }, 5},
                    {"largest", [](const Row& r) { return r.extremes.largest.value; }, 10},
                    {"at (s) ", [](const Row& r) { return r.extremes.largest.time; }, 5},
                    {"settled to 2 % (s)", &Row::settled, 6}});
  const Extremes &rate = by_unit[1].extremes, &bend = by_unit[2].extremes;
  known(show, "largest angle, unit gains", {by_unit[0].extremes.largest.value, "rad"}, 1.720435430, 1e-9);
  known(show, "time of the largest angle, unit gains", {by_unit[0].extremes.largest.time, "s"}, 15.2, 0.05);
  show.near("settling time of the angle, unit gains", {by_unit[0].settling.time, "s"}, 170.95, 1e-4,
            "residues, tools/oracles/gss_control_loop.py, five digits");
  known(show, "largest rate, unit gains", {rate.largest.value, "rad/s"}, 0.1858306, 1e-7);
  known(show, "least rate, unit gains", {rate.least.value, "rad/s"}, -0.1328028, 1e-7);
  known(show, "least deflection, unit gains", {bend.least.value, "ft"}, -0.00728217, 1e-8);
  known(show, "largest deflection, unit gains", {bend.largest.value, "ft"}, 0.00495919, 1e-8);
}

scene::Result<TimeResponse> manoeuvre(const std::string& name, const spacecraft::Gains& gains) {
  return {name,
          fmt::format("from rest to theta_f = 1 rad (the text gives none), k1, k2, k3 = {}, {}, {}; residues",
                      gains.k1, gains.k2, gains.k3),
          [gains] {
            TimeResponse r = step_response(spacecraft::ClosedLoop(craft(true), gains), 1, places);
            if (!r.status.ok()) throw Failure(r.status);
            return r;
          }};
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const auto designed = manoeuvre("manoeuvre-designed", designed_gains),
             unit = manoeuvre("manoeuvre-unit", unit_gains);
  std::vector<scene::Scene> all;
  for (const Figure& f : figures)
    all.push_back({.name = f.name,
                   .title = fmt::format("Designed gains, theta_f = 1 rad: {}", f.history.name),
                   .place = std::string("Figure ") + (f.name + 4),
                   .content = scene::Content([f](const TimeResponse& response,
                                                 scene::Show& show) { put_figure(f, response, show); },
                                             designed)});
  all.push_back({.name = "manoeuvres",
                 .title = "Peaks and settling times with designed and unit gains",
                 .content = scene::Content(put_both, designed, unit)});
  return all;
}

}  // namespace nlmech::chapters::gss_control::manoeuvres
