#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::williams_curves {
namespace {

/// Draws one curve per height.
void draw(scene::Panel& panel, double (LoadCurve::*value)(double) const) {
  for (const double height : heights) {
    const auto curve = williams_curve(height);
    const int style = height < 0.35 ? 1 : height < 0.4 ? 2 : 5;
    panel.curve(
        fmt::format("{{/:Italic l}} sin {{/:Italic β}} = {} in", height), deflections_to(0.8),
        std::identity(), [&](double d) { return std::invoke(value, *curve, d); }, scene::lines(style));
  }
}

void three_curves(scene::Show& show) {
  scene::Panel& panel =
      show.plot("Load against deflection: limit points at two of the three heights", drop_label, load_label);
  panel.key("top left").y_range(0, 90);
  draw(panel, &LoadCurve::load);
  std::vector<CurvePoint> points;
  for (const KnownLimits& k : known_limits) {
    const auto curve = williams_curve(k.height);
    if (const auto at = limit_points(*curve)) points.insert(points.end(), {at->maximum, at->minimum});
    check_limit_points(fmt::format("height {}", k.height), *curve, k.williams, show);
  }
  panel.curve("limit points", points, &CurvePoint::deflection, &CurvePoint::load, scene::large_points(3));
}

void three_slopes(scene::Show& show) {
  scene::Panel& panel = show.plot("Jacobian against deflection: two zeros at two of the three heights",
                                  drop_label, "d{/:Italic W}/d{/:Italic δ} (lb/in)");
  panel.key("top center");
  draw(panel, &LoadCurve::stiffness);
  panel.curve("", {0, 0.8}, {0, 0}, scene::lines(13));
  // F/2 of Eq. 2.21 has half the slope.
  for (const double height : heights) {
    const auto curve = williams_curve(height);
    if (const auto at = limit_points(*curve))
      show.at_most(
          fmt::format("slope at the maximum, height {}", height),
          {std::abs(curve->stiffness(at->maximum.deflection)), "lb/in"}, 1e-10,
          "a bisected root: the slope of the stiffness, 2e3 lb/in^2, times rounding of the deflection");
  }
  // oracle: homotopy_williams Williams 0.32 least slope, Williams 0.32 load at the least slope
  const CurvePoint soft = least_stiff_point(*williams_curve(0.32));
  show.near("least slope, height 0.32", {williams_curve(0.32)->stiffness(soft.deflection), "lb/in"},
            12.55869263, 1e-9, "tools/oracles/homotopy_williams.py, ten digits");
  show.near("load at the least slope, height 0.32", {soft.load, "lb"}, 27.0833960, 1e-6,
            "tools/oracles/homotopy_williams.py; a minimum is found to half the digits");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-2.6",
           .title = "Williams' equation: load against deflection for three heights",
           .place = "Figure 2.6",
           .content = scene::Content(three_curves)},
          {.name = "fig-2.7",
           .title = "Williams' equation: the Jacobian against deflection for three heights",
           .place = "Figure 2.7",
           .content = scene::Content(three_slopes)}};
}

}  // namespace nlmech::chapters::homotopy::williams_curves
