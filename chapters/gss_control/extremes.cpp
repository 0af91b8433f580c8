#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "chapters/gss_control/plant/extended.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::chapters::gss_control::extremes {
namespace {

using spacecraft::Complex;
using spacecraft::ExponentialSum;
using spacecraft::Gains;
using spacecraft::Parameters;

/// Spacecraft and gains at the limits of the parameter range.
struct Extreme {
  std::string name;
  Parameters craft;
  Gains gains = designed_gains;
};

Parameters with(double Parameters::*field, double value) {
  Parameters p = craft(true);
  p.*field = value;
  return p;
}

Parameters stiffer(double factor) {
  return with(&Parameters::second_moment, factor * craft(true).second_moment);
}

std::vector<Extreme> spacecraft_at_the_end() {
  return {{"Table 3.1, designed gains", craft(true)},
          {"no tip", craft(false)},
          {"tip mass 1e-12 slug", with(&Parameters::tip_mass, 1e-12)},
          {"tip mass 1e6 slug", with(&Parameters::tip_mass, 1e6)},
          {"tip inertia 1e6 slug ft^2", with(&Parameters::tip_inertia, 1e6)},
          {"hub inertia 1e-12 slug ft^2", with(&Parameters::hub_inertia, 1e-12)},
          {"no hub inertia", with(&Parameters::hub_inertia, 0)},
          {"hub inertia 1e-5 slug ft^2", with(&Parameters::hub_inertia, 1e-5)},
          {"hub inertia 1e12 slug ft^2", with(&Parameters::hub_inertia, 1e12)},
          {"appendage of 0.01 ft", with(&Parameters::length, 0.01)},
          {"appendage of 1000 ft", with(&Parameters::length, 1000)},
          {"hub radius 0", with(&Parameters::hub_radius, 0)},
          {"hub radius 1e6 ft", with(&Parameters::hub_radius, 1e6)},
          {"second moment 1e-16 ft^4", with(&Parameters::second_moment, 1e-16)},
          {"beams 1e-6 times as stiff", stiffer(1e-6)},
          {"beams 1e6 times as stiff", stiffer(1e6)},
          {"beams 1e12 times as stiff", stiffer(1e12)}};
}

std::vector<Extreme> gains_at_the_end() {
  const Parameters p = craft(true);
  return {{"k1 = 1e-9", p, {1e-9, 0, 16}},
          {"k1 = 1e9", p, {1e9, 0, 16}},
          {"k3 = 1e-6", p, {12, 0, 1e-6}},
          {"k3 = 1e6", p, {12, 0, 1e6}},
          {"k2 = -2 + 1e-3", p, {12, -2 + 1e-3, 16}},
          {"k2 = -2 + 1e-9", p, {12, -2 + 1e-9, 16}},
          {"k2 = 1e3", p, {12, 1e3, 16}},
          {"k2 = 1e9", p, {12, 1e9, 16}},
          {"unit gains, beams 1e6 times as stiff", stiffer(1e6), unit_gains}};
}

/// Largest relative error of theta/u, y(L/2)/u and y(L)/u, divided by max(1, |omega G'/G|).
double worst_error(const Parameters& p, int samples) {
  const spacecraft::Plant plant(p);
  double worst = 0;
  for (const double omega : logarithmic(1e-8, 1e8, samples)) {
    const Extended exact = extended_response(p, omega);
    const auto middle = plant.at_frequency(omega, p.length / 2), tip = plant.at_frequency(omega, p.length);
    const std::array<double, 3> computed = {middle.theta, middle.deflection, tip.deflection};
    for (std::size_t i = 0; i < computed.size(); ++i) {
      const double error =
          std::abs(computed.at(i) / exact.value.at(i) - 1) / std::max(1., exact.condition.at(i));
      worst = std::max(worst, std::isfinite(error) ? error : 1.);
    }
  }
  return worst;
}

/// Row of the table: open loop (only where the spacecraft differs), and slew by 1 rad.
struct Row {
  std::string name;
  scene::Cell first = {}, fifth = {}, error = {};
  std::string status = {};
  scene::Cell poles = {}, angle = {}, rate = {};
};

/// Largest errors and counts over all rows.
struct Worst {
  double error = 0, angle = 0, rate = 0;  ///< as in the rows; the angle error relative to 1e-9 and rounding
  int counted = 0, found = 0;             ///< number of spacecraft with five poles; number of time responses
};

void open_loop(const Parameters& p, int samples, Row& row, Worst& worst) {
  const spacecraft::Frequencies poles = spacecraft::poles(spacecraft::Plant(p), 5);
  if (poles.status.ok()) {
    row.first = poles.omega.front();
    row.fifth = poles.omega.back();
    ++worst.counted;
  }
  const double error = worst_error(p, samples);
  row.error = error;
  worst.error = std::max(worst.error, error);
}

void turn(const Extreme& e, Row& row, Worst& worst) {
  const auto r = spacecraft::step_response(spacecraft::ClosedLoop(e.craft, e.gains), 1, {});
  row.status = to_string(r.status.outcome());
  if (!r.status.ok()) return;
  ++worst.found;
  row.poles = r.theta.poles().size();
  const auto costs = spacecraft::step_costs(e.craft, e.gains, 0);
  const auto miss = [](const spacecraft::SquareIntegral& found, double known) {
    return std::abs(found.value / known - 1);
  };
  const auto error = square_integral(ExponentialSum({}, r.theta.poles(), r.theta.weights()));
  const double angle = miss(error, costs.error), rate = miss(square_integral(r.theta_dot), costs.rate);
  row.angle = angle;
  row.rate = rate;
  worst.angle = std::max(worst.angle, angle / (1e-9 + error.uncertainty / costs.error));
  worst.rate = std::max(worst.rate, rate);
}

void put(scene::Show& show) {
  std::vector<Row> rows;
  Worst worst;
  const std::vector<Extreme> crafts = spacecraft_at_the_end(), loops = gains_at_the_end();
  for (const Extreme& e : crafts) {
    rows.push_back({.name = e.name});
    open_loop(e.craft, show.quick() ? 17 : 49, rows.back(), worst);
    turn(e, rows.back(), worst);
  }
  for (const Extreme& e : loops) {
    rows.push_back({.name = e.name});
    turn(e, rows.back(), worst);
  }
  show.table(rows, {{"spacecraft or gains", &Row::name},
                    {"first pole (rad/s)", &Row::first, 13},
                    {"fifth pole (rad/s)", &Row::fifth, 13},
                    {"largest error over its condition", &Row::error, 2},
                    {"closed loop", &Row::status},
                    {"poles summed", &Row::poles},
                    {"int e^2, relative miss", &Row::angle, 2},
                    {"int theta'^2, relative miss", &Row::rate, 2}});
  show.at_most("largest error of theta/u and y/u over max(1, condition), all spacecraft", worst.error, 1e-12,
               "against 100 digits, 1e-8 to 1e8 rad/s");
  show.equals("spacecraft all of whose first five poles are counted and found", worst.counted,
              static_cast<double>(crafts.size()), "the argument principle says that none is missing");
  // At a pole the value is infinite or not reliable.
  const spacecraft::Plant plant(craft(true));
  const auto there = plant.response(Complex(0, spacecraft::poles(plant, 1).omega.front()), 2);
  show.equals("a pole is reported or its value is beyond 1e8",
              there.outcome == Outcome::at_pole || std::abs(there.theta) > 1e8, 1,
              "at s = j omega of the first pole, rounded to double");
  show.equals("stable loops whose motion is found", worst.found,
              static_cast<double>(crafts.size() + loops.size() - 1),
              "all but one: beside an appendage of 1000 ft the hub is too light for 800 poles, which the "
              "status reports");
  show.at_most("largest miss of int theta'^2, relative", worst.rate, 1e-9,
               "k1/(2 k3) by Parseval's theorem; sums leave out 1e-9 of their largest terms");
  show.at_most("largest miss of int e^2, over 1e-9 and rounding", worst.angle, 1,
               "the closed form; a decay is known to 8 eps of the pole's modulus");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "extremes",
           .title = "Extreme spacecraft and gains: errors against 100 digits, motions against closed forms",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::extremes
