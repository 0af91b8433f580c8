#include <fmt/format.h>

#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "chapters/homotopy/solvers/load_stepping.hpp"
#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::load_deflection {
namespace {

/// Load stepping of both models at one height.
struct BothStepped {
  Stepped williams, element;
};

BothStepped step_both(double height) {
  return {step_loads({.model = Model::williams, .height = height}),
          step_loads({.model = Model::element, .height = height})};
}

/// Checks the least slopes of a toggle without limit points.
void check_least_slopes(const LoadCurve& williams, const LoadCurve& element, scene::Show& show) {
  // oracle: homotopy_williams Williams 0.32 least slope
  // oracle: homotopy_frames toggle 0.32 of 1 least slope, toggle 0.32 of 1 load at the least slope
  const CurvePoint w = least_stiff_point(williams), e = least_stiff_point(element);
  show.near("least slope, Williams", {williams.stiffness(w.deflection), "lb/in"}, 12.55869263, 1e-9,
            "tools/oracles/homotopy_williams.py, ten digits");
  show.near("least slope, element", {element.stiffness(e.deflection), "lb/in"}, 14.70048679, 1e-9,
            "tools/oracles/homotopy_frames.py, ten digits");
  show.near("load at the least slope, element", {e.load, "lb"}, 27.0422397, 1e-6,
            "tools/oracles/homotopy_frames.py; a minimum is found to half the digits");
}

/// Draws the load-deflection curves of both models.
void draw(scene::Panel& panel, const LoadCurve& williams, const LoadCurve& element, double end,
          const std::function<scene::CurveStyle(int)>& look) {
  const std::vector<double> at = deflections_to(end);
  panel.curve(
      "Williams' equation", at, std::identity(), [&](double d) { return williams.load(d); }, look(1));
  panel.curve(
      "one element a member", at, std::identity(), [&](double d) { return element.load(d); }, look(5));
}

/// Draws and checks the equilibrium paths of both models (Williams' equation, one element per member) and
/// the points that load stepping finds on them.
void both_models(double height, const BothStepped& steps, scene::Show& show) {
  const auto williams = williams_curve(height), element = element_curve(height);
  scene::Panel& panel = show.plot(height < 0.35 ? "Load stepping without a limit point: finds the whole path"
                                                : "Load stepping: jumps at both limit loads",
                                  drop_label, load_label);
  panel.key("below").y_range(0, 50);
  show.figure().size(760, 640);
  draw(panel, *williams, *element, deflection_between(*williams, stepping_top, 0, 0.9), scene::thin_lines);
  draw_steps(panel, steps.williams);
  draw_steps(panel, steps.element);
  if (const auto limits = known_limits_of(height, true)) {
    check_limit_points("Williams", *williams, *limits, show);
    check_limit_points("element", *element, known_limits_of(height, false).value(), show);
  } else {
    check_least_slopes(*williams, *element, show);
  }
  if (height == 0.44) {
    // oracle: homotopy_williams Williams 0.44 starts that lead to the falling branch
    // oracle: homotopy_frames toggle 0.44 of 1 starts that lead to the falling branch
    for (const auto& [name, model] : {std::pair("Williams", Model::williams), {"element", Model::element}})
      show.equals(fmt::format("starts between the limit points that lead to the falling branch, {}", name),
                  found_from_the_falling_branch(model), 20,
                  "tools/oracles/homotopy_williams.py and homotopy_frames.py: all of them");
  }
  check_steps(steps.williams, "Williams", show);
  check_steps(steps.element, "element", show);
}

/// The largest load at deflections from 0.1 to 0.35 in.
double greatest_load(const std::function<double(double)>& load) {
  return -boost::math::tools::brent_find_minima([&](double d) { return -load(d); }, 0.1, 0.35, 53).second;
}

/// Checks the limit loads of Williams' toggle of 0.44 in under other readings of the equations.
void check_other_readings(scene::Show& show) {
  const frames::Williams w{.height = 0.44};
  /// Load by (2.17)-(2.19) with `bowing` for 0.6; 6 d_5 exact or linearised in n.
  const auto load = [&w](double d, double bowing, bool linear, double cosine) {
    const double sine = w.height / w.length, l = w.length;
    const double p = w.ea / l * (d * sine - bowing * d * d / l), n = -p * l * l / w.ei;
    // 6 d_5 = 12 + 6 n/5 + ... at small n, by the power series of the beam-column.
    const double six_d5 =
        linear ? 12 + 1.2 * n : frames::stability_functions<double>(n).antisymmetric.value + n;
    return 2 * (w.ei / (l * l * l) * six_d5 * d * cosine + p * sine);
  };
  const double cosine = std::sqrt(1 - std::pow(w.height / w.length, 2));
  const frames::Williams span{.height = 0.44, .length = std::hypot(12.94, 0.44)};
  // oracle: homotopy_williams Williams 0.44 limit with *
  const char* reason = "tools/oracles/homotopy_williams.py, five digits";
  show.near("limit load, d_5 linearised",
            {greatest_load([&](double d) { return load(d, 0.6, true, 1); }), "lb"}, 43.447, 2e-5, reason);
  show.near("limit load, 0.5 for 0.6",
            {greatest_load([&](double d) { return load(d, 0.5, false, 1); }), "lb"}, 44.164, 2e-5, reason);
  show.near("limit load, F cos(beta) for F",
            {greatest_load([&](double d) { return load(d, 0.6, false, cosine); }), "lb"}, 42.778, 2e-5,
            reason);
  show.near("limit load, l the half span", {greatest_load([&](double d) { return span.load(d); }), "lb"},
            42.698, 2e-5, reason);
}

/// Checks the limit loads of the same toggle with 32 elements per member and of the elastica.
void check_finer_theory(scene::Show& show) {
  // oracle: homotopy_frames toggle 0.44 of 32 maximum
  // oracle: homotopy_elastica elastica 0.44 maximum
  const double load = first_limit_point({.height = 0.44, .elements = 32}).load;
  show.near("limit load, 32 elements a member", {load, "lb"}, 42.4397589244, 4e-12,
            "tools/oracles/homotopy_frames.py, all its digits");
  show.near("the same, of the exact extensible elastica", {load, "lb"}, 42.4397755886, 1e-6,
            "tools/oracles/homotopy_elastica.py; elements err by the square of their length, one a member by "
            "1e-4");
}

/// A published load on one model.
struct Published {
  double load;
  const char* model;
  double limit;                    ///< the limit load
  std::vector<double> equilibria;  ///< deflections under the load
  double known_limit, known_drop;  ///< reference values

