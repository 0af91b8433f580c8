#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/ivp/backward_euler.hpp"
#include "nlmech/ivp/central_difference.hpp"
#include "nlmech/ivp/collocation.hpp"
#include "nlmech/ivp/dormand_prince.hpp"
#include "nlmech/ivp/explicit_runge_kutta.hpp"
#include "nlmech/ivp/generalized_alpha.hpp"
#include "nlmech/ivp/hht.hpp"
#include "nlmech/ivp/newmark.hpp"
#include "nlmech/ivp/picard.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using collocation::NodeFamily;
using scene::Workshop;

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

/// Largest error of a state component of the three masses at the end; they are damped and loaded, so that
/// time and velocities enter.
template <class Method>
Point run(const Method& method) {
  const Case<6>& c = three_mass_case();
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
std::array<std::vector<Series>, 3> all_series() {
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
                  by_steps("rbf-coll N = 4 c = 0.3", 3, flat, 10, RbfCollocation{.nodes = 4, .shape = 0.3}),
                  by_steps("rbf-coll N = 5 c = 1", 4, flat, 8, RbfCollocation{.nodes = 5, .shape = 1}),
                  by_steps("rbf-coll N = 7 c h = 1.5", 0, "N odd: R(0) = 1 but R'(0) is not", 10,
                           RbfCollocation{.nodes = 7}),
                  by_steps("rbf-coll N = 8 c h = 1.75", -1, "N even: R(0) is not 1", 10,
                           RbfCollocation{.nodes = 8})}};
}

/// Orders for linear equations, of N nodes each.
struct LinearOrders {
  int nodes;
  double lobatto, radau;
};

std::vector<LinearOrders> linear_orders() {
  std::vector<LinearOrders> orders;
  const Digits50 z = Digits50(1) / 100;
  for (int n = 4; n <= 8; ++n) {
    orders.push_back({n, linear_order(polynomial_derivative(NodeFamily::legendre_gauss_lobatto, n), z),
                      linear_order(polynomial_derivative(NodeFamily::left_end_and_radau, n), z)});
  }
  return orders;
}

/// Growth R(0) of the solution of x' = 0 in a step by Gaussians with c h = (N - 1)/4, less 1.
double growth_of_rest(int nodes) {
  const auto derivative = radial_derivative(NodeFamily::legendre_gauss_lobatto, nodes, (nodes - 1) / 4.0);
  return static_cast<double>(Digits50(stability_function(derivative, Digits50(0)) - 1));
}

scene::Showing show(const std::array<std::vector<Series>, 3>& groups,
                    const std::vector<LinearOrders>& linear) {
  scene::Table data({{"group"}, {"method", 3, true}, {"step"}, {"error"}});
  scene::Table table({{"method"}, {"expected order"}, {"observed order", 4}, {"how"}});
  scene::Showing showing;
  std::string legend;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const Series& s : groups[group]) {
      for (const Point& p : s.points) data.add({std::int64_t(group + 1), s.method, p.step, p.error});
      legend += fmt::format("{}{} {}", legend.empty() ? "" : "|", group + 1, s.method);
      table.add({s.method, s.expected, s.observed(),
                 fmt::format("three masses to 8 s, steps {:.3g} and {:.3g} s",
                             s.points[s.points.size() - 2].step, s.points.back().step)});
      showing.quantities.push_back({"observed order of " + s.method, "1", s.observed(), s.expected - 0.05,
                                    s.expected + 0.05,
                                    s.theory + "; 0.05 for the next term of the error at these steps"});
    }
  }
  for (const LinearOrders& o : linear) {
    const auto add = [&](const char* family, double expected, double observed) {
      const std::string name = fmt::format("{} N = {}", family, o.nodes);
      table.add({name, expected, observed, "R(z) - exp(z), 50 digits, z = 1/100 and 1/200"});
      showing.quantities.push_back({"linear order of " + name, "1", observed, expected - 0.02,
                                    expected + 0.02,
                                    "theory; the next term of R(z) - exp(z) shifts it by a fraction of z"});
    };
    add("lgl", o.nodes - 1, o.lobatto);
    add("radau", 2 * o.nodes - 3, o.radau);
  }
  showing.table = std::move(table);
  for (const int nodes : {7, 35}) {
    showing.quantities.push_back(scene::at_most(
        fmt::format("|R(0) - 1| of Gaussians, N = {}", nodes), "1", std::abs(growth_of_rest(nodes)), 1e-30,
        "D of an odd number of nodes has a symmetric null vector: 0, but for 50 digits and the condition"));
  }
  showing.figure = {std::move(data),
                    "rbf_ivp-orders",
                    {{"heading", "Every method has its order; radial functions with c h fixed have none"},
                     {"legend", legend},
                     {"height", "600"}}};
  return showing;
}

}  // namespace

void add_orders(scene::Chapter& chapter) {
  const auto& series = chapter.add_run<std::array<std::vector<Series>, 3>>(
      "errors-against-step", "three masses to 8 s; largest error of a state component", {},
      [](Workshop&) { return all_series(); });
  const auto& linear = chapter.add_run<std::vector<LinearOrders>>(
      "linear-orders", "stability functions of collocation, left end and N - 1 further nodes, 50 digits", {},
      [](Workshop&) { return linear_orders(); });
  chapter.add({.name = "orders",
               .title = "Observed order of every method",
               .place = "our own",
               .needs = {&series, &linear},
               .show = [&series, &linear](Workshop& w) { return show(w.result(series), w.result(linear)); }});
}

}  // namespace nlmech::chapters::rbf_ivp
