/// Misprints of sections 5.1 to 5.3: printed and corrected form, both against an independent oracle.
#include <gtest/gtest.h>

#include <cmath>

#include "chapters/rbf_inverse/duffing_runs.hpp"
#include "nlmech/bvp/solve.hpp"
#include "nlmech/collocation/nodes.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;

/// x(T) and J of the oscillator from x(0) = (a, b) under the force f(t), by the classical Runge-Kutta method
/// with 2000 steps: 1e-9 and better here.
struct Trip {
  Eigen::Vector2d end;
  double effort;  ///< integral of f^2/2
};
template <class Force>
Trip drive(Eigen::Vector2d x, double beta, double T, const Force& force) {
  constexpr int steps = 2000;
  const double h = T / steps;
  const auto slope = [&](double t, const Eigen::Vector2d& y) {
    return Eigen::Vector2d(y[1], force(t) - y[0] - beta * y[0] * y[0] * y[0]);
  };
  double effort = 0;
  for (int k = 0; k < steps; ++k) {
    const double t = k * h;
    const Eigen::Vector2d a = slope(t, x), b = slope(t + h / 2, x + h / 2 * a),
                          c = slope(t + h / 2, x + h / 2 * b), d = slope(t + h, x + h * c);
    x += h / 6 * (a + 2 * b + 2 * c + d);
    const double f0 = force(t), f1 = force(t + h / 2), f2 = force(t + h);
    effort += h / 12 * (f0 * f0 + 4 * f1 * f1 + f2 * f2);
  }
  return {x, effort};
}

/// The cheapest free extremal of a short time, which Newton's iteration finds from zero.
bvp::Extremal free_extremal(bvp::DuffingSettings settings) {
  const bvp::Extremal e =
      solve_extremal(duffing_problem(settings), bvp::constant_start(Eigen::VectorXd::Zero(4)));
  EXPECT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  return e;
}

// Eq. 5.19 writes L as an integral; only L = f^2/2 makes f = -lambda2 a stationary point of Eq. 5.20.
TEST(ErrataControl, RunningCostIsTheIntegrand) {
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::free, 1);
  const bvp::Extremal e = free_extremal(settings);
  const auto cost = [&](double amount, int half_waves) {
    const auto force = [&](double t) {
      return -e.solution.at(t)[3] + amount * std::cos(half_waves * 3.14159265358979 * t);
    };
    const Trip trip = drive({0, 0}, settings.beta, 1, force);
    return trip.effort + (trip.end - settings.target).squaredNorm() / 2;
  };
  EXPECT_NEAR(cost(0, 0), e.cost, 1e-8);  // Runge and Kutta's error
  for (const int half_waves : {0, 1, 3}) {
    constexpr double d = 1e-3;
    const double slope = (cost(d, half_waves) - cost(-d, half_waves)) / (2 * d);
    const double bend = (cost(d, half_waves) + cost(-d, half_waves) - 2 * cost(0, 0)) / (d * d);
    EXPECT_NEAR(slope, 0, 1e-5) << half_waves;  // d^2 times third derivatives, and the interpolant
    EXPECT_GT(bend, 0.3) << half_waves;         // and it is a minimum
  }
}

// After Eq. 5.7 the term of x(t0) loses phi_x, though Table 5.1 keeps it. The end conditions that follow from
// Eq. 5.6 make J stationary in a free x2(0); here phi does not depend on it and both agree, so that the
// condition is lambda2(0) = 0 and a shift of x2(0) changes J in the second order only.
TEST(ErrataControl, FreeInitialVelocityHasNoCostate) {
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::x1x2, 1);
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  const bvp::Extremal e = solve_extremal(problem, bvp::unforced_start(settings, {0, 1}, false));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  EXPECT_NEAR(e.solution.first()[3], 0, 1e-10);  // tolerance of the solve
  // dJ/dx2(0) at a fixed force is lambda2(0) once the miss of x2(T) is charged with its multiplier.
  const auto charged = [&](double shift) {
    const auto force = [&](double t) { return -e.solution.at(t)[3]; };
    const Eigen::Vector2d start(e.solution.first()[0], e.solution.first()[1] + shift);
    const Trip trip = drive(start, settings.beta, 1, force);
    const double off = trip.end[0] - settings.target[0];
    return trip.effort + off * off / 2 + e.solution.last()[3] * (trip.end[1] - settings.target[1]);
  };
  constexpr double d = 1e-4;
  EXPECT_NEAR((charged(d) - charged(-d)) / (2 * d), 0, 1e-5);
}

