#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::tangents {
namespace {

// ------------------------------------------------------ figure 2.1: Newton's iteration and a flat slope

/// A cubic with two extrema and one root, at -2.1.
double cubic(double x) { return x * x * x - 3 * x + 3; }
double cubic_slope(double x) { return 3 * x * x - 3; }

/// Newton iterates from x, by the library.
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

void flat_slope(scene::Show& show) {
  scene::Panel& panel = show.plot("Newton's iteration: large steps where the slope of {/:Italic F} is small",
                                  "{/:Italic x}", "{/:Italic F}");
  panel.key("top left").x_range(-3, 4).y_range(-3, 8);
  std::vector<double> grid, zigzag_x, zigzag_y;
  for (int i = 0; i <= 200; ++i) grid.push_back(-3 + 0.03 * i);
  const std::vector<double> x = newton_iterates(2, 3);
  double defect = 0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    zigzag_x.insert(zigzag_x.end(), {x[k], x[k], x[k + 1]});
    zigzag_y.insert(zigzag_y.end(), {0, cubic(x[k]), 0});
    defect = std::max(defect, std::abs(cubic(x[k]) + cubic_slope(x[k]) * (x[k + 1] - x[k])));
  }
  for (std::size_t k = 0; k < x.size(); ++k)
    panel.note(fmt::format("{{/:Italic x}}_{}", k), x[k], -0.8, "center");
  const double root = newton_iterates(-2, 20).back();
  panel.curve("", {-3, 4}, {0, 0}, scene::lines(13))
      .curve("{/:Italic F}({/:Italic x})", grid, std::identity(), cubic, scene::lines(1))
      .curve("tangents", zigzag_x, zigzag_y, scene::lines(5))
      .curve("iterates", x, std::vector<double>(x.size(), 0), scene::large_points(3))
      .curve("root", {root}, {0}, scene::large_points(4));
  show.at_most("height of a tangent over the next iterate", defect, 1e-14,
               "the definition (2.2); rounding of terms up to 5, at a slope above 0.4");
  show.at_most("|F| at the root", std::abs(cubic(root)), 1e-14, "rounding of terms up to 10");
}

// ------------------------------------------------------- figure 2.2: turning points of a homotopy path

/// t on the homotopy path t F + (1 - t)(x - 2) = 0 of the same cubic (2.8).
double path_parameter(double x) { return (x - 2) / (x - 2 - cubic(x)); }

/// x at the extremum of the path parameter between @p low and @p high, by golden section.
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

void turning_points(scene::Show& show) {
  const double root = newton_iterates(-2, 20).back();
  const double first = turning_point(0, 1.5, true), second = turning_point(-1.5, 0.5, false);
  std::vector<double> path;
  for (int i = 0; i <= 300; ++i) path.push_back(2 + (root - 2) * i / 300);
  scene::Panel& panel = show.plot("Homotopy path: {/:Italic t} decreases between two turning points",
                                  "homotopy parameter {/:Italic t}", "{/:Italic x}");
  panel.x_range(0, 1).y_range(-2.5, 2.5).note("{/:Italic x}_0", 0.02, 2.25);
  panel.curve("{/:Italic H}_{F} = 0", path, path_parameter, std::identity(), scene::lines(1))
      .curve("turning points", std::array{first, second}, path_parameter, std::identity(),
             scene::large_points(5))
      .curve("start and root", {0, 1}, {2, root}, scene::large_points(3));
  // dt/dx = 0 is u F' = F with u = x - 2, that is y^3 - 3 y = 1/2 for x = 1 + y: y = 2 cos.
  const double angle = std::acos(0.25) / 3, third = 2 * std::numbers::pi / 3;
  const auto known = [&](const char* name, double value, double cardano) {
    show.between(name, value, cardano - 1e-7, cardano + 1e-7,
                 "Cardano's solution of x F' = ... in closed form; an extremum to half the digits");
  };
  known("x at the first turning point", first, 1 + 2 * std::cos(angle + 2 * third));
  known("x at the second turning point", second, 1 + 2 * std::cos(angle + third));
  show.near("t at the root", path_parameter(root), 1, 1e-14, "H_F at F = 0; rounding");
}

// ----------------------------------------------------- figure 2.3: Newton's iteration and a limit point

void limit_point(scene::Show& show) {
  const auto curve = williams_curve(0.44);
  const LimitPoints limits = limit_points(*curve).value();
  std::vector<IterationRecord> trace;
  LoadedToggle toggle(Model::williams, 0.44, near_load);
  const Count count = iterate(toggle, {}, &trace);
  const auto load = [&](double d) { return curve->load(d); };
  constexpr std::size_t shown = 4;
  std::vector<double> grid, steps, heights_of_steps;
  for (int i = 0; i <= 300; ++i) grid.push_back(0.75 * i / 300);
  double defect = 0;
  for (std::size_t k = 0; k < shown; ++k) {
    const double from = trace[k].deflection, to = trace[k + 1].deflection;
    steps.insert(steps.end(), {from, to, to});
    heights_of_steps.insert(heights_of_steps.end(), {load(from), near_load, load(to)});
    const double height = load(from) + curve->stiffness(from) * (to - from) - near_load;
    defect = std::max(defect, std::abs(height) / near_load);
  }
  scene::Panel& panel = show.plot("Newton's iteration above the limit load: stays near the limit point",
                                  "deflection of the apex {/:Italic δ} (in)", "load {/:Italic W} (lb)");
  panel.key("bottom right").x_range(0, 0.75).y_range(0, 60);
  panel.note("maximum, 42.77 lb", limits.maximum.deflection, 47.5, "center");
  panel.curve("load of 43.79 lb", {-0.05, 0.75}, {near_load, near_load}, scene::lines(3))
      .curve("Williams' equation, {/:Italic l} sin {/:Italic β} = 0.44 in", grid, std::identity(), load,
             scene::lines(1))
      .curve("Newton's first steps", steps, heights_of_steps, scene::lines(5))
      .curve("limit points", std::array{limits.maximum, limits.minimum}, &CurvePoint::deflection,
             &CurvePoint::load, scene::large_points(3));
  // oracle: homotopy_williams Williams 0.44 maximum
  show.at_most("height of a tangent over the load at the next iterate", defect, 1e-13,
               "the definition (2.2); rounding, amplified where the tangent is flat");
  show.near("limit load", {limits.maximum.load, "lb"}, 42.771896097273, 1e-11,
            "tools/oracles/homotopy_williams.py, all digits");
  show.between(
      "iterations of Newton from rest", count.iterations, 20, 400,
      "regression value: 79 to 125, depending on how the same formula is written, and at most some 400 from "
      "20 001 starts");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-2.1",
           .title = "Newton's iteration where the slope vanishes (drawn)",
           .place = "Figure 2.1",
           .content = scene::Content(flat_slope)},
          {.name = "fig-2.2",
           .title = "A homotopy path with turning points (drawn)",
           .place = "Figure 2.2",
           .content = scene::Content(turning_points)},
          {.name = "fig-2.3",
           .title = "Newton's iteration at a limit point (drawn)",
           .place = "Figure 2.3",
           .content = scene::Content(limit_point)}};
}

}  // namespace nlmech::chapters::homotopy::tangents
