#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "chapters/drawing.hpp"
#include "chapters/homotopy/curves.hpp"
#include "chapters/homotopy/iterations.hpp"
#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {
namespace {

// ------------------------------------------------------ figure 2.1: Newton's iteration and a flat slope

/// A cubic with two extrema and one root, at -2.1.
double cubic(double x) { return x * x * x - 3 * x + 3; }
double cubic_slope(double x) { return 3 * x * x - 3; }

/// Newton's iterates from x, by the library.
std::vector<double> newton_iterates(double x, int count) {
  algebraic::DenseEquations equations(
      1, [](const Eigen::VectorXd& at, Eigen::VectorXd& f) { f[0] = cubic(at[0]); },
      [](const Eigen::VectorXd& at, Eigen::MatrixXd& b) { b(0, 0) = cubic_slope(at[0]); });
  std::vector<double> iterates;
  Eigen::VectorXd start = Eigen::VectorXd::Constant(1, x);
  const auto look = [&](const algebraic::Iterate& at) {
    iterates.push_back(at.x[0]);
    return static_cast<int>(iterates.size()) <= count;
  };
  static_cast<void>(find_root(algebraic::Newton{}, equations, start, look));
  return iterates;
}

scene::Showing flat_slope() {
  Curves figure("Where the slope vanishes, Newton's step is no longer small", "{/:Italic x}", "{/:Italic F}");
  figure.begin("", "l13");
  figure.add(-3, 0);
  figure.add(4, 0);
  figure.begin("{/:Italic F}({/:Italic x})", "l1");
  for (int i = 0; i <= 200; ++i) figure.add(-3 + 0.03 * i, cubic(-3 + 0.03 * i));
  const std::vector<double> x = newton_iterates(2, 3);
  figure.begin("tangents", "l5");
  double defect = 0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    figure.add(x[k], 0);
    figure.add(x[k], cubic(x[k]));
    figure.add(x[k + 1], 0);
    defect = std::max(defect, std::abs(cubic(x[k]) + cubic_slope(x[k]) * (x[k + 1] - x[k])));
  }
  figure.begin("iterates", "p3");
  for (std::size_t k = 0; k < x.size(); ++k) {
    figure.add(x[k], 0);
    figure.label(fmt::format("{{/:Italic x}}_{}", k), x[k], -0.8, "center");
  }
  figure.begin("root", "p4");
  const double root = newton_iterates(-2, 20).back();
  figure.add(root, 0);
  return {
      figure.with("key", "top left").with("xrange", "[-3:4]").with("yrange", "[-3:8]").take(),
      {},
      {scene::at_most("height of a tangent over the next iterate", "1", defect, 1e-14,
                      "the definition (2.2); rounding of terms up to 5, at a slope above 0.4"),
       scene::at_most("|F| at the root", "1", std::abs(cubic(root)), 1e-14, "rounding of terms up to 10")}};
}

// ------------------------------------------------------- figure 2.2: turning points of a homotopy path

/// t on the path t F + (1 - t)(x - 2) = 0 of the same cubic (2.8).
double path_parameter(double x) { return (x - 2) / (x - 2 - cubic(x)); }

/// Where the parameter has an extremum between two places, by golden section.
double turning_point(double low, double high, bool maximum) {
  const double golden = (std::sqrt(5.0) - 1) / 2, sign = maximum ? -1 : 1;
  for (int k = 0; k < 60; ++k) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (sign * path_parameter(a) < sign * path_parameter(b))
      high = b;
    else
      low = a;
  }
  return (low + high) / 2;
}

