#include "nlmech/algebraic/linear_solver.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <limits>

#include "tests/algebraic/classics.hpp"

namespace nlmech::algebraic::linear_solver_test {
namespace {

using namespace classics;

constexpr double eps = std::numeric_limits<double>::epsilon();

VectorXd random_vector(Eigen::Index n) {
  VectorXd v(n);
  for (double& x : v) x = *rc::gen::map(rc::gen::inRange(-1000, 1001), [](int k) { return k / 250.0; });
  return v;
}

// Against a QR decomposition of the matrix put together here.
RC_GTEST_PROP(LinearSolver, SolvesPlainShiftedAndBorderedSystems, ()) {
  const auto n = *rc::gen::inRange<Eigen::Index>(1, 6);
  MatrixXd b(n, n);
  for (Eigen::Index k = 0; k < n; ++k) b.col(k) = random_vector(n);
  const double scale = *rc::gen::inRange(-8, 9) / 4.0, shift = *rc::gen::inRange(-8, 9) / 4.0;
  const VectorXd column = random_vector(n), row = random_vector(n + 1), side = random_vector(n + 1);
  MatrixXd corner = scale * b + shift * MatrixXd::Identity(n, n), whole(n + 1, n + 1);
  whole << corner, column, row.transpose();
  const auto condition = [](const MatrixXd& m) {
    const Eigen::JacobiSVD<MatrixXd> svd(m);
    return svd.singularValues()[0] / svd.singularValues()[m.rows() - 1];
  };
  RC_PRE(condition(b) < 1e4 && condition(corner) < 1e4 && condition(whole) < 1e4);
  DenseEquations dense = linear(b, VectorXd::Zero(n));
  Sparse sparse(dense);
  for (Equations* const equations : {static_cast<Equations*>(&dense), static_cast<Equations*>(&sparse)}) {
    equations->linearise(column);
    LinearSolver solver(*equations);
    VectorXd x(n), longer(n + 1);
    const auto expect = [&](const MatrixXd& m, const VectorXd& rhs, const VectorXd& found) {
      const VectorXd exact = Eigen::ColPivHouseholderQR<MatrixXd>(m).solve(rhs);
      RC_ASSERT((found - exact).norm() <= 1e4 * 100 * eps * exact.norm());  // condition, of n^2 roundings
    };
    RC_ASSERT(solver.factorise(*equations) == Outcome::success);
    RC_ASSERT(solver.solve(side.head(n), x) == Outcome::success);
    expect(b, side.head(n), x);
    RC_ASSERT(solver.factorise_bordered(*equations, scale, shift, column, row) == Outcome::success);
    RC_ASSERT(solver.solve(side, longer) == Outcome::success);
    expect(whole, side, longer);
    RC_ASSERT(solver.factorise(*equations, scale, shift) == Outcome::success);
    RC_ASSERT(solver.solve(side.head(n), x) == Outcome::success);
    expect(corner, side.head(n), x);
  }
}

// A pattern with empty diagonal places, as the fixed-point homotopy's tB + (1-t)I meets.
TEST(LinearSolver, SparsePatternsMayLackTheDiagonal) {
  MatrixXd b = MatrixXd::Zero(3, 3);
  b(0, 2) = 2;
  b(1, 0) = 3;
  b(2, 1) = 4;
  struct Cyclic : Sparse {
    explicit Cyclic(const DenseEquations& of, const MatrixXd& m) : Sparse(of), b(m.sparseView()) {}
    [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return &b; }
    Eigen::SparseMatrix<double> b;
  } equations(linear(b, VectorXd::Zero(3)), b);
  LinearSolver solver(equations);
  VectorXd x(3);
  ASSERT_EQ(solver.factorise(equations), Outcome::success);
  ASSERT_EQ(solver.solve(vector({2, 3, 4}), x), Outcome::success);
  EXPECT_LE((x - vector({1, 1, 1})).norm(), 4 * eps);
  ASSERT_EQ(solver.factorise(equations, 1, 5), Outcome::success);
  ASSERT_EQ(solver.solve(vector({7, 8, 9}), x), Outcome::success);
  EXPECT_LE((x - vector({1, 1, 1})).norm(), 8 * eps);
}

TEST(LinearSolver, SingularAndNonFiniteMatricesAreReported) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double entry : {0.0, nan}) {
    DenseEquations dense = linear(MatrixXd::Constant(2, 2, entry), VectorXd::Zero(2));
    Sparse sparse(dense);
    for (Equations* const equations : {static_cast<Equations*>(&dense), static_cast<Equations*>(&sparse)}) {
      VectorXd x = VectorXd::Zero(2);
      equations->linearise(x);
      LinearSolver solver(*equations);
      Outcome outcome = solver.factorise(*equations);
      if (outcome == Outcome::success) outcome = solver.solve(vector({1, 1}), x);
      EXPECT_EQ(outcome, entry == 0 ? Outcome::singular_matrix : Outcome::non_finite);
    }
  }
}

}  // namespace
}  // namespace nlmech::algebraic::linear_solver_test
