#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "chapters/gss_control/plant/extended.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"

namespace nlmech::chapters::gss_control::extremes {
namespace {

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

std::vector<Extreme> extreme_craft() {
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

/// What became of a spacecraft.
struct Trial {
  std::string name;
  spacecraft::Frequencies poles;  ///< five were asked for
  double error;                   ///< over its condition

  [[nodiscard]] scene::Cell first() const {
    return poles.omega.empty() ? scene::Cell(poles.status.text()) : scene::Cell(poles.omega.front());
  }
  [[nodiscard]] scene::Cell fifth() const {
    return poles.omega.empty() ? scene::Cell() : scene::Cell(poles.omega.back());
  }
  [[nodiscard]] std::size_t count() const { return poles.omega.size(); }
};

void put(scene::Show& show) {
  std::vector<Trial> all;
  for (const Extreme& e : extreme_craft())
    all.push_back({e.name, spacecraft::poles(spacecraft::Plant(e.craft), 5),
                   worst_error(e.craft, show.quick() ? 17 : 49)});
  show.table(all, {{"spacecraft", &Trial::name},
                   {"first pole (rad/s)", &Trial::first, 13},
                   {"fifth pole (rad/s)", &Trial::fifth, 13},
                   {"poles found of 5", &Trial::count},
                   {"largest error over its condition", &Trial::error, 2}});
  show.at_most("largest error of theta/u and y/u over max(1, condition), all spacecraft",
               std::ranges::max(all, {}, &Trial::error).error, 1e-12,
               "against 100 digits, 1e-8 to 1e8 rad/s");
  show.equals("spacecraft all of whose first five poles are counted and found",
              std::ranges::count_if(all, [](const Trial& t) { return t.poles.status.ok(); }),
              static_cast<double>(all.size()), "the argument principle says that none is missing");
  // On a pole there is no value.
  const spacecraft::Plant plant(craft(true));
  const auto there = plant.response(Complex(0, spacecraft::poles(plant, 1).omega.front()), 2);
  show.equals("a pole is said or its value is beyond 1e8",
              there.outcome == Outcome::at_pole || std::abs(there.theta) > 1e8, 1,
              "at s = j omega of the first pole, rounded to double");
  show.equals("k2 = -2 is called marginal",
              spacecraft::stability({12, -2, 16}).verdict == spacecraft::Stability::marginal, 1,
              "the hub does not feel the appendages, which ring on undamped");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "extremes",
           .title = "Extreme spacecraft: poles, and errors against 100 digits",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::extremes
