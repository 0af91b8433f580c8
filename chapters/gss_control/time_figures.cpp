#include <fmt/format.h>

#include <array>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/assumed_modes.hpp"
#include "nlmech/spacecraft/inverse_laplace.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::Complex;
using spacecraft::ExponentialSum;
using spacecraft::TimeResponse;

/// The four histories of a figure each.
enum class What : std::uint8_t { angle, rate, deflection, deflection_rate };
constexpr std::array whats = {What::angle, What::rate, What::deflection, What::deflection_rate};
constexpr std::array places = {2.0};

const ExponentialSum& of(const TimeResponse& r, What what) {
  switch (what) {
    case What::angle: return r.theta;
    case What::rate: return r.theta_dot;
    case What::deflection: return r.deflection.front();
    default: return r.deflection_dot.front();
  }
}

struct Named {
  const char *label, *plain, *unit;
};

Named name_of(What what) {
  switch (what) {
    case What::angle: return {"{/:Italic θ} (rad)", "hub angle", "rad"};
    case What::rate: return {"d{/:Italic θ}/d{/:Italic t} (rad/s)", "hub rate", "rad/s"};
    case What::deflection: return {"{/:Italic y}(2 ft) (ft)", "deflection at 2 ft", "ft"};
    default: return {"d{/:Italic y}/d{/:Italic t} at 2 ft (ft/s)", "deflection rate at 2 ft", "ft/s"};
  }
}

/// The transform of a history; `input` over s is the torque or the target angle.
Complex transform(const Complex& theta, const Complex& y, const Complex& s, What what) {
  switch (what) {
    case What::angle: return theta / s;
    case What::rate: return theta;
    case What::deflection: return y / s;
    default: return y;
  }
}

/// The largest distance of a residue sum from the Bromwich integral at some times and at its extremes.
template <class Transfer>
double distance(const ExponentialSum& sum, What what, const Transfer& transfer) {
  const spacecraft::Extremes e = extremes(sum, 0.3, 10);
  const std::array times = {1.0, 5.0, 10.0, e.least.time, e.largest.time};
  const auto inverted = spacecraft::bromwich(
      [&](const Complex& s) {
        const auto r = transfer(s);
        return transform(r.theta, r.deflection, s, what);
      },
      times);
  double worst = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    worst = std::max(worst, std::abs(inverted.at(i).value - sum.value(times.at(i))));
  return worst;
}

// ------------------------------------------------------------------------------ figures 3.9 to 3.12, torque

/// Ten assumed modes under a unit torque, in closed form.
double by_modes(const spacecraft::ModalModel& model, const Eigen::VectorXd& shapes, What what, double t) {
  const double j = model.total_inertia;
  double sum = what == What::angle ? t * t / (2 * j) : what == What::rate ? t / j : 0;
  for (Eigen::Index i = 0; i < model.omega.size(); ++i) {
    const double w = model.omega[i], b = model.participation[i];
    const bool hub = what == What::angle || what == What::rate;
    const bool rate = what == What::rate || what == What::deflection_rate;
    sum += (hub ? b * b : b * shapes[i]) * (rate ? std::sin(w * t) / w : (1 - std::cos(w * t)) / (w * w));
  }
  return sum;
}

scene::Showing step_figure(What what, const TimeResponse& response) {
  const spacecraft::Plant plant(craft(true));
  const auto model = diagonalise(spacecraft::assumed_modes(plant.parameters(), 10));
  const Eigen::VectorXd shapes = model.mode_shapes(places.front());
  const bool hub = what == What::angle || what == What::rate;
  Plot plot(hub ? "The hub turns as a rigid body would, and ripples a little"
                : "The appendages bend back and ring on: nothing damps them",
            "{/:Italic t} (s)");
  plot.panel(name_of(what).label);
  const double end = hub ? 10 : 5;
  const ExponentialSum& sum = of(response, what);
  plot.begin("exact", "l1");
  double difference = 0;
  for (const double t : equidistant(0, end, 1001)) {
    plot.add(t, sum.value(t));
    difference = std::max(difference, std::abs(sum.value(t) - by_modes(model, shapes, what, t)));
  }
  plot.begin("ten assumed modes", "l5");
  for (const double t : equidistant(0, end, 1001)) plot.add(t, by_modes(model, shapes, what, t));
  plot.x_range(0, end);
  const Named named = name_of(what);
  const double miss =
      distance(sum, what, [&](const Complex& s) { return plant.response(s, places.front()); });
  // Bounds of the Bromwich sum cut at 1.2e4 rad/s with its peaks a quarter from the path.
  const std::array bound = {1e-9, 1e-7, 1e-8, 1e-5};
  const std::array modal = {2e-5, 2e-4, 5e-4, 2e-2};
  const auto k = static_cast<std::size_t>(what);
  if (what == What::deflection) plot.y_range(-0.0125, 0.001);
  if (what == What::deflection_rate) plot.y_range(-0.06, 0.04);
  return {plot.with("key1", hub ? "top left" : "bottom right").take(),
          {},
          {scene::at_most("distance of the residue sum from the Bromwich integral", named.unit, miss,
                          bound.at(k), "aliasing e^(-30), and the integral's rest beyond 1.2e4 rad/s"),
           scene::at_most("largest difference of ten assumed modes", named.unit, difference, modal.at(k),
                          "their static deflection is right to 1e-3, their upper modes are not")}};
}

