/// Each misprint of the summary: the printed form fails, the corrected one holds.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "chapters/transversal/oscillators.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::chapters::transversal::errata_test {
namespace {

using tests::expect_erratum;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Lagrange's polynomial L_k through 0, 1, ..., p.
double lagrange(int p, int k, double s) {
  double product = 1;
  for (int i = 0; i <= p; ++i) {
    if (i != k) product *= (s - i) / (k - i);
  }
  return product;
}

double integral(const std::function<double(double)>& f, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 5, 1e-14);
}

// Printed: the integral of each phi_k over p h is 1. Then a constant force 1 gives a unit mass the velocity p
// + 1 after any time. Corrected: the phi_k sum to one, and the velocity is p h.
TEST(Errata, BasisNeedsASumOfOneAndNoIntegralOfOne) {
  for (int p = 1; p <= 4; ++p) {
    const double h = 0.2;
    double sum = 0, printed = 0;
    for (int k = 0; k <= p; ++k) {
      const double own = integral([&](double s) { return lagrange(p, k, s); }, 0, p) * h;
      EXPECT_GT(std::abs(own - 1), 0.3) << "phi_" << k << " of p = " << p;
      sum += own;
      printed += 1;  // after scaling phi_k so that its integral is one
    }
    EXPECT_NEAR(sum, p * h, 20 * eps);
    EXPECT_GT(std::abs(printed - p * h), 1);
    ivp::MtlWeights weights(2, 1, ivp::MtlBasis::lagrange, p, {});
    ASSERT_EQ(weights.compute((Eigen::Matrix2d() << 0, 1, 0, 0).finished(), h), Outcome::success);
    double velocity = 0;
    for (int k = 0; k <= p; ++k) velocity += weights.weight(p, k)(1, 0);
    EXPECT_NEAR(velocity, p * h, 40 * eps);
    // The velocity of a mass of 1 under a force of 1 after the time p h is p h.
    expect_erratum("transversal-basis",
                   {.printed = printed, .corrected = velocity, .oracle = p * h, .tolerance = 64 * eps});
  }
}

// (3) as printed leaves the time free in Q(X_k, X'_k, t). For Q = x cos 9 t the integral over phi_k differs
// from the closed form; with t_k instead of t it agrees.
TEST(Errata, NonlinearTermsAreTakenAtTheirPoints) {
  constexpr int p = 3;
  constexpr double h = 0.2, w = 1.5;
  const double x[] = {1, 0.8, 0.3, -0.2};
  ivp::MtlWeights weights(2, 1, ivp::MtlBasis::lagrange, p, {});
  ASSERT_EQ(weights.compute((Eigen::Matrix2d() << 0, 1, -w * w, 0).finished(), h), Outcome::success);
  double closed = 0, printed = 0, corrected = 0;
  const double end = p * h;
  for (int k = 0; k <= p; ++k) {
    const auto response = [&](double t) { return std::sin(w * (end - t)) / w * lagrange(p, k, t / h); };
    closed += weights.weight(p, k)(0, 0) * x[k] * std::cos(9 * k * h);
    corrected += integral([&](double t) { return response(t) * x[k] * std::cos(9 * k * h); }, 0, end);
    printed += integral([&](double t) { return response(t) * x[k] * std::cos(9 * t); }, 0, end);
  }
  EXPECT_NEAR(closed, corrected, 50 * eps);
  EXPECT_GT(std::abs(closed - printed), 1e-2);
  expect_erratum(
      "transversal-3",
      {.printed = printed, .corrected = closed, .oracle = corrected, .tolerance = 64 * eps, .scale = 1});
}

/// The oscillators of two-dof with one Q^(j) in both equations, as (4) literally reads; j = 1.
constexpr const char* one_component_for_all =
    "x1'' = -x1 - x1^3 - (x1 - x2)/2; x2'' = -x2 - x1^3 + (x1 - x2)/2";

// (4) has the component Q_M^(j) instead of the vector Q_M. Masses that start in opposite directions stay so;
// with one component for both they do not.
TEST(Errata, NonlinearTermsAreAVector) {
  const problems::TextProblem problem("two-dof", {{"damping", 0}, {"force", 0}});
  const program::Problem literal(program::Equations({"(4) literally", one_component_for_all}));
  const ivp::State x0{1, -1, 0, 0};
  const auto corrected = ivp::integrate(ivp::System(problem), x0, 0, 5, ivp::Mtl{.step = 0.05});
  const auto printed = ivp::integrate(ivp::System(literal), x0, 0, 5, ivp::Mtl{.step = 0.05});
  ASSERT_TRUE(corrected.status.ok() && printed.status.ok());
  EXPECT_NEAR(corrected.x[0] + corrected.x[1], 0, 1e4 * eps);
  EXPECT_GT(std::abs(printed.x[0] + printed.x[1]), 1e-2);
  // Mirror symmetry: the sum of the positions is 0; each of a hundred steps has some ten rounding errors.
  expect_erratum("transversal-4", {.printed = printed.x[0] + printed.x[1],
                                   .corrected = corrected.x[0] + corrected.x[1],
                                   .oracle = 0,
                                   .tolerance = 1e4 * eps});
}

