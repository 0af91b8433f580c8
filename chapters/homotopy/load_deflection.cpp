#include <fmt/format.h>

#include <cmath>

#include "chapters/homotopy/curves.hpp"
#include "chapters/homotopy/known_limits.hpp"
#include "chapters/homotopy/load_stepping.hpp"
#include "chapters/homotopy/scenes.hpp"
#include "chapters/homotopy/toggles.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr const char* programs = "tools/oracles/homotopy_williams.py and homotopy_frames.py, all digits";
// Bisection finds the deflection to rounding of the stiffness; the load is stationary there.
constexpr double eleven_digits = 1e-11, nine_digits = 1e-9;

void add_limit_points(std::vector<scene::Quantity>& all, const std::string& model, const LoadCurve& curve,
                      const LimitPoints& reference) {
  const auto found = limit_points(curve);
  const LimitPoints at = found.value_or(LimitPoints{{NAN, NAN}, {NAN, NAN}});
  const auto add = [&](const char* which, const CurvePoint& ours, const CurvePoint& theirs) {
    all.push_back(scene::near(fmt::format("load at the {}, {}", which, model), "lb", ours.load, theirs.load,
                              eleven_digits, programs));
    all.push_back(scene::near(fmt::format("deflection at the {}, {}", which, model), "in", ours.deflection,
                              theirs.deflection, nine_digits,
                              "as the load; the stiffness has a simple zero, rounding by 1e-12"));
  };
  add("maximum", at.maximum, reference.maximum);
  add("minimum", at.minimum, reference.minimum);
}

void sample(Curves& figure, double end, const std::function<double(double)>& f) {
  constexpr int points = 300;
  for (int i = 0; i <= points; ++i) figure.add(end * i / points, f(end * i / points));
}

const char* const drop = "deflection of the apex {/:Italic δ} (in)";
const char* const load_of_toggle = "load {/:Italic W} (lb)";

void begin_height(Curves& figure, double height) {
  const int style = height < 0.35 ? 1 : height < 0.4 ? 2 : 5;
  figure.begin(fmt::format("{{/:Italic l}} sin {{/:Italic β}} = {} in", height), fmt::format("l{}", style));
}

scene::Showing three_curves() {
  Curves figure("Two of the three heights have limit points", drop, load_of_toggle);
  for (const double height : heights) {
    begin_height(figure, height);
    const auto curve = williams_curve(height);
    sample(figure, 0.8, [&](double d) { return curve->load(d); });
  }
  figure.begin("limit points", "p3");
  std::vector<scene::Quantity> quantities;
  for (const KnownLimits& k : known_limits) {
    const auto curve = williams_curve(k.height);
    const auto at = limit_points(*curve);
    if (at) figure.add(at->maximum.deflection, at->maximum.load);
    if (at) figure.add(at->minimum.deflection, at->minimum.load);
    add_limit_points(quantities, fmt::format("height {}", k.height), *curve, k.williams);
  }
  return {figure.with("key", "top left").with("yrange", "[0:90]").take(), {}, quantities};
}

scene::Showing three_slopes() {
  Curves figure("At two heights the Jacobian vanishes twice", drop, "d{/:Italic W}/d{/:Italic δ} (lb/in)");
  std::vector<scene::Quantity> quantities;
  for (const double height : heights) {
    begin_height(figure, height);
    const auto curve = williams_curve(height);
    sample(figure, 0.8, [&](double d) { return curve->stiffness(d); });
    // F/2 of Eq. 2.21 has half the slope.
    if (const auto at = limit_points(*curve)) {
      quantities.push_back(scene::at_most(
          fmt::format("slope at the maximum, height {}", height), "lb/in",
          std::abs(curve->stiffness(at->maximum.deflection)), 1e-10,
          "a bisected root: the slope of the stiffness, 2e3 lb/in^2, times rounding of the deflection"));
    }
  }
  figure.begin("", "l13");
  figure.add(0, 0);
  figure.add(0.8, 0);
  // oracle: homotopy_williams Williams 0.32 least slope, Williams 0.32 load at the least slope
  const CurvePoint soft = softest(*williams_curve(0.32));
  quantities.push_back(scene::near("least slope, height 0.32", "lb/in",
                                   williams_curve(0.32)->stiffness(soft.deflection), 12.55869263, 1e-9,
                                   "tools/oracles/homotopy_williams.py, ten digits"));
  quantities.push_back(
      scene::near("load at the least slope, height 0.32", "lb", soft.load, 27.0833960, 1e-6,
                  "tools/oracles/homotopy_williams.py; a minimum is found to half the digits"));
  return {figure.with("key", "top center").take(), {}, quantities};
}

