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
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control::torque_steps {
namespace {

using spacecraft::TimeResponse;

/// Figure with error bounds of the Bromwich sum, truncated at 1.2e4 rad/s with its peaks at a distance of a
/// quarter from the path, and of ten assumed modes.
struct Figure {
  const char* name;
  History history;
  double bound, modal;
};
constexpr std::array figures = {
    Figure{"fig-3.9", hub_angle, 1e-9, 2e-5}, Figure{"fig-3.10", hub_rate, 1e-7, 2e-4},
    Figure{"fig-3.11", deflection, 1e-8, 5e-4}, Figure{"fig-3.12", deflection_rate, 1e-5, 2e-2}};

TimeResponse respond() {
  TimeResponse r = torque_response(spacecraft::Plant(craft(true)), 1, places);
  if (!r.status.ok()) throw Failure(r.status);
  return r;
}

/// Response of ten assumed modes to a unit torque, in closed form.
double by_modes(const spacecraft::ModalModel& model, const Eigen::VectorXd& shapes, const History& h,
                double t) {
  const double j = model.total_inertia;
  double sum = !h.hub ? 0 : h.rate ? t / j : t * t / (2 * j);
  for (Eigen::Index i = 0; i < model.omega.size(); ++i) {
    const double w = model.omega[i], b = model.participation[i];
    sum += (h.hub ? b * b : b * shapes[i]) * (h.rate ? std::sin(w * t) / w : (1 - std::cos(w * t)) / (w * w));
  }
  return sum;
}

void put(const Figure& f, const TimeResponse& response, scene::Show& show) {
  const History& h = f.history;
  const spacecraft::Plant plant(craft(true));
  const auto model = diagonalise(spacecraft::assumed_modes(plant.parameters(), 10));
  const Eigen::VectorXd shapes = model.mode_shapes(places.front());
  const auto exact = [&](double t) { return h.of(response).value(t); };
  const auto modes = [&](double t) { return by_modes(model, shapes, h, t); };
  const double end = h.hub ? 10 : 5;
  const std::vector<double> times = equidistant(0, end, 1001);
  const auto off = [&](double t) { return modes(t) - exact(t); };
  double difference = 0;
  for (const double t : times) difference = std::max(difference, std::abs(off(t)));
  scene::Plot& plot = show.plots(h.hub ? "Unit torque: the hub moves as a rigid body with small vibrations"
                                       : "Unit torque: the appendages vibrate without damping");
  plot.stacked({0.64, 0.36}).columns({"curve", "panel", "x", "y"});
  scene::Panel& panel = plot.panel("", h.label);
  panel.x_range(0, end).key(h.hub ? "top left" : "bottom right maxrows 1");
  if (!h.hub) panel.y_range(h.rate ? -0.06 : -0.0125, h.rate ? 0.04 : 0.001);
  panel.curve("exact", times, std::identity(), exact);
  panel.curve("ten assumed modes", times, std::identity(), modes, scene::lines(5));
  // The unit is a power of ten, given in the label.
  const int power = static_cast<int>(std::floor(std::log10(difference)));
  const double unit = std::pow(10, power), most = std::ceil(difference / unit);
  plot.panel("{/:Italic t} (s)", fmt::format("difference (10^{{{}}} {})", power, h.unit))
      .x_range(0, end)
      .y_range(-most, most)
      .key("off")
      .level(0)
      .curve(
          "", times, std::identity(), [&](double t) { return off(t) / unit; }, scene::lines(5));
  show.at_most("distance of the residue sum from the Bromwich integral",
               {distance_from_inversion(h.of(response), h, plant), h.unit}, f.bound,
               "aliasing e^(-30), and the integral's rest beyond 1.2e4 rad/s");
  show.at_most("largest difference of ten assumed modes", {difference, h.unit}, f.modal,
               "their static deflection is right to 1e-3, their upper modes are not");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result motion("torque-step",
                             "unit torque from t = 0, from rest; residues over the exact poles", respond);
  std::vector<scene::Scene> all;
  for (const Figure& f : figures)
    all.push_back(
        {.name = f.name,
         .title = fmt::format("Unit torque: {}", f.history.name),
         .place = std::string("Figure ") + (f.name + 4),
         .content = scene::Content(
             [f](const TimeResponse& response, scene::Show& show) { put(f, response, show); }, motion)});
  return all;
}

}  // namespace nlmech::chapters::gss_control::torque_steps