// (5) is called 2 p equations: correct for one degree of freedom; for n there are 2 p n, the number of rows
// of the weights.
TEST(Errata, EquationsAreTwoForEachPointAndDegreeOfFreedom) {
  for (const int dof : {1, 2, 3}) {
    constexpr int p = 3;
    ivp::MtlWeights weights(2 * dof, dof, ivp::MtlBasis::lagrange, p, {});
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2L * dof, 2L * dof);
    a.topRightCorner(dof, dof).setIdentity();
    ASSERT_EQ(weights.compute(a, 0.1), Outcome::success);
    Eigen::Index rows = 0;
    for (int l = 1; l <= p; ++l) rows += weights.weight(l, 0).rows();
    EXPECT_EQ(rows, 2L * p * dof);
    EXPECT_EQ(rows == 2L * p, dof == 1);
    if (dof == 1) continue;
    // Unknowns that equations (5) determine: the rank of their matrix, for a spring to ground in Q as well.
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(rows, rows);
    for (int l = 1; l <= p; ++l) {
      for (int k = 1; k <= p; ++k) {
        const Eigen::MatrixXd w = weights.weight(l, k);
        jacobian.block((l - 1) * 2L * dof, (k - 1) * 2L * dof, 2L * dof, dof) += w;
      }
    }
    expect_erratum("transversal-5",
                   {.printed = 2 * p,
                    .corrected = 2.0 * p * dof,
                    .oracle = static_cast<double>(Eigen::FullPivLU<Eigen::MatrixXd>(jacobian).rank()),
                    .tolerance = eps});
  }
}

/// One block of p = 3 for x'' + x + x^3 = 0 from (x, v): weights by quadrature of Lagrange's polynomials with
/// sin and cos, equations (5) by successive substitution.
Eigen::Vector2d block_by_quadrature(double h, const Eigen::Vector2d& from) {
  constexpr int p = 3;
  double place[p + 1][p + 1] = {}, speed[p + 1][p + 1] = {};
  for (int l = 1; l <= p; ++l) {
    for (int k = 0; k <= p; ++k) {
      place[l][k] = integral([&](double s) { return std::sin(l * h - s) * lagrange(p, k, s / h); }, 0, l * h);
      speed[l][k] = integral([&](double s) { return std::cos(l * h - s) * lagrange(p, k, s / h); }, 0, l * h);
    }
  }
  double x[p + 1] = {from[0], from[0], from[0], from[0]}, v = 0;
  for (int turn = 0; turn < 60; ++turn) {  // contracts by at least (p h)^2
    for (int l = 1; l <= p; ++l) {
      const double c = std::cos(l * h), s = std::sin(l * h);
      double next = c * from[0] + s * from[1];
      v = c * from[1] - s * from[0];
      for (int k = 0; k <= p; ++k) {
        next -= place[l][k] * x[k] * x[k] * x[k];
        v -= speed[l][k] * x[k] * x[k] * x[k];
      }
      x[l] = next;
    }
  }
  return {x[p], v};
}

/// Determinant of that block's derivative at (1, 0.3), less 1, by central differences.
double area_lost(double h, double change) {
  Eigen::Matrix2d map;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d d = change * Eigen::Vector2d::Unit(i), x(1, 0.3);
    map.col(i) = (block_by_quadrature(h, x + d) - block_by_quadrature(h, x - d)) / (2 * change);
  }
  return map.determinant() - 1;
}

// "A Hamiltonian system remains Hamiltonian": the map of a block would preserve areas. For x'' + x it does,
// up to rounding errors; for x'' + x + x^3 it does not, by 1e-6 for p = 3.
TEST(Errata, BlocksOfNonlinearSystemsDoNotKeepAreas) {
  const auto determinant = [](double hardening) {
    const problems::TextProblem problem("driven-duffing", {{"hardening", hardening}, {"force", 0}});
    constexpr double change = 1e-4;
    Eigen::Matrix2d map;
    for (int i = 0; i < 2; ++i) {
      const ivp::State d = change * ivp::State::Unit(2, i), x{1, 0.3};
      const auto end = [&](const ivp::State& from) {
        return ivp::integrate(ivp::System(problem), from, 0, 0.3, ivp::Mtl{.step = 0.1}).x;
      };
      map.col(i) = (end(x + d) - end(x - d)) / (2 * change);
    }
    return map.determinant() - 1;
  };
  EXPECT_NEAR(determinant(0), 0, 100 * eps / 1e-4);
  EXPECT_GT(std::abs(determinant(1)), 1e-6);
  // A Hamiltonian map has determinant 1. The error of the derivatives is Newton's tolerance over the change,
  // at most 1e-8; the distance of the determinant from 1 is a hundred times that.
  const double exact = area_lost(0.1, 1e-4);
  EXPECT_NEAR(determinant(1), exact, 0.02 * std::abs(exact));
}

}  // namespace
}  // namespace nlmech::chapters::transversal::errata_test