scene::Showing turning_points() {
  const double root = newton_iterates(-2, 20).back();
  const double first = turning_point(0, 1.5, true), second = turning_point(-1.5, 0.5, false);
  Curves figure("On its way to the root the parameter runs backwards once", "homotopy parameter {/:Italic t}",
                "{/:Italic x}");
  figure.begin("{/:Italic H}_{F} = 0", "l1");
  for (int i = 0; i <= 300; ++i) {
    const double x = 2 + (root - 2) * i / 300;
    figure.add(path_parameter(x), x);
  }
  figure.begin("turning points", "p5");
  figure.add(path_parameter(first), first);
  figure.add(path_parameter(second), second);
  figure.begin("start and root", "p3");
  figure.add(0, 2);
  figure.add(1, root);
  figure.label("{/:Italic x}_0", 0.02, 2.25);
  // dt/dx = 0 is u F' = F with u = x - 2, that is y^3 - 3 y = 1/2 for x = 1 + y: y = 2 cos.
  const double angle = std::acos(0.25) / 3, third = 2 * std::numbers::pi / 3;
  const char* reason = "Cardano's solution of x F' = ... in closed form; an extremum to half the digits";
  return {figure.with("xrange", "[0:1]").with("yrange", "[-2.5:2.5]").take(),
          {},
          {{"x at the first turning point", "1", first, 1 + 2 * std::cos(angle + 2 * third) - 1e-7,
            1 + 2 * std::cos(angle + 2 * third) + 1e-7, reason},
           {"x at the second turning point", "1", second, 1 + 2 * std::cos(angle + third) - 1e-7,
            1 + 2 * std::cos(angle + third) + 1e-7, reason},
           scene::near("t at the root", "1", path_parameter(root), 1, 1e-14, "H_F at F = 0; rounding")}};
}

// ----------------------------------------------------- figure 2.3: Newton's iteration and a limit point

scene::Showing limit_point() {
  const auto curve = williams_curve(0.44);
  const LimitPoints limits = limit_points(*curve).value();
  std::vector<Trace> trace;
  LoadedToggle toggle(Model::williams, 0.44, near_load);
  const Count count = iterate(toggle, {}, &trace);
  Curves figure("Above the maximum no tangent leads to the load", "deflection of the apex {/:Italic δ} (in)",
                "load {/:Italic W} (lb)");
  figure.begin("load of 43.79 lb", "l3");
  figure.add(-0.05, near_load);
  figure.add(0.75, near_load);
  figure.begin("Williams' equation, {/:Italic l} sin {/:Italic β} = 0.44 in", "l1");
  for (int i = 0; i <= 300; ++i) figure.add(0.75 * i / 300, curve->load(0.75 * i / 300));
  constexpr std::size_t shown = 4;
  figure.begin("Newton's first steps", "l5");
  double defect = 0;
  for (std::size_t k = 0; k < shown; ++k) {
    const double from = trace[k].deflection, to = trace[k + 1].deflection;
    figure.add(from, curve->load(from));
    figure.add(to, near_load);
    figure.add(to, curve->load(to));
    const double height = curve->load(from) + curve->stiffness(from) * (to - from) - near_load;
    defect = std::max(defect, std::abs(height) / near_load);
  }
  figure.begin("limit points", "p3");
  figure.add(limits.maximum.deflection, limits.maximum.load);
  figure.add(limits.minimum.deflection, limits.minimum.load);
  figure.label("maximum, 42.77 lb", limits.maximum.deflection, 47.5, "center");
  // oracle: homotopy_williams Williams 0.44 maximum
  return {figure.with("key", "bottom right").with("xrange", "[0:0.75]").with("yrange", "[0:60]").take(),
          {},
          {scene::at_most("height of a tangent over the load at the next iterate", "1", defect, 1e-13,
                          "the definition (2.2); rounding, amplified where the tangent is flat"),
           scene::near("limit load", "lb", limits.maximum.load, 42.771896097273, 1e-11,
                       "tools/oracles/homotopy_williams.py, all digits"),
           {"iterations of Newton from rest", "1", static_cast<double>(count.iterations), 20, 400,
            "recorded: 79 to 125, depending on how the same formula is written, and at most some 400 from "
            "20 001 starts"}}};
}

}  // namespace

void add_tangents(scene::Chapter& chapter) {
  add_drawing(chapter, "fig-2.1", "Newton's iteration where the slope vanishes (drawn)", flat_slope);
  add_drawing(chapter, "fig-2.2", "A homotopy path with turning points (drawn)", turning_points);
  add_drawing(chapter, "fig-2.3", "A limit point that Newton's iteration meets (drawn)", limit_point);
}

}  // namespace nlmech::chapters
