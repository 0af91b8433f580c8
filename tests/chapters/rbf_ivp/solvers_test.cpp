#include "chapters/rbf_ivp/solvers/solvers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nlmech/ivp/collocation/collocation.hpp"

namespace nlmech::chapters::rbf_ivp::solvers_test {
namespace {

using collocation::Basis;
using collocation::NodeFamily;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

Basis radau(int n) { return Basis::polynomial(NodeFamily::left_end_and_radau, n); }

/// Unlike any special state.
VectorXd wave(Eigen::Index size, double phase) {
  VectorXd v(size);
  for (Eigen::Index k = 0; k < size; ++k) v[k] = std::cos(2.3 * static_cast<double>(k) + phase);
  return v;
}

void expect_consistent_products(const Case& c, double h) {
  for (const Form form : {Form::printed, Form::integrated}) {
    CollocationEquations equations(c.system, radau(6), form);
    equations.begin(0.3, h, c.x0);
    const VectorXd x = wave(equations.size(), 0.1), v = wave(equations.size(), 1),
                   w = wave(equations.size(), 2);
    VectorXd bv(x.size()), btw(x.size()), left(x.size()), right(x.size());
    MatrixXd b;
    equations.linearise(x);
    equations.matrix(b);
    equations.apply(v, bv);
    equations.apply_transposed(w, btw);
    // Sums of some 40 products of entries of B.
    const double noise = 100 * eps * b.norm() * v.norm();
    EXPECT_LE((bv - b * v).norm(), noise);
    EXPECT_LE((btw - b.transpose() * w).norm(), noise);
    // F is cubic: the symmetric difference is off by d^2/6 F''' v v v, F''' <= 6 h or 6, and roundings over
    // d.
    const double d = 1e-5;
    equations.residual(x + d * v, right);
    equations.residual(x - d * v, left);
    EXPECT_LE(((right - left) / (2 * d) - bv).norm(), 10 * d * d * v.norm() + noise / d);
  }
}

TEST(CollocationEquations, ProductsAreThoseOfTheDerivative) {
  expect_consistent_products(free_duffing_case(), 0.7);
  expect_consistent_products(impact_case(), 0.7);
  expect_consistent_products(three_mass_case(), 0.7);
}

TEST(CollocationEquations, FormsDifferByAConstantMatrix) {
  const Case& c = free_duffing_case();
  const Basis basis = radau(8);
  CollocationEquations printed(c.system, basis, Form::printed), integrated(c.system, basis, Form::integrated);
  printed.begin(0, 0.7, c.x0);
  integrated.begin(0, 0.7, c.x0);
  const VectorXd x = wave(printed.size(), 0.4);
  VectorXd f(x.size()), g(x.size());
  printed.residual(x, f);
  integrated.residual(x, g);
  const MatrixXd d = basis.derivative().bottomRightCorner(7, 7) / 0.7;
  const MatrixXd expected = Eigen::Map<const MatrixXd>(g.data(), 2, 7) * d.transpose();
  EXPECT_LE((expected - Eigen::Map<const MatrixXd>(f.data(), 2, 7)).norm(), 100 * eps * d.norm() * x.norm());
}

TEST(CollocationEquations, SolutionLeavesTheTruncationErrorAlone) {
  const Case& c = free_duffing_case();
  CollocationEquations equations(c.system, radau(20), Form::integrated);
  equations.begin(0, duffing_period() / 10, c.x0);
  VectorXd x = equations.start(), f(x.size());
  for (std::size_t k = 0; k < equations.times().size(); ++k)
    x.segment(2 * static_cast<Eigen::Index>(k), 2) = c.reference(equations.times()[k]).cast<double>();
  equations.residual(x, f);
  EXPECT_LE(f.cwiseAbs().maxCoeff(), 100 * eps);  // polynomials of degree 19 on a tenth of a period: rounding
  EXPECT_LE(error_at_nodes(c, equations, x), eps);
}

TEST(Solvers, AllFindTheRootThatTheIntegratorFinds) {
  const Case& c = free_duffing_case();
  const double h = duffing_period() / 10;
  const auto method =
      ivp::PolynomialCollocation{.step = h, .nodes = 7, .points = NodeFamily::left_end_and_radau};
  const auto solution = ivp::integrate(c.system, c.x0, 0.0, h, method);
  ASSERT_TRUE(solution.status.ok());
  Interval interval(c, radau(7));
  interval.begin(0, h, c.x0);
  for (const Solver solver : all_solvers) {
    VectorXd x;
    const Cost cost = solve(solver, interval, x, {.reduction = 1e-12});
    ASSERT_TRUE(cost.converged) << to_string(solver);
    // |F| of 1e-12 |F(start)| = 2e-12 or so, times |B^-1|, below 10 in either form here.
    EXPECT_LE((interval.printed.end(x) - solution.x).norm(), 2e-11) << to_string(solver);
    EXPECT_LE(error_at_nodes(c, interval.printed, x), 1e-5) << to_string(solver);  // six stages at P/10
  }
}

TEST(Solvers, CountTheirWork) {
  Interval interval(free_duffing_case(), radau(7));
  interval.begin(0, duffing_period() / 10, free_duffing_case().x0);
  for (const Solver solver : all_solvers) {
    VectorXd x;
    const Cost cost = solve(solver, interval, x, {});
    ASSERT_TRUE(cost.converged);
    EXPECT_EQ(static_cast<std::int64_t>(cost.history.size()), cost.iterations + 1) << to_string(solver);
    EXPECT_EQ(cost.functions, 6 * (cost.iterations + 1)) << to_string(solver);
    EXPECT_EQ(cost.history.front(), 1);
    EXPECT_LE(cost.history.back(), 1e-10);
    EXPECT_EQ(cost.history.back(), cost.reduction);
  }
}

TEST(Solvers, DivergeOrNotAsTheLengthHasIt) {
  const Case& c = free_duffing_case();
  Interval interval(c, radau(40));
  VectorXd x;
  interval.begin(0, duffing_period(), c.x0);
  EXPECT_TRUE(solve(Solver::picard, interval, x, {}).diverged);
  EXPECT_TRUE(solve(Solver::newton, interval, x, {}).converged);
  const Cost flow = solve(Solver::fixed_point_integrated, interval, x, {});
  EXPECT_TRUE(flow.converged);
  EXPECT_GT(flow.iterations, 1000);
  EXPECT_LE(error_at_nodes(c, interval.printed, x), 1e-7);  // N = 35 is right to 4e-8 in D on P
  interval.begin(0, 2.5 * duffing_period(), c.x0);
  EXPECT_FALSE(solve(Solver::newton, interval, x, {}).converged);
  EXPECT_TRUE(solve(Solver::damped_newton, interval, x, {}).converged);
  const Cost short_of_it = solve(Solver::newton_flow_printed, interval, x, {.steps = 1000});
  EXPECT_FALSE(short_of_it.converged);
  EXPECT_FALSE(short_of_it.diverged);
  EXPECT_EQ(short_of_it.iterations, 1000);
}

TEST(Solvers, RowsGoOnFromEndToEndAndStopAtAFailure) {
  const Case& c = free_duffing_case();
  const double P = duffing_period();
  const auto [cost, done] = solve_row(Solver::newton, c, radau(7), P / 10, 5, {});
  EXPECT_TRUE(cost.converged);
  EXPECT_EQ(done, 5);
  EXPECT_GE(cost.iterations, 10);
  const auto [failed, before] = solve_row(Solver::picard, c, radau(30), P, 5, {});
  EXPECT_FALSE(failed.converged);
  EXPECT_TRUE(failed.diverged);
  EXPECT_EQ(before, 0);
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::solvers_test
