/// Misprints of sections 5.1 to 5.3: printed and corrected form against an independent oracle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/bvp/optimal_control/dual_control.hpp"
#include "nlmech/bvp/solve.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/program/runge_kutta.hpp"

namespace nlmech::chapters::rbf_inverse::errata_control_test {
namespace {

using bvp::DuffingCase;
using tests::expect_erratum;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// x(T) and J of the oscillator from x(0) = (a, b) under the force f(t), by the classical Runge-Kutta method
/// with 2000 steps: 1e-9 and better here.
struct Trip {
  Eigen::Vector2d end;
  double effort;  ///< integral of f^2/2
};
template <class Force>
Trip drive(const Eigen::Vector2d& x, double beta, double T, const Force& force) {
  const auto field = [&](double t, const std::array<double, 3>& y) {
    const double f = force(t);
    return std::array{y[1], f - y[0] - beta * y[0] * y[0] * y[0], f * f / 2};
  };
  const auto end = tests::runge_kutta(field, std::array{x[0], x[1], 0.0}, 0, T, 2000);
  return {{end[0], end[1]}, end[2]};
}

/// The cheapest free extremal for a short time, which Newton's iteration finds from zero.
bvp::Extremal free_extremal(const bvp::DuffingSettings& settings) {
  bvp::Extremal e = solve_extremal(duffing_problem(settings), bvp::constant_start(Eigen::VectorXd::Zero(4)));
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

// With the integral as L the cost integrates it again, T times itself: the stationary point of J is no longer
// at -lambda2. Derivatives of both J for an additional constant force, in units of that of the effort; error
// of the Runge-Kutta method over the difference.
TEST(ErrataControl, RunningCostIsIntegratedOnce) {
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::free, 0.5);
  const bvp::Extremal e = free_extremal(settings);
  struct Costs {
    double effort, miss;
  };
  const auto costs = [&](double amount) {
    const Trip trip =
        drive({0, 0}, settings.beta, 0.5, [&](double t) { return -e.solution.at(t)[3] + amount; });
    return Costs{trip.effort, (trip.end - settings.target).squaredNorm() / 2};
  };
  constexpr double d = 1e-3;
  const Costs more = costs(d), less = costs(-d);
  const double effort = (more.effort - less.effort) / (2 * d), miss = (more.miss - less.miss) / (2 * d);
  expect_erratum("rbf_inverse-5.19", {.printed = 0.5 * effort + miss,
                                      .corrected = effort + miss,
                                      .oracle = 0,
                                      .tolerance = 1e-5,
                                      .scale = std::abs(effort)});
}

// After Eq. 5.7 the term of x(t0) lacks phi_x, though Table 5.1 has it. The end conditions from Eq. 5.6 make
// J stationary for a free x2(0); here phi does not depend on it and both agree: the condition is lambda2(0) =
// 0, and a shift of x2(0) changes J in second order only.
TEST(ErrataControl, FreeInitialVelocityHasNoCostate) {
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::x1x2, 1);
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  const bvp::Extremal e = solve_extremal(problem, bvp::unforced_start(settings, {0, 1}, false));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  EXPECT_NEAR(e.solution.first()[3], 0, 1e-10);  // tolerance of the solve
  // dJ/dx2(0) for a fixed force is lambda2(0), if the miss of x2(T) is weighted by its multiplier.
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

/// x' = u with J = 2 (x(0) - 1)^2 + integral u^2/2: an end cost of the start.
struct Pull {
  static constexpr int states = 1;    ///< x
  static constexpr int controls = 1;  ///< u
  template <class T>
  void dynamics(const T& /*t*/, const Vector<T, 1>& /*x*/, const Vector<T, 1>& u, const T& /*mu*/,
                Vector<T, 1>& g) const {
    g[0] = u[0];
  }
  template <class T>
  T running_cost(const T& /*t*/, const Vector<T, 1>& /*x*/, const Vector<T, 1>& u, const T& /*mu*/) const {
    return u[0] * u[0] / 2.0;
  }
  template <class T>
  T end_cost(const Vector<T, 1>& x0, const Vector<T, 1>& /*xF*/, const T& /*tF*/) const {
    return 2.0 * (x0[0] - 1.0) * (x0[0] - 1.0);
  }
};

// With a cost that depends on x(t0) the missing phi_x matters: without it lambda(t0) = 0, so u = 0 and x(0) =
// x(T) = 3. The oracle uses no co-state: with u constant on ten pieces the minimum of J for x(T) = 3 is a
// linear system for x(0), the pieces and one multiplier; the optimal u is constant.
TEST(ErrataControl, InitialCostBelongsToTheInitialCostate) {
  constexpr int pieces = 10, n = pieces + 2;
  constexpr double T = 2, h = T / pieces;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  k(0, 0) = k(0, n - 1) = k(n - 1, 0) = 1;
  k(0, 0) = 4;  // dJ/dx(0) = 4 (x(0) - 1)
  right[0] = 4;
  for (int i = 1; i <= pieces; ++i) k(i, i) = k(i, n - 1) = k(n - 1, i) = h;
  right[n - 1] = 3;
  bvp::ControlTask task;
  task.final_time = T;
  task.begin = {std::nullopt};
  task.end = {3.0};
  const bvp::ExtremalProblem problem(std::make_shared<const bvp::DualControl<Pull>>(Pull{}), task);
  const bvp::Extremal e = solve_extremal(problem, bvp::constant_start(Eigen::VectorXd::Zero(2)));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  expect_erratum("rbf_inverse-5.7", {.printed = 3,
                                     .corrected = e.solution.first()[0],
                                     .oracle = Eigen::VectorXd(k.fullPivLu().solve(right))[0],
                                     .tolerance = 1e-12});  // of a linear problem: rounding
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
  const Trip free = drive(e.solution.first().head(2), settings.beta, 1, [](double) { return 0.0; });
  expect_erratum("rbf_inverse-table-5.1", {.printed = rest.end[0],
                                           .corrected = free.end[0],
                                           .oracle = settings.target[0],
                                           .tolerance = 1e-8});  // Runge and Kutta's error
}

// Eq. 5.24 has a derivative, of lambda2 as scanned, in the place of lambda1(T): lambda2' = -lambda1 changes
// the sign, lambda1' is another number. The oracle is x1(T) - x1F of an integration under the force.
TEST(ErrataControl, EndConditionIsOnTheCostateItself) {
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::free, 1);
  const bvp::Extremal e = free_extremal(settings);
  const Eigen::VectorXd z = e.solution.last();
  const double first_derivative = z[3] * (1 + 3 * settings.beta * z[0] * z[0]);
  const Trip trip = drive({0, 0}, settings.beta, 1, [&](double t) { return -e.solution.at(t)[3]; });
  const double off = trip.end[0] - settings.target[0];
  EXPECT_GT(std::abs(first_derivative - off), 0.1);
  expect_erratum("rbf_inverse-5.24", {.printed = -z[2], .corrected = z[2], .oracle = off, .tolerance = 1e-7});
}

/// (x, lambda) of Eq. 5.22 at equal times from their initial values, by the classical Runge-Kutta method.
std::vector<Eigen::Vector4d> extremal_from(Eigen::Vector4d z, double beta, double T) {
  constexpr int steps = 4000;
  const double h = T / steps;
  const auto slope = [&](const Eigen::Vector4d& y) {
    return Eigen::Vector4d(y[1], -y[0] - beta * y[0] * y[0] * y[0] - y[3],
                           y[3] * (1 + 3 * beta * y[0] * y[0]), -y[2]);
  };
  std::vector<Eigen::Vector4d> path = {z};
  for (int k = 0; k < steps; ++k) {
    const Eigen::Vector4d a = slope(z), b = slope(z + h / 2 * a), c = slope(z + h / 2 * b),
                          d = slope(z + h * c);
    z += h / 6 * (a + 2 * b + 2 * c + d);
    path.push_back(z);
  }
  return path;
}

// Eq. 5.33 gives f from T on, including T, where the extremal has -lambda2(T): f jumps. The oracle is the
// trajectory of the initial values of tools/oracles/rbf_inverse_extremals.py.
TEST(ErrataControl, ForceJumpsToTheHarmonicState) {
  constexpr double T = 1;
  const KnownExtremal& known = known_extremal(DuffingCase::harmonic, T);
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::harmonic, T);
  const auto path = extremal_from(Eigen::Map<const Eigen::Vector4d>(known.first.data()), settings.beta, T);
  const bvp::Start start{.states = [&](double t, Eigen::VectorXd& z) {
    z = path[static_cast<std::size_t>(std::lround(t / T * static_cast<double>(path.size() - 1)))];
  }};
  const bvp::Extremal e = solve_extremal(duffing_problem(settings), start);
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  const double x = 1.5 * std::cos(3 * T) + 2 * std::cos(9 * T) + 3 * std::cos(T),
               acceleration = -13.5 * std::cos(3 * T) - 162 * std::cos(9 * T) - 3 * std::cos(T);
  expect_erratum("rbf_inverse-5.33", {.printed = acceleration + x + settings.beta * x * x * x,
                                      .corrected = -e.solution.last()[3],
                                      .oracle = -path.back()[3],
                                      .tolerance = 1e-8});  // 16 digits, magnified by some 1e4
}

