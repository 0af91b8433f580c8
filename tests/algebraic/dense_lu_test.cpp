// LU factors: the residual of a solution is that of elimination with partial pivoting.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <random>
#include <type_traits>

#include "nlmech/algebraic/dense_lu.hpp"

namespace nlmech::algebraic::dense_lu_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Complex = std::complex<double>;
template <class Number>
using Column = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
constexpr double eps = 2.220446049250313e-16;

// |A x - b| of a solution with partial pivoting is at most some n^2 eps |A| |x| unless pivots grow, which
// random matrices do not make them do (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 9.3);
// complex products round up to three times as much.
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

// Entries over some decades, a fifth of them 0.
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
  // On the diagonal more than the 0 that an entry may be: regular with probability 1.
  return solves<Number>(size, entry<Number>(random) + Number(0.37), j, b);
}

RC_GTEST_PROP(DenseLu, SolveWhatTheyFactor, (std::uint64_t seed)) {
  RC_ASSERT((solves_at_random<double>(seed, 1)));
  RC_ASSERT((solves_at_random<double>(seed, 2)));
  RC_ASSERT((solves_at_random<double>(seed, 6)));
  RC_ASSERT((solves_at_random<Complex>(seed, 1)));
  RC_ASSERT((solves_at_random<Complex>(seed, 3)));
  RC_ASSERT((solves_at_random<Complex>(seed, 6)));
  // Both sides of where Eigen takes over.
  const auto size = static_cast<Eigen::Index>(1 + seed % 64);
  RC_ASSERT((solves_at_random<double>(seed, size)));
  RC_ASSERT((solves_at_random<Complex>(seed, size)));
}

TEST(DenseLu, BringPivotsToTheDiagonal) {
  MatrixXd a(3, 3);
  a << 0, 1, 0, 0, 0, 2, 4, 0, 0;  // takes x to (x2, 2 x3, 4 x1)
  DenseLu<double> factors(3);
  factors.compute(a);
  VectorXd x = Eigen::Vector3d(5, 6, 8);
  factors.solve(x, x);
  EXPECT_EQ(x, Eigen::Vector3d(2, 5, 3));
}

// Squares of these entries are no doubles.
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

}  // namespace
}  // namespace nlmech::algebraic::dense_lu_test