/// What load stepping finds on both models at one height.
struct BothStepped {
  Stepped williams, element;
};

/// Least slopes of a toggle without limit points.
void add_least_slopes(std::vector<scene::Quantity>& all, const LoadCurve& williams,
                      const LoadCurve& element) {
  // oracle: homotopy_williams Williams 0.32 least slope
  // oracle: homotopy_frames toggle 0.32 of 1 least slope, toggle 0.32 of 1 load at the least slope
  const CurvePoint w = softest(williams), e = softest(element);
  all.push_back(scene::near("least slope, Williams", "lb/in", williams.stiffness(w.deflection), 12.55869263,
                            1e-9, "tools/oracles/homotopy_williams.py, ten digits"));
  all.push_back(scene::near("least slope, element", "lb/in", element.stiffness(e.deflection), 14.70048679,
                            1e-9, "tools/oracles/homotopy_frames.py, ten digits"));
  all.push_back(scene::near("load at the least slope, element", "lb", e.load, 27.0422397, 1e-6,
                            "tools/oracles/homotopy_frames.py; a minimum is found to half the digits"));
}

/// The paths as lines, Williams' equation beside one element a member, and what load stepping finds on them.
scene::Showing both_models(double height, const BothStepped& steps) {
  const auto williams = williams_curve(height), element = element_curve(height);
  Curves figure(height < 0.35 ? "No limit point: load stepping finds the whole path"
                              : "Load stepping jumps at the limit points",
                drop, load_of_toggle);
  const double end = deflection_between(*williams, stepping_top, 0, 0.9);
  figure.begin("Williams' equation", "t1");
  sample(figure, end, [&](double d) { return williams->load(d); });
  figure.begin("one element a member", "t5");
  sample(figure, end, [&](double d) { return element->load(d); });
  draw_steps(figure, steps.williams);
  draw_steps(figure, steps.element);
  std::vector<scene::Quantity> quantities;
  if (const auto limits = known_limits_of(height, true)) {
    add_limit_points(quantities, "Williams", *williams, *limits);
    add_limit_points(quantities, "element", *element, known_limits_of(height, false).value());
  } else {
    add_least_slopes(quantities, *williams, *element);
  }
  add_step_quantities(quantities, steps.williams, "Williams");
  add_step_quantities(quantities, steps.element, "element");
  return {figure.with("below", "1").with("height", "640").with("yrange", "[0:50]").take(), {}, quantities};
}

/// The greatest load between deflections of 0.1 and 0.35 in, by golden section.
double greatest_load(const std::function<double(double)>& load) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = 0.1, high = 0.35;
  for (int k = 0; k < 60; ++k) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (load(a) > load(b))
      high = b;
    else
      low = a;
  }
  return load((low + high) / 2);
}

/// Limit loads of Williams' toggle of 0.44 in, read in other ways.
std::vector<scene::Quantity> other_readings() {
  const frames::Williams w{.height = 0.44};
  /// (2.17)-(2.19) with 6 d_5 of n and `bowing` for 0.6.
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
  return {
      scene::near("limit load, d_5 linearised", "lb",
                  greatest_load([&](double d) { return load(d, 0.6, true, 1); }), 43.447, 2e-5, reason),
      scene::near("limit load, 0.5 for 0.6", "lb",
                  greatest_load([&](double d) { return load(d, 0.5, false, 1); }), 44.164, 2e-5, reason),
      scene::near("limit load, F cos(beta) for F", "lb",
                  greatest_load([&](double d) { return load(d, 0.6, false, cosine); }), 42.778, 2e-5, reason),
      scene::near("limit load, l the half span", "lb", greatest_load([&](double d) { return span.load(d); }),
                  42.698, 2e-5, reason)};
}

