/// Misprints of sections 5.2 and 5.3 in the collocation: printed and corrected form against an independent
/// oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/bvp/solve.hpp"
#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::chapters::rbf_inverse::errata_collocation_test {
namespace {

using tests::expect_erratum;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// p_n of Eq. 5.8 with the given p_1, and the polynomial before it.
struct Legendre {
  double before = 1, p;
};
Legendre legendre(int n, double x, double first) {
  Legendre l{1, first};
  for (int i = 1; i < n; ++i) {
    const double next = ((2 * i + 1) * x * l.p - i * l.before) / (i + 1);
    l.before = l.p;
    l.p = next;
  }
  return l;
}

/// p_n'.
double derivative(int n, double x) {
  const Legendre l = legendre(n, x, x);
  return n * (l.before - x * l.p) / (1 - x * x);
}

// Eq. 5.8 prints p_1(tau) = x. Read as the time of Eq. 5.10 on [0, 1] the recursion does not end at
// p_4 = (35 tau^4 - 30 tau^2 + 3)/8.
TEST(ErrataControl, FirstLegendrePolynomial) {
  const double tau = -0.4, square = tau * tau;
  expect_erratum("rbf_inverse-5.8", {.printed = legendre(4, tau, (tau + 1) / 2).p,
                                     .corrected = legendre(4, tau, tau).p,
                                     .oracle = (35 * square * square - 30 * square + 3) / 8,
                                     .tolerance = 32 * eps});
}

/// Zeros of (1 - tau^2) p_n' by the changes of its sign between 100 000 angles, and the two ends.
int count_of_nodes(int n) {
  constexpr int angles = 100'000;
  int count = 2;
  double before = 1;
  for (int k = 1; k < angles; ++k) {
    const double value = derivative(n, std::cos(std::acos(-1.0) * (k - 0.3) / angles));
    count += value * before < 0 ? 1 : 0;
    before = value;
  }
  return count;
}

// Eq. 5.9: the roots of (1 - tau^2) p_N' are N + 1 nodes, so "N nodes" takes p_{N-1}.
TEST(ErrataControl, NodesAreRootsOfTheLegendreDerivative) {
  constexpr int nodes = 40;
  const Eigen::VectorXd tau = collocation::legendre_gauss_lobatto(nodes);
  ASSERT_EQ(tau.size(), nodes);
  for (Eigen::Index k = 1; k + 1 < nodes; ++k) {
    // p'' is at most N (N + 1)/(1 - tau^2) there; a rounding error of tau.
    const double slack = 64 * eps * nodes * nodes / (1 - tau[k] * tau[k]);
    EXPECT_LE(std::abs(derivative(nodes - 1, tau[k])), slack) << k;
    EXPECT_GT(std::abs(derivative(nodes, tau[k])), 0.1) << k;
  }
  // Numbers of nodes; section 5.3.5 has N = 40.
  expect_erratum("rbf_inverse-5.9", {.printed = static_cast<double>(count_of_nodes(nodes)),
                                     .corrected = static_cast<double>(count_of_nodes(nodes - 1)),
                                     .oracle = nodes,
                                     .tolerance = eps});
}

// Eq. 5.12 sums from 0 to N over the nodes tau_0 to tau_N for the states at N of them: one coefficient
// remains undetermined, where Eq. 5.15 needs none. The rank of Gaussian functions with different centres is
// full.
TEST(ErrataControl, InterpolationMatrixIsSquare) {
  constexpr int N = 7;
  const auto free_coefficients = [](const Eigen::VectorXd& rows, const Eigen::VectorXd& columns) {
    Eigen::MatrixXd phi(rows.size(), columns.size());
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
      for (Eigen::Index j = 0; j < columns.size(); ++j)
        phi(i, j) = std::exp(-std::pow(3 * (rows[i] - columns[j]), 2));
    }
    Eigen::FullPivLU<Eigen::MatrixXd> lu(phi);
    return static_cast<double>(columns.size() - lu.setThreshold(1e-10).rank());
  };
  const Eigen::VectorXd nodes = collocation::legendre_gauss_lobatto(N),
                        with_zeroth = collocation::legendre_gauss_lobatto(N + 1);
  expect_erratum("rbf_inverse-5.12", {.printed = free_coefficients(with_zeroth.tail(N), with_zeroth),
                                      .corrected = free_coefficients(nodes, nodes),
                                      .oracle = 0,
                                      .tolerance = eps});
}

// Eq. 5.28 has (x_1^3)^j next to x_1^j for the state at node j: taken literally the state at node 3 to the
// power j. On an extremal the equation of motion requires for beta x_1^3 at a node the cube of the state
// there. D amplifies interpolation errors by at most N^2.
TEST(ErrataControl, CubeOfTheStateAtANode) {
  const bvp::DuffingSettings settings = printed_settings(bvp::DuffingCase::free, 1);
  const bvp::Extremal e =
      solve_extremal(duffing_problem(settings), bvp::constant_start(Eigen::VectorXd::Zero(4)));
  ASSERT_TRUE(e.solution.status.ok()) << e.solution.status.text();
  constexpr Eigen::Index N = 40, j = 36;
  const Eigen::VectorXd t = (collocation::legendre_gauss_lobatto(N).array() + 1) / 2;
  Eigen::MatrixXd z(4, N);
  for (Eigen::Index k = 0; k < N; ++k) z.col(k) = e.solution.at(t[k]);
  const Eigen::MatrixXd d = collocation::polynomial_differentiation_matrix<double>(t);
  const double left = -d.row(j - 1).dot(z.row(1)) - z(0, j - 1) - z(3, j - 1);
  expect_erratum("rbf_inverse-5.25", {.printed = settings.beta * std::pow(z(0, 2), j),
                                      .corrected = settings.beta * std::pow(z(0, j - 1), 3),
                                      .oracle = left,
                                      .tolerance = 1e-6});
}

}  // namespace
}  // namespace nlmech::chapters::rbf_inverse::errata_collocation_test