// Problems are "ill-posed" if a solution does not exist, is not unique, or does not depend continuously on
// the data. It does: the co-states at 0 change with the target by a finite amount, as the derivatives of the
// trajectory give. Only uniqueness is violated.
TEST(ErrataControl, SolutionsOfSplitConditionsMoveWithTheData) {
  bvp::DuffingSettings settings = printed_settings(DuffingCase::free, 1);
  const Eigen::Vector4d first = free_extremal(settings).solution.first();
  constexpr double d = 1e-4;
  Eigen::Matrix2d by_target, by_costates;
  const auto miss = [&](const Eigen::Vector4d& z) {
    const Eigen::Vector4d end = extremal_from(z, settings.beta, 1).back();
    return Eigen::Vector2d(end.tail(2) - end.head(2));
  };
  for (int i = 0; i < 2; ++i) {
    Eigen::Vector4d step = Eigen::Vector4d::Zero();
    step[2 + i] = d;
    by_costates.col(i) = (miss(first + step) - miss(first - step)) / (2 * d);
    bvp::DuffingSettings more = settings, less = settings;
    more.target[i] += d;
    less.target[i] -= d;
    by_target.col(i) =
        (free_extremal(more).solution.first() - free_extremal(less).solution.first()).tail(2) / (2 * d);
  }
  // lambda(T) - x(T) = -x_F; differences: d^2 times third derivatives, and 1e-12/d of the solves.
  const double exact = by_costates.inverse().norm();
  EXPECT_NEAR(by_target.norm(), exact, 1e-5 * exact);
}

