/// Factors of symmetric matrices and the step of a trust region.
#include "nlmech/algebraic/symmetric_solver.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "nlmech/algebraic/newton/trust_region_step.hpp"

namespace nlmech::algebraic::symmetric_solver_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A banded symmetric matrix with random entries in [-1, 1] and @p shift on the diagonal.
MatrixXd banded(Eigen::Index n, unsigned seed, double shift) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  MatrixXd b = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < std::min(n, i + 4); ++j) b(i, j) = b(j, i) = entry(random);
    b(i, i) += shift;
  }
  return b;
}

VectorXd random_vector(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  VectorXd v(n);
  for (double& value : v) value = entry(random);
  return v;
}

// Truth: Eigen's eigenvalues, and the product with the matrix.
RC_GTEST_PROP(SymmetricSolver, CountsAndSolves, ()) {
  const Eigen::Index n = *rc::gen::inRange(1, 60);
  const auto seed = *rc::gen::inRange<unsigned>(0, 100'000);
  const double shift = 0.01 * *rc::gen::inRange(-300, 300);
  const bool is_sparse = *rc::gen::arbitrary<bool>();
  const MatrixXd b = banded(n, seed, 0.3), shifted = b + shift * MatrixXd::Identity(n, n);
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(shifted).eigenvalues();
  RC_PRE(eigenvalues.cwiseAbs().minCoeff() > 1e-6);
  SymmetricSolver solver;
  if (is_sparse)
    solver.take(Eigen::SparseMatrix<double>(b.sparseView()));
  else
    solver.take(b);
  RC_ASSERT(solver.is_finite());
  const Inertia inertia = solver.factorise(shift);
  RC_ASSERT(inertia.negative == (eigenvalues.array() < 0).count());
  RC_ASSERT(inertia.zero == 0);
  RC_ASSERT(solver.norm() >= b.operatorNorm() * (1 - 1e-12));
  const VectorXd right = random_vector(n, seed + 1);
  VectorXd x(n), product(n);
  solver.solve(right, x);
  solver.multiply(x, product);
  product += shift * x;
  // Backward stable if definite; pivots of an indefinite matrix, not exchanged, may grow by some 1e6 here.
  const double growth = inertia.negative == 0 ? 1e3 : 1e9;
  RC_ASSERT((product - right).norm() <= growth * eps * (solver.norm() + std::abs(shift)) * x.norm());
  if (inertia.negative > 0) {
    const double curvature = solver.negative_direction(x);
    RC_ASSERT(curvature < 0);
    RC_ASSERT(x.dot(shifted * x) < 0);
  }
}

TEST(SymmetricSolver, ScalesBothSides) {
  MatrixXd b(2, 2);
  b << 4, 3, 3, 9;
  const VectorXd scale = scale_of(b.diagonal());
  EXPECT_EQ(scale[0], 2);
  EXPECT_EQ(scale[1], 3);
  SymmetricSolver solver;
  solver.take(b, scale);
  VectorXd out(2);
  solver.multiply(VectorXd::Unit(2, 0), out);
  EXPECT_EQ(out[0], 1);
  EXPECT_EQ(out[1], 0.5);
  EXPECT_EQ(scale_of(VectorXd::Zero(3)), VectorXd::Ones(3));
}

// Without exchanges the first pivot of this matrix is 0; its eigenvalues are not.
TEST(SymmetricSolver, APivotOfZeroIsMoved) {
  const Eigen::Index n = 20;
  Eigen::SparseMatrix<double> b(n, n);
  for (int i = 0; i < n; i += 2) {
    b.insert(i, i) = 0;
    b.insert(i, i + 1) = b.insert(i + 1, i) = 1;
    b.insert(i + 1, i + 1) = 0;
  }
  b.makeCompressed();
  SymmetricSolver solver;
  solver.take(b);
  const Inertia inertia = solver.factorise();
  EXPECT_EQ(inertia.zero, 1);
  EXPECT_EQ(inertia.negative, 10);
  EXPECT_FALSE(inertia.is_positive());
}

TEST(SymmetricSolver, SeesWhatIsNotFinite) {
  SymmetricSolver solver;
  solver.take(MatrixXd::Constant(2, 2, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(solver.is_finite());
  Eigen::SparseMatrix<double> b(30, 30);
  b.setIdentity();
  b.coeffRef(3, 3) = HUGE_VAL;
  solver.take(b);
  EXPECT_FALSE(solver.is_finite());
}

/// The least value of g^T p + p^T B p/2 on a ball, by eigenvectors and bisection for the multiplier.
double least(const MatrixXd& b, const VectorXd& g, double radius) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(b);
  const VectorXd& e = spectrum.eigenvalues();
  const VectorXd c = spectrum.eigenvectors().transpose() * g;
  // In the hard case a multiplier may meet an eigenvalue whose part of the gradient is zero: 0/0 is no step.
  const auto step = [&](double multiplier) -> VectorXd {
    return c.binaryExpr(e, [multiplier](double part, double eigenvalue) {
      return part == 0 ? 0 : -part / (eigenvalue + multiplier);
    });
  };
  const auto value = [&](const VectorXd& p) { return c.dot(p) + p.cwiseAbs2().dot(e) / 2; };
  if (e[0] > 0 && step(0).norm() <= radius) return value(step(0));
  double low = std::max(0., -e[0]), high = low + g.norm() / radius + 1;
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (step(middle).norm() > radius ? low : high) = middle;
  }
  VectorXd p = step(high);
  const double rest = radius * radius - p.squaredNorm();
  if (rest > 0) p[0] += std::copysign(std::sqrt(rest + p[0] * p[0]) - std::abs(p[0]), p[0]);
  return value(p);
}

// Promised: 90 % of the best decrease, within 1.2 radii.
RC_GTEST_PROP(TrustRegionStep, IsNearlyTheBest, ()) {
  const Eigen::Index n = *rc::gen::inRange(1, 40);
  const auto seed = *rc::gen::inRange<unsigned>(0, 100'000);
  const MatrixXd b = banded(n, seed, 0.1 * *rc::gen::inRange(-20, 60));
  const double radius = std::pow(10, 0.1 * *rc::gen::inRange(-40, 20));
  VectorXd g = random_vector(n, seed + 1);
  if (*rc::gen::arbitrary<bool>()) {  // the hard case
    const VectorXd worst = Eigen::SelfAdjointEigenSolver<MatrixXd>(b).eigenvectors().col(0);
    g -= worst.dot(g) * worst;
  }
  RC_PRE(g.norm() > 1e-3);
  SymmetricSolver solver;
  solver.take(Eigen::SparseMatrix<double>(b.sparseView()));
  VectorXd p(n);
  const auto result = TrustRegionStep().find(solver, g, radius, p);
  RC_ASSERT(result.found);
  RC_ASSERT(p.norm() <= 1.2 * radius);
  const double decrease = -(g.dot(p) + p.dot(b * p) / 2);
  RC_ASSERT(std::abs(decrease - result.decrease) <= 1e-12 * (g.norm() * p.norm() + p.squaredNorm()));
  RC_ASSERT(decrease >= 0.8 * -least(b, g, radius));
  RC_ASSERT(result.factorisations <= 30);
}

TEST(TrustRegionStep, LeavesASaddle) {
  MatrixXd b = MatrixXd::Identity(3, 3);
  b(1, 1) = -2;
  SymmetricSolver solver;
  solver.take(b);
  VectorXd p(3);
  const auto result = TrustRegionStep().find(solver, VectorXd::Zero(3), 0.5, p);
  EXPECT_TRUE(result.found);
  EXPECT_EQ(result.negative, 1);
  EXPECT_NEAR(std::abs(p[1]), 0.5, 1e-3);
  EXPECT_GT(result.decrease, 0.2);
}

}  // namespace
}  // namespace nlmech::algebraic::symmetric_solver_test
