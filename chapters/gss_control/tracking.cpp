#include "nlmech/spacecraft/tracking.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::SmoothTurn;
using spacecraft::Tracking;
using spacecraft::TrackingLaw;

constexpr std::array places = {2.0};

/// Largest |theta - r| and |y(2 ft)| during and after the turn, and |y| after it.
struct Largest {
  double error = 0, deflection = 0, afterwards = 0;
};

Largest largest(const Tracking& tracking, int samples) {
  Largest all;
  const double end = tracking.turn().duration();
  for (const double t : equidistant(0, 2 * end, samples)) {
    const auto m = tracking.at(t);
    all.error = std::max(all.error, std::abs(m.error));
    all.deflection = std::max(all.deflection, std::abs(m.deflection.front()));
    if (t > end) all.afterwards = std::max(all.afterwards, std::abs(m.deflection.front()));
  }
  return all;
}

Tracking track(double duration, TrackingLaw law) {
  Tracking tracking(spacecraft::ClosedLoop(craft(true), designed_gains), SmoothTurn(1, duration), law,
                    places);
  if (!tracking.status().ok()) throw Failure(tracking.status());
  return tracking;
}

void draw(Plot& plot, double duration) {
  const Tracking regulator = track(duration, TrackingLaw::regulator),
                 forward = track(duration, TrackingLaw::feedforward);
  const std::vector<double> times = equidistant(0, 1.5 * duration, 601);
  plot.panel("{/:Italic θ} (rad)");
  plot.begin("controller of the text", "l5");
  for (const double t : times) plot.add(t, regulator.at(t).theta);
  plot.begin("torque fed forward", "l1");
  for (const double t : times) plot.add(t, forward.at(t).theta);
  plot.begin("target", "l3");
  for (const double t : times) plot.add(t, regulator.turn().value(t));
  plot.panel("{/:Italic y}(2 ft) (ft)");
  plot.begin("", "l5");
  for (const double t : times) plot.add(t, regulator.at(t).deflection.front());
  plot.begin("", "l1");
  for (const double t : times) plot.add(t, forward.at(t).deflection.front());
}

scene::Showing show(bool quick) {
  constexpr double drawn = 10;
  Plot plot("Feeding the torque forward removes the lag", "{/:Italic t} (s)");
  plot.x_range(0, 15);
  draw(plot, drawn);
  scene::Table table({{"turn (s)"},
                      {"law"},
                      {"largest |theta - r| (rad)", 3},
                      {"largest |y(2 ft)| (ft)", 3},
                      {"after the turn (ft)", 2}});
  std::vector<scene::Quantity> quantities;
  const int samples = quick ? 401 : 1601;
  double before = 0;
  for (const double duration : {5.0, 10.0, 20.0, 40.0}) {
    for (const TrackingLaw law : {TrackingLaw::regulator, TrackingLaw::feedforward}) {
      const Largest l = largest(track(duration, law), samples);
      const bool forward = law == TrackingLaw::feedforward;
      table.add({duration, forward ? "fed forward" : "text", l.error, l.deflection, l.afterwards});
      if (duration < 40) {
        if (forward) before = l.error;
        continue;
      }
      // The polynomial of degree 7: its largest slope is 35/16 a duration.
      if (!forward)
        quantities.push_back(scene::near(
            "largest lag of the text's controller, 40 s", "rad", l.error, 16. / 12 * 35 / 16 / duration, 0.1,
            "k3/k1 times the largest slope of the target, 35/(16 T), for a slow turn, "
            "within 10 %"));
      else {
        quantities.push_back(
            {"least order in 1/T of the error with the torque fed forward", "1", std::log2(before / l.error),
             3.5, 20,
             "theta - r is of the order of the target's fourth derivative: T^-4, and more where "
             "the modes that the ends excite still add"});
        quantities.push_back(scene::at_most("largest error with the torque fed forward, 40 s", "rad", l.error,
                                            1e-4, "kappa strain/k1 times the fourth derivative"));
      }
    }
  }
  // A torque step of 1/T^2 size bends the appendages by that times their static deflection.
  const Largest slow = largest(track(40, TrackingLaw::feedforward), samples);
  const double gain =
      std::abs(spacecraft::Plant(craft(true)).static_deflection(2)) * craft(true).total_inertia();
  // Degree 7: r'' = 140 (3 z^2 - 12 z^3 + 15 z^4 - 6 z^5)/T^2, largest 7.5132 at z = 1/2 - sqrt(5)/10.
  quantities.push_back(
      scene::near("largest deflection with the torque fed forward, 40 s", "ft", slow.deflection,
                  gain * 7.5132 / 1600, 2e-2,
                  "the static deflection under the largest angular acceleration, 7.51/T^2, within "
                  "2 %"));
  return {plot.with("key1", "bottom right").take(), table, quantities};
}

}  // namespace

void add_tracking(scene::Chapter& chapter) {
  chapter.add({.name = "tracking",
               .title = "Following a smooth target: the text's controller, and torque fed forward",
               .place = "our own",
               .needs = {},
               .show = [](Workshop& w) { return show(w.quick()); }});
}

}  // namespace nlmech::chapters
