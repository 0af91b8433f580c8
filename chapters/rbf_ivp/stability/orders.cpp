#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/implicit/backward_euler.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_ivp::orders {
namespace {

using collocation::NodeFamily;

constexpr double end = 8;  // s

/// Error at the end with steps of a length.
struct Point {
  double step, error;
};

/// A method, its order by theory, and how its error falls.
struct Series {
  std::string method;  ///< with its options; no commas, which the figure's data could not hold
  double expected;     ///< order
  std::string theory;  ///< why
  std::vector<Point> points;

  /// Slope of the two shortest steps.
  [[nodiscard]] double observed() const {
    const Point &fine = points.back(), &coarse = points[points.size() - 2];
    return std::log(coarse.error / fine.error) / std::log(coarse.step / fine.step);
  }
};
using Groups = std::array<std::vector<Series>, 3>;

/// Largest error of a state component of the three masses at the end; they are damped and loaded, so that
/// time and velocities enter.
template <class Method>
Point run(const Method& method) {
  const Case& c = three_mass_case();
  const auto solution = ivp::integrate(c.system, c.x0, 0, end, method);
  if (!solution.status.ok()) throw Failure(solution.status);
  return {end / static_cast<double>(solution.statistics.steps),
          error_at(c, end, solution.x).cwiseAbs().maxCoeff()};
}

/// Five steps, each half as long as the one before; the first is end / @p first.
template <class Method>
Series by_steps(std::string name, double expected, std::string theory, int first, Method method) {
  Series series{std::move(name), expected, std::move(theory), {}};
  for (int k = 0; k < 5; ++k) {
    method.step = end / (first << k);
    series.points.push_back(run(method));
  }
  return series;
}

/// ode45 takes a tolerance; its step is the mean one.
Series ode45() {
  Series series{"ode45", 5, "local extrapolation: the fifth-order value goes on", {}};
  for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10})
    series.points.push_back(
        run(ivp::Ode45{.relative_tolerance = tolerance, .absolute_tolerance = tolerance}));
  return series;
}

/// The three groups of the figure.
Groups all_series() {
  using namespace ivp;
  const char *classical = "order conditions of the method",
             *lobatto = "N - 1: quadrature without the left end", *radau = "2 N - 3: Radau quadrature",
             *flat = "N - 1: polynomials are the limit c h -> 0", *central = "symmetric difference",
             *alpha = "gamma = 1/2 - alpha_m + alpha_f";
  const PolynomialCollocation lgl4 = {.nodes = 4}, lgl5 = {.nodes = 5};
  const PolynomialCollocation radau4 = {.nodes = 4, .points = NodeFamily::left_end_and_radau},
                              radau5 = {.nodes = 5, .points = NodeFamily::left_end_and_radau};
  const Hht printed = {.form = Hht::Form::as_printed};
  return {
      std::vector{by_steps("euler", 1, classical, 80, Euler{}),
                  by_steps("backward-euler", 1, classical, 80, BackwardEuler{}),
                  by_steps("explicit", 2, central, 40, CentralDifference{}),
                  by_steps("newmark", 2, "gamma = 1/2", 40, Newmark{}), by_steps("hht", 2, alpha, 40, Hht{}),
                  by_steps("hht as printed", 1, "Eq. 4.7: (1 + alpha)(1/2 - alpha) is not 1/2", 40, printed),
                  by_steps("generalized-alpha", 2, alpha, 40, GeneralizedAlpha{})},
      std::vector{by_steps("rk4", 4, classical, 20, Rk4{}), by_steps("rk6", 6, classical, 20, Rk6{}), ode45(),
                  by_steps("mcpi N = 4", 4, "N even: quadrature of degree N - 1", 20, Mcpi{.order = 4}),
                  by_steps("mcpi N = 5", 6, "N odd: quadrature of degree N", 10, Mcpi{.order = 5})},
      std::vector{by_steps("lgl N = 4", 3, lobatto, 10, lgl4), by_steps("lgl N = 5", 4, lobatto, 10, lgl5),
                  by_steps("radau N = 4", 5, radau, 10, radau4), by_steps("radau N = 5", 7, radau, 5, radau5),
                  // Not flatter: their matrix has a condition like (c h)^(2 - 2 N), 6e7 here.
                  by_steps("rbf-coll N = 4 c = 1", 3, flat, 10, RbfCollocation{.nodes = 4, .shape = 1}),
                  by_steps("rbf-coll N = 5 c = 1", 4, flat, 8, RbfCollocation{.nodes = 5, .shape = 1}),
                  by_steps("rbf-coll N = 7 c h = 1.5", 0, "N odd: R(0) = 1 but R'(0) is not", 10,
                           RbfCollocation{.nodes = 7}),
                  by_steps("rbf-coll N = 8 c h = 1.75", -1, "N even: R(0) is not 1", 10,
                           RbfCollocation{.nodes = 8})}};
}

