#include <cmath>
#include <numbers>

#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/ivp/picard.hpp"
#include "nlmech/problems/three_mass_chain.hpp"

namespace nlmech::chapters {
namespace {

// ------------------------------------------------------------------------------ figure 4.1, the flow chart

/// Boxes and arrows on a page of 100 by 100.
class FlowChart {
 public:
  void box(double x, double y, double half_width, double half_height) {
    table_.add({"box", x, y, half_width, half_height});
  }
  void diamond(double x, double y, double half_width, double half_height) {
    const double px[] = {x - half_width, x, x + half_width, x, x - half_width};
    const double py[] = {y, y + half_height, y, y - half_height, y};
    for (int i = 0; i < 4; ++i) table_.add({"line", px[i], py[i], px[i + 1] - px[i], py[i + 1] - py[i]});
  }
  /// A path with an arrow's head at its end.
  void arrow(const std::vector<std::pair<double, double>>& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const auto [x, y] = path[i];
      const auto [to_x, to_y] = path[i + 1];
      table_.add({i + 2 == path.size() ? "arrow" : "line", x, y, to_x - x, to_y - y});
    }
  }
  scene::Table take() { return std::move(table_); }

 private:
  scene::Table table_{{{"kind"}, {"x"}, {"y"}, {"dx"}, {"dy"}}};
};

/// x' = n t^(n-1), of the highest degree that the expansion of the chart keeps.
struct Power {
  static constexpr int dimension = 1;
  int n;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& /*x*/, Vector<T, 1>& dxdt) const {
    T power(n);
    for (int i = 1; i < n; ++i) power = power * t;
    dxdt[0] = power;
  }
};

/// Greatest error of one step from 0 to 1 over the orders 2 to 20.
double error_of_powers() {
  double greatest = 0;
  for (int order = 2; order <= 20; ++order) {
    const auto solution =
        ivp::integrate(ivp::System(Power{order}), ivp::State<1>::Zero(), 0, 1, ivp::Mcpi{1, order});
    greatest = std::max(greatest, solution.status.ok() ? std::abs(solution.x[0] - 1) : HUGE_VAL);
  }
  return greatest;
}

scene::Showing draw_flow_chart() {
  FlowChart chart;
  for (const double y : {90.0, 68.0, 44.0}) chart.box(22, y, 20, 7);        // given, nodes, start
  chart.box(22, 11, 20, 7);                                                 // end of the step
  for (const double y : {90.0, 71.0, 52.0, 33.0}) chart.box(72, y, 23, 7);  // the iteration
  chart.diamond(72, 11, 18, 9);
  chart.arrow({{22, 83}, {22, 75}});
  chart.arrow({{22, 61}, {22, 51}});
  chart.arrow({{42, 44}, {45.5, 44}, {45.5, 90}, {49, 90}});
  for (const double y : {83.0, 64.0, 45.0}) chart.arrow({{72, y}, {72, y - 5}});
  chart.arrow({{72, 26}, {72, 20}});
  chart.arrow({{90, 11}, {98, 11}, {98, 90}, {95, 90}});
  chart.arrow({{54, 11}, {42, 11}});
  chart.arrow({{22, 18}, {22, 37}});
  return {scene::Figure{chart.take(), "rbf_ivp-flow-chart", {}},
          {},
          {scene::at_most("error of one step on x' = N t^(N-1), orders N = 2 to 20", "1", error_of_powers(),
                          2e-15, "the chart integrates degree N - 1 exactly; a few roundings")}};
}

// ---------------------------------------------------------------------------------- figure 4.30, the chain

