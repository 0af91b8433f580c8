#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "chapters/rbf_ivp/nodes/node_variants.hpp"
#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"

namespace nlmech::chapters::rbf_ivp::nodes_test {
namespace {

using collocation::NodeFamily;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto, radau = NodeFamily::left_end_and_radau;

VectorXd equal(const VectorXd& nodes, double shape) { return VectorXd::Constant(nodes.size(), shape); }

/// Polynomials of degree N - 1.
TrialSpace polynomials(const VectorXd& nodes) {
  const VectorXd checks = check_points(nodes.size()), weights = collocation::barycentric_weights(nodes);
  Eigen::MatrixXd values(checks.size(), nodes.size());
  collocation::RowVector<double> row;
  for (Eigen::Index i = 0; i < checks.size(); ++i) {
    collocation::polynomial_row(nodes, weights, checks[i], row);
    values.row(i) = row;
  }
  const Eigen::MatrixXd derivative = collocation::polynomial_differentiation_matrix(nodes);
  return {nodes, derivative, checks, values, values * derivative};
}

TEST(TrialSpace, GaussiansOfEqualShapeAreThoseOfTheLibrary) {
  const VectorXd nodes = family_nodes(lobatto, 9);
  const TrialSpace space = gaussians(nodes, equal(nodes, 2));
  const Eigen::MatrixXd expected = collocation::StableGaussian(nodes, 2).differentiation_matrix();
  // The nodes of one are rounded to double, which changes D by some ulps times its condition number, near
  // 100.
  EXPECT_LE((space.derivative - expected).norm(), 1e-12 * expected.norm());
}

// A function of the span is differentiated and evaluated exactly, for each shape.
TEST(TrialSpace, GaussiansOfUnequalShapesReproduceTheirSpan) {
  const VectorXd nodes = family_nodes(lobatto, 8), shapes = own_shapes(nodes, 2.5);
  const TrialSpace space = gaussians(nodes, shapes);
  for (Eigen::Index k = 0; k < nodes.size(); ++k) {
    const auto value = [&](double t) { return std::exp(-std::pow(shapes[k] * (t - nodes[k]), 2)); };
    const auto slope = [&](double t) { return -2 * shapes[k] * shapes[k] * (t - nodes[k]) * value(t); };
    const VectorXd x = nodes.unaryExpr(value), dx = nodes.unaryExpr(slope);
    // Eight products with entries of the rows, each rounded.
    const double noise = 20 * eps * space.derivative.norm();
    EXPECT_LE((space.derivative * x - dx).norm(), noise);
    EXPECT_LE((space.values * x - space.checks.unaryExpr(value)).norm(), 20 * eps * space.values.norm());
    EXPECT_LE((space.slopes * x - space.checks.unaryExpr(slope)).norm(), 20 * eps * space.slopes.norm());
  }
}

TEST(TrialSpace, RefusesShapesThatDoNotMatch) {
  EXPECT_THROW(static_cast<void>(gaussians(family_nodes(lobatto, 5), VectorXd::Ones(4))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(gaussians(VectorXd::Zero(1), VectorXd::Ones(1))), std::invalid_argument);
}

TEST(CheckPoints, IntegratePolynomialsExactly) {
  const VectorXd t = check_points(4), w = gauss_weights(t.size());
  ASSERT_EQ(t.size(), 9);
  for (const int power : {0, 1, 8, 17})
    EXPECT_NEAR(w.dot(VectorXd(t.array().pow(power))), 1.0 / (power + 1), 20 * eps);
}

TEST(OwnShapes, OverlapIsTheSameEverywhere) {
  const VectorXd nodes = family_nodes(lobatto, 11), shapes = own_shapes(nodes, 3);
  for (Eigen::Index k = 1; k + 1 < nodes.size(); ++k)
    EXPECT_NEAR(shapes[k] * (nodes[k + 1] - nodes[k - 1]) / 2, 0.3, 4 * eps);
  EXPECT_NEAR(shapes[0] * nodes[1], 0.3, 4 * eps);
  const VectorXd even = VectorXd::LinSpaced(11, 0, 1);
  EXPECT_LE((own_shapes(even, 3) - equal(even, 3)).norm(), 100 * eps);
}

TEST(PlacedNodes, EqualResidualsLeaveThemWhereTheyAre) {
  const VectorXd nodes = family_nodes(lobatto, 12), checks = check_points(12);
  for (const double level : {0.0, 2.0}) {
    const VectorXd placed = placed_nodes(nodes, checks, VectorXd::Constant(checks.size(), level));
    EXPECT_LE((placed - nodes).cwiseAbs().maxCoeff(), 100 * eps);
  }
}

TEST(PlacedNodes, ShareOutTheDensity) {
  const VectorXd nodes = VectorXd::LinSpaced(21, 0, 1), checks = check_points(21);
  // Residuals t^2 give the monitor t, up to two check points, at most 0.05: the density is 1/2 + t with a
  // tenth of uniform density at most. Half of 1/2 + t is left of the root of t/2 + t^2/2 = 1/2, which is
  // 0.118 beyond the middle; a tenth of that may be missing.
  const VectorXd placed = placed_nodes(nodes, checks, checks.cwiseAbs2());
  EXPECT_EQ(placed[0], 0);
  EXPECT_EQ(placed[20], 1);
  EXPECT_NEAR(placed[10], (std::sqrt(5.0) - 1) / 2, 0.0118);
  for (Eigen::Index k = 1; k < placed.size(); ++k) EXPECT_GT(placed[k], placed[k - 1]);
}

TEST(InsertedNodes, StandAtTheGreatestResiduals) {
  const VectorXd nodes = family_nodes(lobatto, 5), checks = check_points(5);
  VectorXd residuals = VectorXd::Constant(checks.size(), 0.1);
  const double inside = (nodes[1] + nodes[2]) / 2;
  for (Eigen::Index i = 0; i < checks.size(); ++i)
    residuals[i] += std::exp(-100 * std::pow(checks[i] - inside, 2));
  const VectorXd one = with_inserted(nodes, checks, residuals, 1);
  ASSERT_EQ(one.size(), 6);
  EXPECT_GT(one[2], nodes[1]);
  EXPECT_LT(one[2], nodes[2]);
  const VectorXd many = with_inserted(nodes, checks, residuals, 100);
  EXPECT_LE(many.size(), 9);  // at most one in each gap
  EXPECT_GE(many.size(), 7);
  for (Eigen::Index k = 1; k < many.size(); ++k) EXPECT_GT(many[k], many[k - 1]);
}

TEST(Collocate, PolynomialsAtRadauNodesAreTheIntegratorsStep) {
  const Arc arc{&free_duffing_case(), 0, duffing_period() / 10};
  const Fit fit = collocate(arc, polynomials(family_nodes(radau, 7)));
  ASSERT_TRUE(fit.converged);
  const auto solution =
      ivp::integrate(free_duffing_case().system, free_duffing_case().x0, 0.0, arc.h,
                     ivp::PolynomialCollocation{.step = arc.h, .nodes = 7, .points = radau});
  EXPECT_LE((fit.states.row(6).transpose() - solution.x).norm(),
            1e-13);  // two Newton iterations to 1e-12 or less
  EXPECT_LE(fit.end_error, fit.largest_error);
  EXPECT_GT(fit.residuals.maxCoeff(), 1e-9);  // truncation error; zero at the nodes only
}

/// The weighted sum of squares that least squares minimises.
double objective(const Arc& arc, const TrialSpace& space, const Eigen::MatrixXd& states) {
  const Eigen::MatrixXd r = residual_columns(arc, space, states);
  return r.colwise().squaredNorm().dot(gauss_weights(r.cols()).transpose());
}

TEST(LeastSquares, NoNeighbourHasALessSum) {
  const Arc arc{&impact_case(), 0, 1.6};
  const VectorXd nodes = family_nodes(lobatto, 9);
  const TrialSpace space = gaussians(nodes, equal(nodes, 2));
  const Fit fit = least_squares(arc, space), start = collocate(arc, space);
  ASSERT_TRUE(fit.converged);
  const double least = objective(arc, space, fit.states);
  EXPECT_LT(least, objective(arc, space, start.states));
  for (Eigen::Index k = 1; k < nodes.size(); ++k) {
    for (const Eigen::Index i : {0, 1}) {
      for (const double d : {1e-4, -1e-4}) {
        Eigen::MatrixXd moved = fit.states;
        moved(k, i) += d;
        EXPECT_GT(objective(arc, space, moved), least);
      }
    }
  }
  EXPECT_EQ(fit.states.row(0), start.states.row(0));
}

// Polynomials of degree s: least squares has order 2 s at the end, as Gauss collocation with s stages.
TEST(LeastSquares, DoublesTheOrderAtTheEnd) {
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    const Arc arc{&free_duffing_case(), 0.9, 0.8 / (1 << k)};
    errors[k] = least_squares(arc, polynomials(family_nodes(lobatto, 4))).end_error;
  }
  // One step: 2 s + 1 = 7, and the next term of the error at h = 0.8 and 0.4.
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 7, 1);
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::nodes_test
