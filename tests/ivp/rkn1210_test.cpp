/// RKN12(10): its coefficients satisfy the order conditions in extended precision and converge with the
/// orders 12 and 10; the method refuses velocity-dependent forces. Other tests: embedded_runge_kutta_test.cpp
/// and every_integrator_test.cpp.
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "nlmech/problems/texts.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/ivp/coefficient_table.hpp"
#include "tests/ivp/methods.hpp"
#include "tests/ivp/oracle.hpp"

namespace nlmech::ivp::rkn1210_test {
namespace {

using namespace testing;
using oracle::Real;

CoefficientTable written() { return {"rkn12_10", 181}; }

/// The coefficients with all their digits.
struct Exact {
  static constexpr int stages = 17;
  Real a[stages][stages], c[stages], position[stages], velocity[stages], low_position[stages],
      low_velocity[stages];
  Exact() {
    const CoefficientTable table = written();
    const auto get = [&](const std::string& key) { return table.get(key); };
    for (int i = 0; i < stages; ++i) {
      const std::string n = std::to_string(i + 1);
      c[i] = get("c," + n + ",");
      position[i] = get("b_high," + n + ",");
      velocity[i] = get("b_prime_high," + n + ",");
      low_position[i] = get("b_low," + n + ",");
      low_velocity[i] = get("b_prime_low," + n + ",");
      for (int j = 0; j < stages; ++j) a[i][j] = get("a," + n + "," + std::to_string(j + 1));
    }
  }
};

const Exact& exact() {
  static const Exact coefficients;
  return coefficients;
}

constexpr double digits = 4e-28;  // thirty digits, summed over seventeen stages of size up to 50

TEST(Rkn1210Coefficients, RowsSumToHalfTheSquareOfTheirAbscissa) {
  const Exact& e = exact();
  for (int i = 0; i < Exact::stages; ++i) {
    Real sum = 0;
    for (int j = 0; j < i; ++j) sum += e.a[i][j];
    EXPECT_LT(abs(Real(sum - e.c[i] * e.c[i] / 2)), Real(digits)) << i + 1;
  }
}

// sum b' c^q = 1/(q + 1) for q < order and sum b c^q = 1/((q + 1)(q + 2)) for q < order - 1; the next
// condition fails.
TEST(Rkn1210Coefficients, QuadratureConditions) {
  const Exact& e = exact();
  const auto moment = [&](const Real* weights, int q) {
    Real sum = 0;
    for (int i = 0; i < Exact::stages; ++i) sum += weights[i] * (q == 0 ? Real(1) : Real(pow(e.c[i], q)));
    return sum;
  };
  const auto check = [&](const Real* position, const Real* velocity, int order) {
    for (int q = 0; q < order; ++q) {
      EXPECT_LT(abs(Real(moment(velocity, q) - Real(1) / (q + 1))), Real(digits)) << order << " " << q;
      if (q < order - 1) {
        EXPECT_LT(abs(Real(moment(position, q) - Real(1) / ((q + 1) * (q + 2)))), Real(digits))
            << order << " " << q;
      }
    }
    EXPECT_GT(abs(Real(moment(velocity, order) - Real(1) / (order + 1))), Real(1e-9)) << order;
  };
  check(e.position, e.velocity, 12);
  check(e.low_position, e.low_velocity, 10);
}

/// Error on Kepler's ellipse e = 0.3 from its periapsis to the apoapsis, (-1.3, 0), in fixed steps with the
/// exact coefficients: a nonlinear equation depends on all order conditions.
Real error_of_ellipse(int steps, const Real* position, const Real* velocity) {
  const Exact& f = exact();
  const Real e = Real(3) / 10, h = acos(Real(-1)) / steps;
  Real q[2] = {1 - e, 0}, v[2] = {0, sqrt((1 + e) / (1 - e))};
  for (int n = 0; n < steps; ++n) {
    Real k[Exact::stages][2];
    for (int i = 0; i < Exact::stages; ++i) {
      Real x[2];
      for (int d = 0; d < 2; ++d) {
        Real sum = 0;
        for (int j = 0; j < i; ++j) {
          if (f.a[i][j] != 0) sum += f.a[i][j] * k[j][d];
        }
        x[d] = q[d] + f.c[i] * h * v[d] + h * h * sum;
      }
      const Real square = x[0] * x[0] + x[1] * x[1], cube = square * sqrt(square);
      for (int d = 0; d < 2; ++d) k[i][d] = -x[d] / cube;
    }
    for (int d = 0; d < 2; ++d) {
      Real dq = 0, dv = 0;
      for (int i = 0; i < Exact::stages; ++i) {
        dq += position[i] * k[i][d];
        dv += velocity[i] * k[i][d];
      }
      q[d] += h * v[d] + h * h * dq;
      v[d] += h * dv;
    }
  }
  return sqrt((q[0] + 1 + e) * (q[0] + 1 + e) + q[1] * q[1]);
}

TEST(Rkn1210Coefficients, OrdersOfConvergence) {
  const Exact& e = exact();
  const auto order = [&](const Real* position, const Real* velocity) {
    const Real ratio = error_of_ellipse(24, position, velocity) / error_of_ellipse(48, position, velocity);
    return std::log2(static_cast<double>(ratio));
  };
  EXPECT_NEAR(order(e.position, e.velocity), 12, 0.6);
  EXPECT_NEAR(order(e.low_position, e.low_velocity), 10, 0.6);
}

TEST(Rkn1210Coefficients, HeaderIsTheTableRounded) {
  CoefficientTable table = written();
  const auto same = [&](double mine, const std::string& key) { table.expect_rounded(mine, key); };
  for (std::size_t i = 0; i < rkn1210::stages; ++i) {
    const std::string n = std::to_string(i + 1);
    same(rkn1210::c[i], "c," + n + ",");
    same(rkn1210::position[i], "b_high," + n + ",");
    same(rkn1210::velocity[i], "b_prime_high," + n + ",");
    same(rkn1210::low_position[i], "b_low," + n + ",");
    same(rkn1210::low_velocity[i], "b_prime_low," + n + ",");
    for (std::size_t j = 0; j + 1 < rkn1210::stages; ++j)
      same(rkn1210::a[i][j], "a," + n + "," + std::to_string(j + 1));
  }
  table.expect_all_compared();
}

// A velocity-dependent force is refused. For van der Pol's equation from x = 1 the dependence shows only
// after the first step.
TEST(Rkn1210, RefusesVelocities) {
  EXPECT_THROW((void)integrate(System(Manufactured{}), State{1, 0}, 0, 1, Rkn1210{}), std::invalid_argument);
  const auto s = integrate(System(problems::TextProblem("van-der-pol")), State{1, 0.5}, 0, 5, Rkn1210{});
  EXPECT_EQ(s.status.outcome(), Outcome::outside_validity) << s.status.text();
}

}  // namespace
}  // namespace nlmech::ivp::rkn1210_test
