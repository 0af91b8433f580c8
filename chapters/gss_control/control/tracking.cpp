#include "nlmech/spacecraft/control/tracking.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control::tracking {
namespace {

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

void draw(double duration, scene::Show& show) {
  const Tracking text = track(duration, TrackingLaw::regulator),
                 forward = track(duration, TrackingLaw::feedforward);
  const std::vector<double> times = equidistant(0, 1.5 * duration, 601);
  scene::Plot& plot = show.plots("Feeding the torque forward removes the lag");
  plot.stacked().size(760, 560).columns({"curve", "panel", "x", "y"});
  scene::Panel& angle = plot.panel("{/:Italic t} (s)", "{/:Italic θ} (rad)");
  angle.x_range(0, 15).key("bottom right");
  const auto theta = [](const Tracking& of) { return [&of](double t) { return of.at(t).theta; }; };
  angle.curve("controller of the text", times, std::identity(), theta(text), scene::lines(5));
  angle.curve("torque fed forward", times, std::identity(), theta(forward), scene::lines(1));
  angle.curve(
      "target", times, std::identity(), [&](double t) { return text.turn().value(t); }, scene::lines(3));
  scene::Panel& deflection = plot.panel("{/:Italic t} (s)", "{/:Italic y}(2 ft) (ft)");
  deflection.x_range(0, 15);
  const auto y = [](const Tracking& of) { return [&of](double t) { return of.at(t).deflection.front(); }; };
  deflection.curve("", times, std::identity(), y(text), scene::lines(5));
  deflection.curve("", times, std::identity(), y(forward), scene::lines(1));
}

/// A turn with a law.
struct Turn {
  double duration;  ///< s
  const char* law;
  Largest largest;

  [[nodiscard]] double error() const { return largest.error; }
  [[nodiscard]] double deflection() const { return largest.deflection; }
  [[nodiscard]] double afterwards() const { return largest.afterwards; }
};

void put(scene::Show& show) {
  draw(10, show);
  std::vector<Turn> turns;
  for (const double duration : {5.0, 10.0, 20.0, 40.0}) {
    for (const auto& [name, law] :
         {std::pair{"text", TrackingLaw::regulator}, {"fed forward", TrackingLaw::feedforward}})
      turns.push_back({duration, name, largest(track(duration, law), show.quick() ? 401 : 1601)});
  }
  show.table(turns, {{"turn (s)", &Turn::duration},
                     {"law", &Turn::law},
                     {"largest |theta - r| (rad)", &Turn::error, 3},
                     {"largest |y(2 ft)| (ft)", &Turn::deflection, 3},
                     {"after the turn (ft)", &Turn::afterwards, 2}});
  const Turn &text = turns[6], &forward = turns[7], &before = turns[5];
  // The polynomial of degree 7: its largest slope is 35/16 a duration.
  show.near("largest lag of the text's controller, 40 s", {text.error(), "rad"},
            16. / 12 * 35 / 16 / text.duration, 0.1,
            "k3/k1 times the largest slope of the target, 35/(16 T), for a slow turn, within 10 %");
  show.between("least order in 1/T of the error with the torque fed forward",
               std::log2(before.error() / forward.error()), 3.5, 20,
               "theta - r is of the order of the target's fourth derivative: T^-4, and more where the modes "
               "that the ends excite still add");
  show.at_most("largest error with the torque fed forward, 40 s", {forward.error(), "rad"}, 1e-4,
               "kappa strain/k1 times the fourth derivative");
  // A torque step of 1/T^2 size bends the appendages by that times their static deflection.
  const double gain =
      std::abs(spacecraft::Plant(craft(true)).static_deflection(2)) * craft(true).total_inertia();
  // Degree 7: r'' = 140 (3 z^2 - 12 z^3 + 15 z^4 - 6 z^5)/T^2, largest 7.5132 at z = 1/2 - sqrt(5)/10.
  show.near("largest deflection with the torque fed forward, 40 s", {forward.deflection(), "ft"},
            gain * 7.5132 / 1600, 2e-2,
            "the static deflection under the largest angular acceleration, 7.51/T^2, within 2 %");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "tracking",
           .title = "Following a smooth target: the text's controller, and torque fed forward",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::gss_control::tracking
