#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/extended.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/poles.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::Complex;
using spacecraft::Parameters;

/// A spacecraft at the end of what can be.
struct Extreme {
  std::string name;
  Parameters craft;
};

Parameters changed(double Parameters::*field, double value) {
  Parameters p = craft(true);
  p.*field = value;
  return p;
}

std::vector<Extreme> extremes() {
  return {{"Table 3.1", craft(true)},
          {"no tip", craft(false)},
          {"tip mass 1e-12 slug", changed(&Parameters::tip_mass, 1e-12)},
          {"tip mass 1e6 slug", changed(&Parameters::tip_mass, 1e6)},
          {"tip inertia 1e6 slug ft^2", changed(&Parameters::tip_inertia, 1e6)},
          {"hub inertia 1e-12 slug ft^2", changed(&Parameters::hub_inertia, 1e-12)},
          {"no hub inertia", changed(&Parameters::hub_inertia, 0)},
          {"hub inertia 1e12 slug ft^2", changed(&Parameters::hub_inertia, 1e12)},
          {"appendage of 0.01 ft", changed(&Parameters::length, 0.01)},
          {"appendage of 1000 ft", changed(&Parameters::length, 1000)},
          {"hub radius 0", changed(&Parameters::hub_radius, 0)},
          {"hub radius 1e6 ft", changed(&Parameters::hub_radius, 1e6)},
          {"second moment 1e-16 ft^4", changed(&Parameters::second_moment, 1e-16)}};
}

/// The largest error over max(1, |omega G'/G|), of theta/u, y(L/2)/u and y(L)/u.
double worst_error(const Parameters& p, int samples) {
  const spacecraft::Plant plant(p);
  double worst = 0;
  for (const double omega : logarithmic(1e-8, 1e8, samples)) {
    const Extended exact = extended_response(p, omega);
    const auto middle = plant.at_frequency(omega, p.length / 2), tip = plant.at_frequency(omega, p.length);
    const std::array<double, 3> ours = {middle.theta, middle.deflection, tip.deflection};
    for (std::size_t i = 0; i < ours.size(); ++i) {
      const double error = std::abs(ours.at(i) / exact.value.at(i) - 1) / std::max(1., exact.condition.at(i));
      worst = std::max(worst, std::isfinite(error) ? error : 1.);
    }
  }
  return worst;
}

scene::Showing show(bool quick) {
  scene::Table table({{"spacecraft"},
                      {"first pole (rad/s)", 13},
                      {"fifth pole (rad/s)", 13},
                      {"poles found of 5"},
                      {"largest error over its condition", 2}});
  double worst = 0, found = 0;
  const std::vector<Extreme> all = extremes();
  for (const Extreme& e : all) {
    const auto poles = spacecraft::poles(spacecraft::Plant(e.craft), 5);
    const double error = worst_error(e.craft, quick ? 17 : 49);
    worst = std::max(worst, error);
    found += poles.status.ok() ? 1 : 0;
    const bool some = !poles.omega.empty();
    table.add({e.name, some ? scene::Cell{poles.omega.front()} : scene::Cell{poles.status.text()},
               some ? scene::Cell{poles.omega.back()} : scene::Cell{},
               static_cast<std::int64_t>(poles.omega.size()), error});
  }
  // On a pole there is no value.
  const spacecraft::Plant plant(craft(true));
  const auto poles = spacecraft::poles(plant, 1);
  const bool said = plant.response(Complex(0, poles.omega.front()), 2).outcome == Outcome::at_pole ||
                    std::abs(plant.response(Complex(0, poles.omega.front()), 2).theta) > 1e8;
  const auto refused = spacecraft::stability({12, -2, 16});
  return {
      {},
      table,
      {scene::at_most("largest error of theta/u and y/u over max(1, condition), all spacecraft", "1", worst,
                      1e-12, "against 100 digits, 1e-8 to 1e8 rad/s"),
       scene::near("spacecraft all of whose first five poles are counted and found", "1", found,
                   static_cast<double>(all.size()), 0, "the argument principle says that none is missing"),
       scene::near("a pole is said or its value is beyond 1e8", "1", said ? 1 : 0, 1, 0,
                   "at s = j omega of the first pole, rounded to double"),
       scene::near("k2 = -2 is called marginal", "1",
                   refused.verdict == spacecraft::Stability::marginal ? 1 : 0, 1, 0,
                   "the hub does not feel the appendages, which ring on undamped")}};
}

}  // namespace

void add_extremes(scene::Chapter& chapter) {
  chapter.add({.name = "extremes",
               .title = "Extreme spacecraft: poles, and errors against 100 digits",
               .place = "our own",
               .needs = {},
               .show = [](Workshop& w) { return show(w.quick()); }});
}

}  // namespace nlmech::chapters
