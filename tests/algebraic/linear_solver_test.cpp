/// Linear solvers: plain, shifted and bordered systems, dense, sparse and symmetric; the trust-region step.
#include "nlmech/algebraic/linear_solver.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>

#include "nlmech/algebraic/dense_lu.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/algebraic/symmetric_solver.hpp"
#include "tests/algebraic/classics.hpp"

namespace nlmech::algebraic::linear_solver_test {
namespace {

using namespace classics;

constexpr double eps = std::numeric_limits<double>::epsilon();

// Reference: QR decomposition of the matrix assembled here.
RC_GTEST_PROP(LinearSolver, SolvesPlainShiftedAndBorderedSystems, ()) {
  const auto n = *rc::gen::inRange<Eigen::Index>(1, 6);
  const MatrixXd b = random_matrix(n, n);
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
      RC_ASSERT((found - exact).norm() <=
                1e4 * 100 * eps * exact.norm());  // condition number times n^2 rounding errors
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

// A sparse pattern without all diagonal entries, as for tB + (1-t)I of the fixed-point homotopy.
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

// ---- LU factors: the residual equals that of elimination with partial pivoting.

using Complex = std::complex<double>;
template <class Number>
using Column = Eigen::Matrix<Number, Eigen::Dynamic, 1>;

// With partial pivoting |A x - b| is at most some n^2 eps |A| |x| without growth of the pivots, which random
// matrices do not show (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 9.3); complex products
// have up to three times the rounding error.
template <class Number>
bool solves(Eigen::Index size, const Number& shift, const MatrixXd& j, const Column<Number>& b) {
  DenseLu<Number> factors(size);
  factors.compute(j, -1, shift);
  Column<Number> x = b;
  factors.solve(x, x);
  Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> a = -j.template cast<Number>();
  a.diagonal().array() += shift;
  const double bound = 3 * static_cast<double>(size * size) * eps * a.cwiseAbs().rowwise().sum().maxCoeff() *
                       x.cwiseAbs().maxCoeff();
  return (a * x - b).cwiseAbs().maxCoeff() <= bound;
}

// Entries over several decades, a fifth of them 0.
template <class Number>
Number entry(std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(-1, 1);
  const auto draw = [&] { return part(random) * std::pow(10, 3 * part(random)); };
  if (part(random) > 0.6) return 0;
  if constexpr (std::is_same_v<Number, Complex>)
    return {draw(), draw()};
  else
    return draw();
}

template <class Number>
bool solves_at_random(std::uint64_t seed, Eigen::Index size) {
  std::mt19937_64 random(seed);
  const MatrixXd j = MatrixXd::NullaryExpr(size, size, [&] { return entry<double>(random); });
  const Column<Number> b = Column<Number>::NullaryExpr(size, [&] { return entry<Number>(random); });
  // A shift of the diagonal away from 0: the matrix is regular with probability 1.
  return solves<Number>(size, entry<Number>(random) + Number(0.37), j, b);
}

RC_GTEST_PROP(DenseLu, SolveWhatTheyFactor, (std::uint64_t seed)) {
  RC_ASSERT((solves_at_random<double>(seed, 1)));
  RC_ASSERT((solves_at_random<double>(seed, 2)));
  RC_ASSERT((solves_at_random<double>(seed, 6)));
  RC_ASSERT((solves_at_random<Complex>(seed, 1)));
  RC_ASSERT((solves_at_random<Complex>(seed, 3)));
  RC_ASSERT((solves_at_random<Complex>(seed, 6)));
  // Sizes below and above the one from which Eigen is used.
  const auto size = static_cast<Eigen::Index>(1 + seed % 64);
  RC_ASSERT((solves_at_random<double>(seed, size)));
  RC_ASSERT((solves_at_random<Complex>(seed, size)));
}

TEST(DenseLu, BringPivotsToTheDiagonal) {
  MatrixXd a(3, 3);
  a << 0, 1, 0, 0, 0, 2, 4, 0, 0;  // maps x to (x2, 2 x3, 4 x1)
  DenseLu<double> factors(3);
  factors.compute(a);
  VectorXd x = Eigen::Vector3d(5, 6, 8);
  factors.solve(x, x);
  EXPECT_EQ(x, Eigen::Vector3d(2, 5, 3));
}

// The squares of these entries overflow or underflow.
TEST(DenseLu, NeitherOverflowNorUnderflow) {
  for (const double scale : {1e-300, 1e-200, 1e200, 1e300}) {
    DenseLu<Complex> factors(1);
    for (const Complex part : {Complex(3, 4), Complex(4, -3), Complex(0, 1), Complex(-1, 0)}) {
      factors.compute(MatrixXd::Zero(1, 1), 1, part * scale);
      Eigen::VectorXcd x = Eigen::VectorXcd::Constant(1, part * scale);
      factors.solve(x, x);
      EXPECT_LT(std::abs(x[0] - 1.0), 8 * eps) << part << ' ' << scale;
    }
  }
}

template <class Number>
void expect_singular(const MatrixXd& a) {
  const Column<Number> b = Column<Number>::Ones(a.rows());
  Column<Number> x = b;
  DenseLu<Number> factors(a.rows());
  factors.compute(a);
  factors.solve(b, x);
  EXPECT_FALSE(x.allFinite()) << a.rows();
  factors.solve(Column<Number>(0 * b), x);
  EXPECT_EQ(x, 0 * b) << a.rows();
}

TEST(DenseLu, ASingularMatrixHasNoSolution) {
  MatrixXd dependent(2, 2);
  dependent << 1, 2, 2, 4;
  expect_singular<double>(dependent);
  expect_singular<Complex>(dependent);
  for (const Eigen::Index size : {2, 60}) {
    expect_singular<double>(MatrixXd::Zero(size, size));
    expect_singular<Complex>(MatrixXd::Zero(size, size));
  }
}

// ---- Factors of symmetric matrices, and the trust-region step.

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

VectorXd seeded_vector(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  VectorXd v(n);
  for (double& value : v) value = entry(random);
  return v;
}

// Reference: Eigen's eigenvalues, and the product with the matrix.
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
  const VectorXd right = seeded_vector(n, seed + 1);
  VectorXd x(n), product(n);
  solver.solve(right, x);
  solver.multiply(x, product);
  product += shift * x;
  // Definite: backward stable. Indefinite without pivoting: pivots may grow by some 1e6 here.
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

// Without pivoting the first pivot of this matrix is 0, although its eigenvalues are not.
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

/// The minimum of g^T p + p^T B p/2 on a ball, by eigenvectors and bisection for the multiplier.
double least(const MatrixXd& b, const VectorXd& g, double radius) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(b);
  const VectorXd& e = spectrum.eigenvalues();
  const VectorXd c = spectrum.eigenvectors().transpose() * g;
  // In the hard case a multiplier may equal an eigenvalue whose component of the gradient is zero: 0/0 gives
  // no step.
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

// Guaranteed: 90 % of the largest decrease, within 1.2 radii.
RC_GTEST_PROP(TrustRegionStep, IsNearlyTheBest, ()) {
  const Eigen::Index n = *rc::gen::inRange(1, 40);
  const auto seed = *rc::gen::inRange<unsigned>(0, 100'000);
  const MatrixXd b = banded(n, seed, 0.1 * *rc::gen::inRange(-20, 60));
  const double radius = std::pow(10, 0.1 * *rc::gen::inRange(-40, 20));
  VectorXd g = seeded_vector(n, seed + 1);
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
}  // namespace nlmech::algebraic::linear_solver_test