// ----------------------------------------------------------------------- figures 3.17 to 3.20, the manoeuvre

constexpr const char* residues =
    "residues at 61 poles, tools/oracles/gss_control_loop.py; a unit of its last digit";

/// An extreme known to a unit of its last digit.
scene::Quantity extreme(std::string name, std::string unit, double value, double reference, double digit) {
  return {std::move(name), std::move(unit), value, reference - digit, reference + digit, residues};
}

std::vector<scene::Quantity> promises(What what, const ExponentialSum& f) {
  const spacecraft::Extremes e = extremes(f, 0, 60);
  const auto settle = [&f](double final_value, double band) {
    return settling_time(f, final_value, band, 5000).time;
  };
  const double peak = std::max(std::abs(e.least.value), e.largest.value);
  // oracle: gss_control_loop designed largest *, designed least *, designed * settles*
  const auto time = [](std::string name, double value, double reference, double digit) {
    return extreme(std::move(name), "s", value, reference, digit);
  };
  switch (what) {
    case What::angle:
      return {extreme("largest angle", "rad", e.largest.value, 1.136136789, 1e-9),
              time("time of it", e.largest.time, 4.5081, 1e-4),
              time("settling time, 2 %", settle(1, 0.02), 7.1421, 1e-4)};
    case What::rate:
      return {extreme("largest rate", "rad/s", e.largest.value, 0.4757198, 1e-7),
              time("time of it", e.largest.time, 1.2153, 1e-4)};
    case What::deflection:
      return {extreme("least deflection", "ft", e.least.value, -0.08167668, 1e-8),
              time("time of it", e.least.time, 0.4316, 1e-4),
              extreme("largest deflection", "ft", e.largest.value, 0.0308833, 1e-7),
              time("time of the largest", e.largest.time, 1.9358, 1e-4),
              time("settling time, 2 % of the peak", settle(0, 0.02 * peak), 9.37, 1e-2)};
    default:
      return {extreme("largest deflection rate", "ft/s", e.largest.value, 0.3346, 1e-4),
              extreme("least deflection rate", "ft/s", e.least.value, -0.3026, 1e-4),
              time("settling time, 2 % of the peak", settle(0, 0.02 * peak), 88.5, 0.1),
              time("settling time, 5 % of the peak", settle(0, 0.05 * peak), 39.9, 0.1)};
  }
}

scene::Showing manoeuvre_figure(What what, const TimeResponse& response) {
  const char* heading = what == What::angle        ? "Designed gains: a turn of 1 rad, with 14 % overshoot"
                        : what == What::rate       ? "Designed gains: the hub's rate"
                        : what == What::deflection ? "Designed gains: the first mode dies out in ten seconds"
                                                   : "Designed gains: the second mode rings for minutes";
  Plot plot(heading, "{/:Italic t} (s)");
  plot.panel(name_of(what).label);
  const double end = what == What::deflection_rate ? 20 : 15;
  plot.x_range(0, end);
  const ExponentialSum& sum = of(response, what);
  plot.begin("", "l1");
  for (const double t : equidistant(0, end, 1501)) plot.add(t, sum.value(t));
  plot.begin("", "t13");
  for (const double t : {0.0, end}) plot.add(t, what == What::angle ? 1 : 0);
  std::vector<scene::Quantity> quantities = promises(what, sum);
  const spacecraft::ClosedLoop loop(craft(true), designed_gains);
  const double miss = distance(sum, what, [&](const Complex& s) { return loop.response(s, places.front()); });
  const std::array bound = {1e-12, 1e-7, 1e-8, 2e-5};
  quantities.push_back(scene::at_most("distance of the residue sum from the Bromwich integral",
                                      name_of(what).unit, miss, bound.at(static_cast<std::size_t>(what)),
                                      "aliasing e^(-30), and the integral's rest beyond 1.2e4 rad/s"));
  return {plot.take(), {}, quantities};
}

// ------------------------------------------------------------------------------ both sets of gains, in
// figures