  [[nodiscard]] double above() const { return 100 * (load / limit - 1); }
  [[nodiscard]] std::size_t count() const { return equilibria.size(); }
  [[nodiscard]] double drop() const { return equilibria.back(); }
};

Published published(double load, const char* model, const LoadCurve& curve, double limit, double drop) {
  return {load, model, limit_points(curve).value().maximum.load, deflections_under(curve, load), limit, drop};
}

void check_published(const Published& p, scene::Show& show) {
  show.near(fmt::format("{} over the limit load, {}", p.load, p.model), p.load / p.limit - 1,
            p.load / p.known_limit - 1, 1e-9,
            "limit loads of tools/oracles/homotopy_williams.py and homotopy_frames.py");
  show.equals(fmt::format("equilibria under {}, {}", p.load, p.model), p.count(), 1,
              "the load is above the maximum: only the rising branch behind the minimum carries it");
  show.near(fmt::format("deflection under {}, {}", p.load, p.model), {p.drop(), "in"}, p.known_drop, 1e-8,
            "tools/oracles/homotopy_williams.py and homotopy_frames.py");
}

/// Compares the loads that the source calls near the limit point with the limit loads.
void published_loads(scene::Show& show) {
  const auto williams = williams_curve(0.44), element = element_curve(0.44);
  // oracle: homotopy_williams Williams 0.44 drop under *, Williams 0.44 maximum
  // oracle: homotopy_frames toggle 0.44 of 1 drop under *, toggle 0.44 of 1 maximum
  const std::vector<Published> all = {
      published(near_load, "Williams", *williams, 42.771896097273, 0.635331561089),
      published(near_load, "element", *element, 42.435492120383, 0.621922545486),
      published(last_load, "Williams", *williams, 42.771896097273, 0.636310193301),
      published(last_load, "element", *element, 42.435492120383, 0.623070489)};
  scene::Panel& panel = show.plot("Load against deflection: both published loads exceed the limit load",
                                  drop_label, load_label);
  panel.key("below").x_range(0, 0.75).y_range(24, 48);
  draw(panel, *williams, *element, 0.75, scene::lines);
  panel.curve("43.79 and 44 lb", {0, 0.75}, {near_load, near_load}, scene::lines(3));
  panel.curve("", {0, 0.75}, {last_load, last_load}, scene::lines(3));
  panel.curve("the only equilibria there", all, &Published::drop, &Published::load, scene::large_points(3));
  show.table(all, {{"load (lb)", &Published::load, 4},
                   {"model", &Published::model},
                   {"limit load (lb)", &Published::limit, 8},
                   {"above it (%)", &Published::above},
                   {"equilibria", &Published::count},
                   {"deflection there (in)", &Published::drop, 9}});
  check_other_readings(show);
  check_finer_theory(show);
  for (const Published& p : all) check_published(p, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> all;
  for (const double height : heights) {
    const scene::Result steps(
        fmt::format("load-steps-{}", height),
        "fixed-point homotopy (Eqs 2.12, 2.15 corrected) by Euler's rule under loads of 1, 2, ... 50 lb and "
        "back, each from the previous solution; the text states no loads",
        [height] { return step_both(height); });
    const std::string number = fmt::format("2.{}", 13 + all.size());
    all.push_back(
        {.name = "fig-" + number,
         .title = fmt::format("Load against deflection, Williams' equation and element, l sin(beta) = {} in",
                              height),
         .place = "Figure " + number,
         .content = scene::Content(
             [height](const BothStepped& both, scene::Show& show) { both_models(height, both, show); },
             steps)});
  }
  all.push_back({.name = "limit-load",
                 .title = "The published loads against the limit load",
                 .content = scene::Content(published_loads)});
  return all;
}

}  // namespace nlmech::chapters::homotopy::load_deflection