/// Loads that the text calls near the limit point, against the limits.
scene::Showing published_loads() {
  const auto williams = williams_curve(0.44), element = element_curve(0.44);
  Curves figure("Both published loads lie above the maximum", drop, load_of_toggle);
  figure.begin("Williams' equation", "l1");
  sample(figure, 0.75, [&](double d) { return williams->load(d); });
  figure.begin("one element a member", "l5");
  sample(figure, 0.75, [&](double d) { return element->load(d); });
  for (const double load : {near_load, last_load}) {
    figure.begin(load == near_load ? "43.79 and 44 lb" : "", "l3");
    figure.add(0, load);
    figure.add(0.75, load);
  }
  scene::Table table({{"load (lb)", 4},
                      {"model"},
                      {"limit load (lb)", 8},
                      {"above it (%)"},
                      {"equilibria"},
                      {"deflection there (in)", 9}});
  std::vector<scene::Quantity> quantities = other_readings();
  figure.begin("the only equilibria there", "p3");
  for (const double load : {near_load, last_load}) {
    for (const bool by_williams : {true, false}) {
      const LoadCurve& curve = by_williams ? *williams : *element;
      const char* name = by_williams ? "Williams" : "element";
      const double limit = limit_points(curve).value().maximum.load;
      const auto at = deflections_under(curve, load);
      table.add(
          {load, name, limit, 100 * (load / limit - 1), static_cast<std::int64_t>(at.size()), at.back()});
      figure.add(at.back(), load);
      // oracle: homotopy_williams Williams 0.44 drop under *, Williams 0.44 maximum
      // oracle: homotopy_frames toggle 0.44 of 1 drop under *, toggle 0.44 of 1 maximum
      const double expected = by_williams ? (load == near_load ? 0.635331561089 : 0.636310193301)
                                          : (load == near_load ? 0.621922545486 : 0.623070489);
      quantities.push_back(
          scene::near(fmt::format("{} over the limit load, {}", load, name), "1", load / limit - 1,
                      load / (by_williams ? 42.771896097273 : 42.435492120383) - 1, 1e-9,
                      "limit loads of tools/oracles/homotopy_williams.py and homotopy_frames.py"));
      quantities.push_back(scene::near(fmt::format("equilibria under {}, {}", load, name), "1",
                                       static_cast<double>(at.size()), 1, 0,
                                       "the load is above the maximum: only the rising branch behind the "
                                       "minimum carries it"));
      quantities.push_back(scene::near(fmt::format("deflection under {}, {}", load, name), "in", at.back(),
                                       expected, 1e-8,
                                       "tools/oracles/homotopy_williams.py and homotopy_frames.py"));
    }
  }
  return {figure.with("below", "1")
              .with("height", "520")
              .with("xrange", "[0:0.75]")
              .with("yrange", "[24:48]")
              .take(),
          table, quantities};
}

void add_scene(scene::Chapter& chapter, const std::string& name, const std::string& title,
               const std::function<scene::Showing()>& show) {
  chapter.add({.name = name,
               .title = title,
               .place = name.starts_with("fig-") ? "Figure " + name.substr(4) : "our own",
               .needs = {},
               .show = [show](Workshop&) { return show(); }});
}

}  // namespace

void add_williams_curves(scene::Chapter& chapter) {
  add_scene(chapter, "fig-2.6", "Williams' equation: load against deflection for three heights",
            three_curves);
  add_scene(chapter, "fig-2.7", "Williams' equation: the Jacobian against deflection for three heights",
            three_slopes);
}

void add_load_deflection(scene::Chapter& chapter) {
  const std::array names = {"fig-2.13", "fig-2.14", "fig-2.15"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double height = heights.at(i);
    const auto& run = chapter.add_run<BothStepped>(
        fmt::format("load-steps-{}", height),
        "fixed-point homotopy (Eqs 2.12, 2.15 corrected) by Euler's rule under loads of 1, 2, ... 50 lb and "
        "back, each from the solution before; the text states no loads",
        {}, [height](Workshop&) {
          return BothStepped{step_loads({.model = Model::williams, .height = height}),
                             step_loads({.model = Model::element, .height = height})};
        });
    chapter.add({.name = names.at(i),
                 .title = fmt::format(
                     "Load against deflection, Williams' equation and element, l sin(beta) = {} in", height),
                 .place = std::string("Figure ") + (names.at(i) + 4),
                 .needs = {&run},
                 .show = [height, &run](Workshop& w) { return both_models(height, w.result(run)); }});
  }
  add_scene(chapter, "limit-load", "The published loads against the limit load", published_loads);
}

}  // namespace nlmech::chapters
