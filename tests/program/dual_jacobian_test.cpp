/// Jacobian and Hessian matrices of a function that uses everything, against differences in 50 digits: the
/// oracle knows no rule of differentiation.
#include <gtest/gtest.h>

#include "nlmech/program/dual.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::tests::dual_jacobian_test {
namespace {

/// Of three variables in (0.5, 1.5): values, first and second derivatives below 200 there.
template <class T>
Vector<T, 2> tangle(const Vector<T, 3>& x) {
  using std::abs, std::cos, std::cosh, std::exp, std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tan,
      std::tanh;
  const T a = exp(x[0] * x[1]) * sin(x[2]) / sqrt(1 + x[1] * x[1]) - pow(x[0], 3) * tanh(x[2] - x[1]);
  const T b = log(2 + cos(x[0])) * tan(x[1] / 2) + abs(sinh(x[2]) - 4) / cosh(x[0]) + pow(x[1], 2.5);
  return {a, b};
}

/// Shifts component @p i of @p x by @p h.
Vector<Real, 3> shifted(Vector<Real, 3> x, int i, const Real& h) {
  x[i] += h;
  return x;
}

RC_GTEST_PROP(DualJacobian, IsThatByDifferencesInFiftyDigits, ()) {
  const Vector<double, 3> x(*between(0.5, 1.5), *between(0.5, 1.5), *between(0.5, 1.5));
  const Vector<Dual<double, 3>, 2> y = tangle(variables(x));
  const Matrix<double, 2, 3> jacobian = jacobian_of(y);
  const Vector<Real, 3> exact = x.cast<Real>();
  // Truncation h^2 f'''/6 and rounding 1e-50 / h stay below 1e-28; doubles round each of some twenty terms
  // below 200 by a few units: 64 units of 200 bound them.
  const Real h = 1e-16;
  for (int j = 0; j < 3; ++j) {
    const Vector<Real, 2> slope =
        (tangle<Real>(shifted(exact, j, h)) - tangle<Real>(shifted(exact, j, -h))) / Real(2 * h);
    for (int i = 0; i < 2; ++i) RC_ASSERT(abs(jacobian(i, j) - slope[i]) < 64 * 200 * epsilon);
  }
}

RC_GTEST_PROP(DualHessian, IsThatByDifferencesInFiftyDigits, ()) {
  using D = Dual<double, 3>;
  using DD = Dual<D, 3>;
  const Vector<double, 3> x(*between(0.5, 1.5), *between(0.5, 1.5), *between(0.5, 1.5));
  const Vector<DD, 2> y = tangle(variables(variables(x)));
  const Vector<Real, 3> exact = x.cast<Real>();
  // Truncation h^2 f''''/6 < 1e-20, rounding 1e-50 / h^2 = 1e-28.
  const Real h = 1e-11;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) {
      const Vector<Real, 2> second = (tangle<Real>(shifted(shifted(exact, j, h), k, h)) -
                                      tangle<Real>(shifted(shifted(exact, j, h), k, -h)) -
                                      tangle<Real>(shifted(shifted(exact, j, -h), k, h)) +
                                      tangle<Real>(shifted(shifted(exact, j, -h), k, -h))) /
                                     Real(4 * h * h);
      for (int i = 0; i < 2; ++i) {
        const auto column = static_cast<std::size_t>(k), row = static_cast<std::size_t>(j);
        RC_ASSERT(abs(y[i].partial[column].partial[row] - second[i]) < 64 * 200 * epsilon);
      }
    }
  }
}

TEST(DualNested, GivesTheHessianOfAPolynomialExactly) {
  using D = Dual<double, 2>;
  const Vector<Dual<D, 2>, 2> x = variables(variables(Vector<double, 2>(3, 5)));
  const Dual<D, 2> f = x[0] * x[0] * x[1] + 7 * x[1] * x[1] * x[1];  // x^2 y + 7 y^3, small integers: exact
  EXPECT_EQ(value_of(f), 920);
  EXPECT_EQ(f.partial[0].value, 30);        // 2 x y
  EXPECT_EQ(f.value.partial[1], 534);       // x^2 + 21 y^2
  EXPECT_EQ(f.partial[0].partial[0], 10);   // 2 y
  EXPECT_EQ(f.partial[0].partial[1], 6);    // 2 x
  EXPECT_EQ(f.partial[1].partial[0], 6);    // 2 x
  EXPECT_EQ(f.partial[1].partial[1], 210);  // 42 y
  EXPECT_EQ((2.0 * f).partial[1].partial[1], 420);
  EXPECT_EQ((D(2.0) * f).partial[1].partial[1], 420);
}

TEST(DualInEigen, LinearAlgebraHasItsOwnJacobian) {
  using D = Dual<double, 3>;
  const Matrix<double, 3> a = (Matrix<double, 3>() << 1, 2, 3, 4, 5, 6, 7, 8, 10).finished();
  const Vector<double, 3> at(0.5, -2, 4);
  const Vector<D, 3> x = variables(at);
  EXPECT_EQ(jacobian_of<double>(Vector<D, 3>(a * x)), a);
  EXPECT_EQ(jacobian_of<double>(Vector<D, 3>(2.0 * x + x / 2.0 - x)), (1.5 * Matrix<double, 3>::Identity()));
  EXPECT_EQ(jacobian_of<double>(Vector<D, 1>(x.sum())), (Matrix<double, 1, 3>::Ones()));
  const D square = x.squaredNorm();  // exact: all numbers are short
  EXPECT_EQ(square.value, at.squaredNorm());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(square.partial[static_cast<std::size_t>(i)], 2 * at[i]);
  EXPECT_EQ(x.dot(at.cast<D>()).partial[1], -2);
  const Vector<D, 3> product = x.cwiseProduct(x);
  EXPECT_EQ(product[2].partial[2], 8);
}

TEST(DualInEigen, WorksInEveryPrecision) {
  const Vector<Dual<Real, 2>, 2> x = variables(Vector<Real, 2>(Real(1) / 3, Real(2)));
  const Dual<Real, 2> y = exp(x[0] * x[1]) + 0.5 * x[1];
  // d/dx0 = x1 exp(x0 x1) to a few units in the 50th digit.
  EXPECT_LT(abs(y.partial[0] - 2 * exp(Real(2) / 3)), 8 * std::numeric_limits<Real>::epsilon() * 4);
  const Vector<Dual<long double, 1>, 1> z = variables(Vector<long double, 1>(2.0L));
  EXPECT_EQ(sqrt(z[0] * z[0]).partial[0], 1);
}

}  // namespace
}  // namespace nlmech::tests::dual_jacobian_test