/// Polylines of the machine elements, lengths in hundredths of the page's width.
class ChainDrawing {
 public:
  void path(const std::string& kind, const std::vector<std::pair<double, double>>& points) {
    ++paths_;
    for (const auto& [x, y] : points) table_.add({kind, x, y, paths_});
  }
  /// Eight teeth between two straight ends.
  void spring(double x0, double x1, double y) {
    constexpr int teeth = 8;
    constexpr double straight = 0.2, height = 1.6;
    const double begin = x0 + straight * (x1 - x0), pitch = (1 - 2 * straight) * (x1 - x0) / teeth;
    std::vector<std::pair<double, double>> points = {{x0, y}, {begin, y}};
    for (int i = 0; i < teeth; ++i)
      points.emplace_back(begin + (i + 0.5) * pitch, y + (i % 2 == 0 ? height : -height));
    points.emplace_back(x1 - straight * (x1 - x0), y);
    points.emplace_back(x1, y);
    path("element", points);
  }
  /// A cylinder open to the right, and a piston in it.
  void damper(double x0, double x1, double y) {
    constexpr double half = 1.6;
    const double left = x0 + 0.35 * (x1 - x0), right = x0 + 0.65 * (x1 - x0), piston = 0.5 * (x0 + x1);
    path("element", {{x0, y}, {left, y}});
    path("element", {{right, y + half}, {left, y + half}, {left, y - half}, {right, y - half}});
    path("element", {{piston, y + 0.75 * half}, {piston, y - 0.75 * half}});
    path("element", {{piston, y}, {x1, y}});
  }
  /// The wall's surface, hatched away from @p side.
  void wall(double x, double side) {
    path("wall", {{x, -8}, {x, 8}});
    for (int i = 0; i < 8; ++i) path("hatch", {{x, 8.0 - 2 * i}, {x - 2 * side, 6.0 - 2 * i}});
  }
  void mass(double x0, double x1) { path("mass", {{x0, -6}, {x1, -6}, {x1, 6}, {x0, 6}, {x0, -6}}); }
  scene::Table take() { return std::move(table_); }

 private:
  std::int64_t paths_ = 0;
  scene::Table table_{{{"kind"}, {"x"}, {"y"}, {"path", 3, true}}};
};

/// What the drawing says: elements act with opposite forces on their two ends. The sum of all mass times
/// acceleration is then the load and what the two walls exert.
double force_balance() {
  const problems::ThreeMassChain p;
  double greatest = 0;
  for (int i = 0; i < 100; ++i) {
    const double u = i;
    const Vector<double, 3> q(std::sin(u), std::cos(2 * u), std::sin(3 * u + 1)),
        v(std::cos(u), std::sin(5 * u), std::cos(4 * u));
    Vector<double, 3> a;
    p.acceleration(u, q, v, a);
    const double left = p.k1 * q[0] + p.l1 * q[0] * q[0] * q[0] + p.c1 * v[0];
    const double right = p.k4 * q[2] + p.l4 * q[2] * q[2] * q[2] + p.c4 * v[2];
    const double sum = p.m1 * a[0] + p.m2 * a[1] + p.m3 * a[2];
    greatest = std::max(greatest, std::abs(sum - p.force * std::cos(p.frequency * u) + left + right));
  }
  return greatest;
}

scene::Showing draw_chain() {
  ChainDrawing drawing;
  constexpr double element = 15, mass = 10, first = 5;
  drawing.wall(first, 1);
  for (int i = 0; i < 4; ++i) {
    const double left = first + i * (element + mass);
    drawing.spring(left, left + element, 3);
    drawing.damper(left, left + element, -3);
    if (i < 3) drawing.mass(left + element, left + element + mass);
  }
  drawing.wall(first + 4 * element + 3 * mass, -1);
  return {
      scene::Figure{drawing.take(), "rbf_ivp-chain", {{"height", "330"}}},
      {},
      {scene::at_most("imbalance of forces over a hundred states", "1", force_balance(), 4e-15,
                      "Newton's third law for the elements between masses; a dozen roundings of forces up "
                      "to 4")}};
}

}  // namespace

void add_drawings(scene::Chapter& chapter) {
  chapter.add({.name = "fig-4.1",
               .title = "Modified Chebyshev-Picard iteration, step by step (flow chart)",
               .place = "Figure 4.1",
               .needs = {},
               .seconds = 0.1,
               .show = [](scene::Workshop&) { return draw_flow_chart(); }});
  chapter.add({.name = "fig-4.30",
               .title = "Three masses between walls with springs and dampers (drawn)",
               .place = "Figure 4.30",
               .needs = {},
               .seconds = 0.1,
               .show = [](scene::Workshop&) { return draw_chain(); }});
}

}  // namespace nlmech::chapters