// The solution is called insensitive to the first guess. With both positions prescribed Newton's iteration
// from zeros converges to an extremal that costs many times the best one; the oracle is
// tools/oracles/rbf_inverse_extremals.py.
TEST(ErrataControl, AnotherGuessFindsAnotherExtremal) {
  const KnownExtremal& known = known_extremal(DuffingCase::x1x1);
  const bvp::DuffingSettings settings = printed_settings(DuffingCase::x1x1, known.final_time);
  const bvp::ExtremalProblem problem = duffing_problem(settings);
  const auto cost_from = [&](const bvp::Start& start) {
    const bvp::GlobalResult r = solve_global(
        problem,
        {.nodes = 60, .derivative = bvp::DerivativeMatrix::polynomial, .rows = printed_rows(problem)}, start);
    EXPECT_TRUE(r.extremal.solution.status.ok()) << r.extremal.solution.status.text();
    return r.extremal.cost;
  };
  const auto path =
      extremal_from(Eigen::Map<const Eigen::Vector4d>(known.first.data()), settings.beta, known.final_time);
  const bvp::Start near{.states = [&](double t, Eigen::VectorXd& z) {
    const double share = t / known.final_time;
    z = path[static_cast<std::size_t>(std::lround(share * static_cast<double>(path.size() - 1)))];
  }};
  expect_erratum("rbf_inverse-5.5", {.printed = cost_from(bvp::constant_start(Eigen::VectorXd::Zero(4))),
                                     .corrected = cost_from(near),
                                     .oracle = known.cost,
                                     .tolerance = 1e-3});
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
  // The remainder for a residual of that size, as a fraction of it.
  constexpr double residual = 1.9e-17;
  const volatile double end = 5 + residual;
  expect_erratum(
      "rbf_inverse-table-5.3",
      {.printed = residual, .corrected = 0, .oracle = end - 5, .tolerance = eps, .scale = residual});
}

}  // namespace
}  // namespace nlmech::chapters::rbf_inverse::errata_control_test