// Table 5.1, first row: lambda(t0) = 0 holds where x(t0) is free. Where x(t0) is prescribed as well
// (Eq. 5.26) it contradicts the target: without force an oscillator at rest stays there.
TEST(ErrataControl, FirstRowOfTableIsForAFreeStart) {
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::final_only, 1);
  const bvp::Extremal e =
      solve_extremal(duffing_problem(settings), bvp::unforced_start(settings, settings.target, true));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  EXPECT_LE(e.solution.first().tail(2).norm(), 1e-10);
  EXPECT_LE(e.cost, 1e-12);
  const Trip rest = drive({0, 0}, settings.beta, 1, [](double) { return 0.0; });
  EXPECT_EQ(rest.end.norm(), 0);
  EXPECT_GT((rest.end - settings.target).norm(), 5);
}

// Eq. 5.24 prints a dot on lambda1(T): as a condition on the derivative it is missed by the solution of 5.23.
TEST(ErrataControl, EndConditionIsOnTheCostateItself) {
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::free, 1);
  const bvp::Extremal e = free_extremal(settings);
  const Eigen::VectorXd z = e.solution.last();
  const double off = z[0] - settings.target[0], derivative = z[3] * (1 + 3 * settings.beta * z[0] * z[0]);
  EXPECT_NEAR(z[2], off, 1e-9);
  EXPECT_GT(std::abs(derivative - off), 0.1);
}

// Eq. 5.9: the roots of (1 - tau^2) p_N' are N + 1 nodes, so "N nodes" takes p_{N-1}.
TEST(ErrataControl, NodesAreRootsOfTheLegendreDerivative) {
  constexpr int nodes = 40;
  const Eigen::VectorXd tau = collocation::legendre_gauss_lobatto(nodes);
  ASSERT_EQ(tau.size(), nodes);
  const auto derivative = [](int n, double x) {
    double before = 1, p = x;
    for (int i = 1; i < n; ++i) {
      const double next = ((2 * i + 1) * x * p - i * before) / (i + 1);  // Eq. 5.8 with p_1 = tau
      before = p;
      p = next;
    }
    return n * (before - x * p) / (1 - x * x);
  };
  for (Eigen::Index k = 1; k + 1 < nodes; ++k) {
    // p'' there is at most N (N + 1)/(1 - tau^2); a rounding of tau.
    const double slack = 64 * 2.2e-16 * nodes * nodes / (1 - tau[k] * tau[k]);
    EXPECT_LE(std::abs(derivative(nodes - 1, tau[k])), slack) << k;
    EXPECT_GT(std::abs(derivative(nodes, tau[k])), 0.1) << k;
  }
}

// Eq. 5.34 against the differences of Eq. 5.32.
TEST(ErrataControl, HarmonicTargetIsAPointOfItsMotion) {
  const auto motion = [](double t) { return 1.5 * std::cos(3 * t) + 2 * std::cos(9 * t) + 3 * std::cos(t); };
  for (const double T : {1.0, 2.0, 5.0}) {
    const Eigen::Vector2d target = duffing_target(printed_settings(DuffingCase::harmonic, T));
    constexpr double h = 1e-4;
    EXPECT_NEAR(target[0], motion(T), 1e-14);
    EXPECT_NEAR(target[1], (motion(T + h) - motion(T - h)) / (2 * h), 4e-6);  // h^2/6 times 9^3 2
  }
}

// Table 5.3 has 1.9e-17 for x1(T) - 5. No double lies between 5 and 5 + 8.8e-16, or 5 - 8.8e-16.
TEST(ErrataControl, NoSuchResidualInDouble) {
  EXPECT_GE(std::nextafter(5.0, 6.0) - 5.0, 8e-16);
  EXPECT_GE(5.0 - std::nextafter(5.0, 4.0), 8e-16);
  EXPECT_GE(std::nextafter(2.0, 3.0) - 2.0, 4e-16);
}

}  // namespace
}  // namespace nlmech::chapters