/// The order of a method in the table.
struct Order {
  std::string method;
  double expected, observed;
  std::string how;
};

/// Orders for linear equations.
std::vector<Order> linear_orders() {
  std::vector<Order> orders;
  const Digits50 z = Digits50(1) / 100;
  const auto add = [&](const char* name, double expected, NodeFamily family, int n) {
    orders.push_back({fmt::format("{} N = {}", name, n), expected,
                      linear_order(polynomial_derivative(family, n), z),
                      "R(z) - exp(z), 50 digits, z = 1/100 and 1/200"});
  };
  for (int n = 4; n <= 8; ++n) {
    add("lgl", n - 1, NodeFamily::legendre_gauss_lobatto, n);
    add("radau", 2 * n - 3, NodeFamily::left_end_and_radau, n);
  }
  return orders;
}

/// Growth R(0) of the solution of x' = 0 in a step by Gaussians with c h = (N - 1)/4, less 1.
double growth_of_rest(int nodes) {
  const auto derivative = radial_derivative(NodeFamily::legendre_gauss_lobatto, nodes, (nodes - 1) / 4.0);
  return static_cast<double>(Digits50(stability_function(derivative, Digits50(0)) - 1));
}

void draw(const Groups& groups, scene::Show& show) {
  scene::Plot& plot = show.plots("Every method has its order; with c h fixed none is left");
  scene::Table data({{"group"}, {"method", 3, true}, {"step"}, {"error"}});
  constexpr std::array low = {0.004, 0.02, 0.03}, high = {0.25, 1.2, 2.0};
  int block = 0;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    const double left = 0.12 + static_cast<double>(group) * 0.298;
    scene::Panel& panel = plot.panel("step (s)", group == 0 ? "largest error at 8 s" : "");
    panel.place(left, left + 0.265, 0.44, 0.91).log_x(low[group], high[group]).log_y(1e-14, 1);
    panel.set("xtics (0.01, 0.1, 1)").set("format x '%g'").set("ytics 1e3");
    if (group > 0) panel.set("format y ''");
    panel.key(
        fmt::format("at screen {:g}, screen 0.31 left top maxrows 8 samplen 3 spacing 1.1 "
                    "font 'sans-serif,12'",
                    left - 0.02));
    for (const Series& s : groups[group]) {
      for (const Point& p : s.points) data.add({group + 1, s.method, p.step, p.error});
      panel.columns(s.method, "step:error", {"linespoints"}, block++);
    }
  }
  plot.size(760, 600).data(std::move(data));
}

void put(const Groups& groups, const std::vector<Order>& linear, scene::Show& show) {
  draw(groups, show);
  std::vector<Order> orders;
  for (const std::vector<Series>& group : groups) {
    for (const Series& s : group) {
      orders.push_back({s.method, s.expected, s.observed(),
                        fmt::format("three masses to 8 s, steps {:.3g} and {:.3g} s",
                                    s.points[s.points.size() - 2].step, s.points.back().step)});
      show.between("observed order of " + s.method, s.observed(), s.expected - 0.05, s.expected + 0.05,
                   s.theory + "; 0.05 for the next term of the error at these steps");
    }
  }
  for (const Order& o : linear) {
    orders.push_back(o);
    show.between("linear order of " + o.method, o.observed, o.expected - 0.02, o.expected + 0.02,
                 "theory; the next term of R(z) - exp(z) shifts it by a fraction of z");
  }
  show.table(orders, {{"method", &Order::method},
                      {"expected order", &Order::expected},
                      {"observed order", &Order::observed, 4},
                      {"how", &Order::how}});
  for (const int nodes : {7, 35}) {
    show.at_most(
        fmt::format("|R(0) - 1| of Gaussians, N = {}", nodes), std::abs(growth_of_rest(nodes)), 1e-30,
        "D of an odd number of nodes has a symmetric null vector: 0, but for 50 digits and the condition");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result series("errors-against-step", "three masses to 8 s; largest error of a state component",
                             all_series);
  const scene::Result linear(
      "linear-orders", "stability functions of collocation, left end and N - 1 further nodes, 50 digits",
      linear_orders);
  return {{.name = "orders",
           .title = "Observed order of every method",
           .content = scene::Content(put, series, linear)}};
}

}  // namespace nlmech::chapters::rbf_ivp::orders
