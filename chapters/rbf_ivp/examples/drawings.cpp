#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/drawing.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::rbf_ivp::drawings {
namespace {

// ------------------------------------------------------------------------------ figure 4.1, the flow chart

/// x' = n t^(n-1), of the highest degree in the expansion of the chart.
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

/// Largest error of one step from 0 to 1 over the orders 2 to 20.
double error_of_powers() {
  double greatest = 0;
  for (int order = 2; order <= 20; ++order) {
    const auto solution =
        ivp::integrate(ivp::System(Power{order}), ivp::State::Zero(1), 0, 1, ivp::Mcpi{1, order});
    greatest = std::max(greatest, solution.status.ok() ? std::abs(solution.x[0] - 1) : HUGE_VAL);
  }
  return greatest;
}

void draw_flow_chart(scene::Show& show) {
  FlowChart chart;
  constexpr Spot left{20, 7}, right{23, 7};  // half of the sides
  chart.box({22, 90}, left,
            {"{/:Bold given}", "state x_0 at t_0, step {/:Italic h},",
             "order {/:Italic N}, nodes 0, …, {/:Italic M} ≥ {/:Italic N}"});
  chart.box({22, 68}, left,
            {"{/:Bold nodes}", "τ_j = −cos({/:Italic jπ}/{/:Italic M})",
             "{/:Italic t_j} = {/:Italic t}_0 + {/:Italic h} (1 + τ_j)/2"});
  chart.box({22, 44}, left, {"{/:Bold start}", "x_j = x_0 at all nodes"});
  chart.box({22, 11}, left, {"{/:Bold end of the step}", "x({/:Italic t}_0 + {/:Italic h}) = x_M"});
  chart.box({72, 90}, right, {"{/:Bold right-hand sides}", "g_j = ({/:Italic h}/2) f({/:Italic t_j}, x_j)"});
  chart.box({72, 71}, right,
            {"{/:Bold expand} up to the degree {/:Italic N} − 1",
             "F_k = (2/{/:Italic M}) Σ″ g_j {/:Italic T}_k(τ_j)"});
  chart.box(
      {72, 52}, right,
      {"{/:Bold integrate} term by term", "β_r = (F_{r − 1} − F_{r + 1})/(2{/:Italic r}), β_0 from x_0"});
  chart.box({72, 33}, right, {"{/:Bold evaluate}", "x_j = Σ β_r {/:Italic T}_r(τ_j)"});
  chart.decision({72, 11}, {18, 9}, {"have all x_j", "converged?"});
  chart.arrow({{22, 83}, {22, 75}});
  chart.arrow({{22, 61}, {22, 51}});
  chart.arrow({{42, 44}, {45.5, 44}, {45.5, 90}, {49, 90}});
  for (const double y : {83.0, 64.0, 45.0}) chart.arrow({{72, y}, {72, y - 5}});
  chart.arrow({{72, 26}, {72, 20}});
  chart.arrow({{90, 11}, {98, 11}, {98, 90}, {95, 90}});
  chart.arrow({{54, 11}, {42, 11}});
  chart.arrow({{22, 18}, {22, 37}});
  chart.note("yes", {48, 13.5});
  chart.note("no", {93, 13.5});
  chart.note("next step", {29.5, 27});
  show.draw(chart.take("MCPI: expand the right-hand side, integrate term by term, repeat"));
  show.at_most("error of one step on x' = N t^(N-1), orders N = 2 to 20", error_of_powers(), 2e-15,
               "the chart integrates degree N - 1 exactly; a few roundings");
}

// ---------------------------------------------------------------------------------- figure 4.30, the chain

/// Draws a spring: eight teeth between two straight ends.
void draw_spring(Drawing& d, double x0, double x1, double y) {
  constexpr int teeth = 8;
  constexpr double straight = 0.2, height = 1.6;
  const double begin = x0 + straight * (x1 - x0), pitch = (1 - 2 * straight) * (x1 - x0) / teeth;
  std::vector<Spot> points = {{x0, y}, {begin, y}};
  for (int i = 0; i < teeth; ++i)
    points.push_back({begin + (i + 0.5) * pitch, y + (i % 2 == 0 ? height : -height)});
  points.push_back({x1 - straight * (x1 - x0), y});
  points.push_back({x1, y});
  d.path("outline", points);
}

/// Draws a damper: a cylinder open to the right with a piston.
void draw_damper(Drawing& d, double x0, double x1, double y) {
  constexpr double half = 1.6;
  const double left = x0 + 0.35 * (x1 - x0), right = x0 + 0.65 * (x1 - x0), piston = 0.5 * (x0 + x1);
  d.path("outline", {{x0, y}, {left, y}});
  d.path("outline", {{right, y + half}, {left, y + half}, {left, y - half}, {right, y - half}});
  d.path("outline", {{piston, y + 0.75 * half}, {piston, y - 0.75 * half}});
  d.path("outline", {{piston, y}, {x1, y}});
}

/// Draws the surface of a wall, hatched away from @p side.
void draw_wall(Drawing& d, double x, double side) {
  d.path("ground", {{x, -8}, {x, 8}});
  for (int i = 0; i < 8; ++i) d.path("hatch", {{x, 8.0 - 2 * i}, {x - 2 * side, 6.0 - 2 * i}});
}

/// Draws a mass and its displacement from rest.
void draw_mass(Drawing& d, double x0, double x1, int number) {
  const double middle = 0.5 * (x0 + x1);
  d.path("body", {{x0, -6}, {x1, -6}, {x1, 6}, {x0, 6}, {x0, -6}});
  d.text(fmt::format("m_{}", number), {middle, 0});
  d.path("outline", {{middle, 7}, {middle, 10}});
  d.arrow({middle, 8.5}, {middle + 6, 8.5}, "axis");
  d.text(fmt::format("x_{}", number), {middle + 3.5, 11.2});
}

/// Largest imbalance of the drawn system. Elements exert opposite forces on their ends, so the sum of mass
/// times acceleration is the load plus the forces of the two walls.
double force_balance() {
  const problems::TextProblem chain("three-dof");
  const auto p = [&chain](const char* name) { return chain.parameter(name); };
  double greatest = 0;
  for (int i = 0; i < 100; ++i) {
    const double u = i;
    const Vector<double, 3> q(std::sin(u), std::cos(2 * u), std::sin(3 * u + 1)),
        v(std::cos(u), std::sin(5 * u), std::cos(4 * u));
    Vector<double, 3> a;
    chain.acceleration(u, q, v, a);
    const double left = p("k1") * q[0] + p("l1") * q[0] * q[0] * q[0] + p("c1") * v[0];
    const double right = p("k4") * q[2] + p("l4") * q[2] * q[2] * q[2] + p("c4") * v[2];
    const double sum = p("m1") * a[0] + p("m2") * a[1] + p("m3") * a[2];
    greatest = std::max(greatest, std::abs(sum - p("force") * std::cos(p("frequency") * u) + left + right));
  }
  return greatest;
}

void draw_chain(scene::Show& show) {
  Drawing d;
  constexpr double element = 15, mass = 10, first = 5;
  draw_wall(d, first, 1);
  for (int i = 0; i < 4; ++i) {
    const double left = first + i * (element + mass), right = left + element;
    draw_spring(d, left, right, 3);
    draw_damper(d, left, right, -3);
    d.text(fmt::format("k_{}, l_{}", i + 1, i + 1), {0.5 * (left + right), 7.4});
    d.text(fmt::format("c_{}", i + 1), {0.5 * (left + right), -7.2});
    if (i < 3) draw_mass(d, right, right + mass, i + 1);
  }
  draw_wall(d, first + 4 * element + 3 * mass, -1);
  d.arrow({43, -10}, {51, -10}, "force");
  d.text("{/:Italic F} cos Ω{/:Italic t} on m_2", {60.5, -10});
  show.draw(d.take({{"heading", "A linear and a cubic spring and a damper on either side of each mass"},
                    {"xrange", "[1:99]"},
                    {"yrange", "[-15:17]"},
                    {"height", "330"},
                    {"head", "1.2"}}));
  show.at_most("imbalance of forces over a hundred states", force_balance(), 4e-15,
               "Newton's third law for the elements between masses; a dozen roundings of forces up to 4");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "fig-4.1",
           .title = "Modified Chebyshev-Picard iteration, step by step (flow chart)",
           .place = "Figure 4.1",
           .content = scene::Content(draw_flow_chart)},
          {.name = "fig-4.30",
           .title = "Three masses between walls with springs and dampers (drawn)",
           .place = "Figure 4.30",
           .content = scene::Content(draw_chain)}};
}

}  // namespace nlmech::chapters::rbf_ivp::drawings
