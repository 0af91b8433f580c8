#include "nlmech/program/partials.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::program::partials_test {
namespace {

/// An expression with all operations of two operands and a few functions, by x and y; the time is fixed.
Equations example() {
  return Equations(SourceText(
      "test", "x' = sin(x y)/(1 + y^2) + x^y - sqrt(x)*exp(-y) + atan2(y, x) + t*x^2.5; y' = 1/x"));
}

Vector<double, Eigen::Dynamic> point() { return Eigen::Vector2d(1.25, 0.75); }

// Dual numbers have the same derivatives by another way.
TEST(Partials, AreThoseOfDualNumbers) {
  const Equations equations = example();
  Graph graph = equations.graph();
  using D = Dual<double, 2>;
  Vector<D, Eigen::Dynamic> at(2);
  for (int i = 0; i < 2; ++i) at[i] = D::variable(point()[i], i);
  const double t = 0.5;
  for (const NodeId slope : equations.slopes()) {
    const Program derivatives(graph, partials(graph, slope, 0, 2));
    Program(graph, {slope}).run(D(t), at, 0, 1, [&](int, const D& expected) {
      derivatives.run(t, point(), 0, 2, [&](int i, double value) {
        // A few rounding errors of terms of size 4.
        EXPECT_NEAR(value, expected.partial[static_cast<std::size_t>(i)], 16 * 4 * 2.2e-16) << i;
      });
    });
  }
}

TEST(Partials, OfALinearExpressionAreNumbers) {
  Equations equations = example();
  const NodeId linear = equations.expression("test", "3 x - 2 y + t^2");
  Graph graph = equations.graph();
  const std::vector<NodeId> slopes = partials(graph, linear, 0, 2);
  EXPECT_TRUE(graph.is_number(slopes[0], 3));
  EXPECT_TRUE(graph.is_number(slopes[1], -2));
}

// With t = 2 s, x = u and y = 1/u.
TEST(Substituted, ReplacesTimeAndComponents) {
  const Equations equations = example();
  Graph graph(1);
  const NodeId u = Graph::state(0);
  const std::vector<NodeId> variables{graph.product(graph.number(2), Graph::time()), u,
                                      graph.quotient(graph.number(1), u)};
  const std::vector<NodeId> made = substituted(equations.graph(), equations.slopes(), graph, variables);
  const double s = 0.25, at = 1.25;
  double expected = 0, value = 0;
  Program(equations.graph(), {equations.slopes()[0]})
      .run(2 * s, Vector<double, Eigen::Dynamic>(Eigen::Vector2d(at, 1 / at)), 0, 1,
           [&](int, double v) { expected = v; });
  Program(graph, {made[0]})
      .run(s, Vector<double, Eigen::Dynamic>(Vector<double, 1>(at)), 0, 1, [&](int, double v) { value = v; });
  EXPECT_NEAR(value, expected, 16 * 2.2e-16);
}

}  // namespace
}  // namespace nlmech::program::partials_test