scene::Showing manoeuvres(const TimeResponse& designed, const TimeResponse& unit) {
  scene::Table table({{"gains"},
                      {"history"},
                      {"least", 10},
                      {"at (s)", 5},
                      {"largest", 10},
                      {"at (s) ", 5},
                      {"settled to 2 % (s)", 6}});
  std::vector<scene::Quantity> quantities;
  for (const bool by_design : {true, false}) {
    const TimeResponse& r = by_design ? designed : unit;
    const char* name = by_design ? "designed" : "unit";
    for (const What what : whats) {
      const ExponentialSum& f = of(r, what);
      const spacecraft::Extremes e = extremes(f, 0, by_design ? 60 : 200);
      const double peak = std::max(std::abs(e.least.value), std::abs(e.largest.value));
      const double target = what == What::angle ? 1 : 0;
      const auto settled = settling_time(f, target, 0.02 * (what == What::angle ? 1 : peak), 5000);
      table.add({name, name_of(what).plain, e.least.value, e.least.time, e.largest.value, e.largest.time,
                 settled.status.ok() ? scene::Cell{settled.time} : scene::Cell{"not in 5000 s"}});
      if (by_design) continue;
      // oracle: gss_control_loop unit largest angle, unit largest rate, unit largest deflection, unit least
      // *, unit angle settles
      if (what == What::angle) {
        quantities.push_back(extreme("largest angle, unit gains", "rad", e.largest.value, 1.720435430, 1e-9));
        quantities.push_back(scene::near("settling time of the angle, unit gains", "s", settled.time, 170.95,
                                         1e-4, "residues, tools/oracles/gss_control_loop.py, five digits"));
      } else if (what == What::rate) {
        quantities.push_back(extreme("largest rate, unit gains", "rad/s", e.largest.value, 0.1858306, 1e-7));
        quantities.push_back(extreme("least rate, unit gains", "rad/s", e.least.value, -0.1328028, 1e-7));
      } else if (what == What::deflection) {
        quantities.push_back(extreme("least deflection, unit gains", "ft", e.least.value, -0.00728217, 1e-8));
        quantities.push_back(
            extreme("largest deflection, unit gains", "ft", e.largest.value, 0.00495919, 1e-8));
      }
    }
  }
  return {{}, table, quantities};
}

using ResponseRun = scene::Run<TimeResponse>;

const ResponseRun& add_loop_run(scene::Chapter& chapter, const std::string& name,
                                const spacecraft::Gains& gains) {
  return chapter.add_run<TimeResponse>(
      name,
      fmt::format("from rest to theta_f = 1 rad (the text gives none), k1, k2, k3 = {}, {}, {}; residues",
                  gains.k1, gains.k2, gains.k3),
      {}, [gains](Workshop&) {
        TimeResponse r = step_response(spacecraft::ClosedLoop(craft(true), gains), 1, places);
        if (!r.status.ok()) throw Failure(r.status);
        return r;
      });
}

}  // namespace

void add_step_figures(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<TimeResponse>(
      "torque-step", "unit torque from t = 0, from rest; residues over the exact poles", {}, [](Workshop&) {
        TimeResponse r = torque_response(spacecraft::Plant(craft(true)), 1, places);
        if (!r.status.ok()) throw Failure(r.status);
        return r;
      });
  const std::array names = {"fig-3.9", "fig-3.10", "fig-3.11", "fig-3.12"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const What what = whats.at(i);
    chapter.add({.name = names.at(i),
                 .title = fmt::format("Unit torque: {}", name_of(what).plain),
                 .place = std::string("Figure ") + (names.at(i) + 4),
                 .needs = {&run},
                 .show = [what, &run](Workshop& w) { return step_figure(what, w.result(run)); }});
  }
}

void add_manoeuvre_figures(scene::Chapter& chapter) {
  const auto& designed = add_loop_run(chapter, "manoeuvre-designed", designed_gains);
  const auto& unit = add_loop_run(chapter, "manoeuvre-unit", unit_gains);
  const std::array names = {"fig-3.17", "fig-3.18", "fig-3.19", "fig-3.20"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const What what = whats.at(i);
    chapter.add(
        {.name = names.at(i),
         .title = fmt::format("Designed gains, theta_f = 1 rad: {}", name_of(what).plain),
         .place = std::string("Figure ") + (names.at(i) + 4),
         .needs = {&designed},
         .show = [what, &designed](Workshop& w) { return manoeuvre_figure(what, w.result(designed)); }});
  }
  chapter.add(
      {.name = "manoeuvres",
       .title = "Peaks and settling times with designed and unit gains",
       .place = "our own",
       .needs = {&designed, &unit},
       .show = [&designed, &unit](Workshop& w) { return manoeuvres(w.result(designed), w.result(unit)); }});
}

}  // namespace nlmech::chapters
