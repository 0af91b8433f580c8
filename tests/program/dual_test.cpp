/// Dual numbers: every function against its derivative in closed form, in 50 digits; limits of the domain;
/// Jacobians.
#include <gtest/gtest.h>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>

#include <cmath>
#include <limits>
#include <type_traits>

#include "nlmech/program/dual.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::tests::dual_test {
namespace {

using D = Dual<double, 2>;

/// A function of one variable in dual numbers, its value and its derivative in 50 digits, and test points.
struct Function {
  const char* name;
  D (*dual)(const D&);
  Real (*value)(const Real&);
  Real (*slope)(const Real&);
  double low, high;
};

// Generic functions write the arithmetic, so that scalar operands are tested as well.
const Function functions[] = {
    {"sqrt", [](const D& x) { return sqrt(x); }, [](const Real& x) { return Real(sqrt(x)); },
     [](const Real& x) { return Real(1 / (2 * sqrt(x))); }, 1e-3, 1e3},
    {"exp", [](const D& x) { return exp(x); }, [](const Real& x) { return Real(exp(x)); },
     [](const Real& x) { return Real(exp(x)); }, -20, 20},
    {"log", [](const D& x) { return log(x); }, [](const Real& x) { return Real(log(x)); },
     [](const Real& x) { return Real(1 / x); }, 2, 1e3},
    {"sin", [](const D& x) { return sin(x); }, [](const Real& x) { return Real(sin(x)); },
     [](const Real& x) { return Real(cos(x)); }, -20, 20},
    {"cos", [](const D& x) { return cos(x); }, [](const Real& x) { return Real(cos(x)); },
     [](const Real& x) { return Real(-sin(x)); }, -20, 20},
    {"tan", [](const D& x) { return tan(x); }, [](const Real& x) { return Real(tan(x)); },
     [](const Real& x) { return Real(1 / (cos(x) * cos(x))); }, -1.5, 1.5},
    {"sinh", [](const D& x) { return sinh(x); }, [](const Real& x) { return Real(sinh(x)); },
     [](const Real& x) { return Real(cosh(x)); }, -20, 20},
    {"cosh", [](const D& x) { return cosh(x); }, [](const Real& x) { return Real(cosh(x)); },
     [](const Real& x) { return Real(sinh(x)); }, -20, 20},
    {"tanh", [](const D& x) { return tanh(x); }, [](const Real& x) { return Real(tanh(x)); },
     [](const Real& x) { return Real(1 / (cosh(x) * cosh(x))); }, -20, 20},
    {"asin", [](const D& x) { return asin(x); }, [](const Real& x) { return Real(asin(x)); },
     [](const Real& x) { return Real(1 / sqrt(1 - x * x)); }, -1, 1},
    {"acos", [](const D& x) { return acos(x); }, [](const Real& x) { return Real(acos(x)); },
     [](const Real& x) { return Real(-1 / sqrt(1 - x * x)); }, -1, 0.9},
    {"atan", [](const D& x) { return atan(x); }, [](const Real& x) { return Real(atan(x)); },
     [](const Real& x) { return Real(1 / (1 + x * x)); }, -50, 50},
    {"asinh", [](const D& x) { return asinh(x); }, [](const Real& x) { return Real(asinh(x)); },
     [](const Real& x) { return Real(1 / sqrt(1 + x * x)); }, -50, 50},
    {"erf", [](const D& x) { return erf(x); }, [](const Real& x) { return Real(boost::math::erf(x)); },
     [](const Real& x) { return Real(2 / sqrt(Real(boost::math::constants::pi<Real>())) * exp(-x * x)); }, -2,
     2},
    {"atan2(x, 2)", [](const D& x) { return atan2(x, 2); },
     [](const Real& x) { return Real(atan2(x, Real(2))); },
     [](const Real& x) { return Real(2 / (x * x + 4)); }, -9, 9},
    {"atan2(2, x)", [](const D& x) { return atan2(2.0, x); },
     [](const Real& x) { return Real(atan2(Real(2), x)); },
     [](const Real& x) { return Real(-2 / (x * x + 4)); }, -9, 9},
    {"abs", [](const D& x) { return abs(x); }, [](const Real& x) { return Real(abs(x)); },
     [](const Real& x) { return Real(x < 0 ? -1 : 1); }, -2, 2},
    {"x^7", [](const D& x) { return pow(x, 7); }, [](const Real& x) { return Real(pow(x, 7)); },
     [](const Real& x) { return Real(7 * pow(x, 6)); }, -3, 3},
    {"x^-3", [](const D& x) { return pow(x, -3); }, [](const Real& x) { return Real(1 / (x * x * x)); },
     [](const Real& x) { return Real(-3 / (x * x * x * x)); }, 0.5, 3},
    {"x*x", [](const D& x) { return x * x; }, [](const Real& x) { return Real(x * x); },
     [](const Real& x) { return Real(2 * x); }, -3, 3},
    {"3/x", [](const D& x) { return 3 / x; }, [](const Real& x) { return Real(3 / x); },
     [](const Real& x) { return Real(-3 / (x * x)); }, 0.1, 3},
    {"x/3", [](const D& x) { return x / 3; }, [](const Real& x) { return Real(x / 3); },
     [](const Real&) { return Real(1) / 3; }, -3, 3},
    {"x/(x+1)", [](const D& x) { return x / (x + 1); }, [](const Real& x) { return Real(x / (x + 1)); },
     [](const Real& x) { return Real(1 / ((x + 1) * (x + 1))); }, 0, 0.5},
    {"5-2x", [](const D& x) { return 5 - 2 * x; }, [](const Real& x) { return Real(5 - 2 * x); },
     [](const Real&) { return Real(-2); }, -1, 1}};

class DualFunction : public ::testing::TestWithParam<Function> {};

// Eight units in the last place: a rule has at most three operations and two library functions with at most
// two units each. Both partial derivatives, with the factors 3 and -0.5 of the argument.
TEST_P(DualFunction, HasItsDerivative) {
  const Function& f = GetParam();
  for (int i = 0; i <= 1000; ++i) {
    const double at = f.low + (f.high - f.low) * (i + 0.37) / 1001;
    D x = at;
    x.partial = {3, -0.5};
    const D y = f.dual(x);
    const Real value = f.value(at), slope = f.slope(at);
    EXPECT_LE(abs(y.value - value), 8 * epsilon * abs(value)) << f.name << " at " << at;
    EXPECT_LE(abs(y.partial[0] - 3 * slope), 8 * epsilon * abs(3 * slope)) << f.name << " at " << at;
    EXPECT_LE(abs(y.partial[1] + slope / 2), 8 * epsilon * abs(slope / 2)) << f.name << " at " << at;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DualFunction, ::testing::ValuesIn(functions), [](const auto& tested) {
  std::string name;
  for (const char c : std::string(tested.param.name)) name += std::isalnum(c) != 0 ? c : '_';
  return name + "_" + std::to_string(tested.index);
});

// Rounding of p - 1 changes the power by eps |p log x|, in addition to the eight units of the rule.
RC_GTEST_PROP(DualPower, HasBothPartialDerivatives, ()) {
  const double x = *between(0.05, 20), p = *between(-6, 6);
  const D base = D::variable(x, 0), exponent = D::variable(p, 1);
  const Real value = pow(Real(x), Real(p)), by_base = p * value / x, by_exponent = value * log(Real(x));
  const double tolerance = epsilon * (8 + std::abs(p * std::log(x)));
  for (const D& y : {pow(base, p), pow(base, exponent)}) {
    RC_ASSERT(abs(y.value - value) <= tolerance * value);
    RC_ASSERT(abs(y.partial[0] - by_base) <= tolerance * abs(by_base));
  }
  RC_ASSERT(pow(base, p).partial[1] == 0);
  RC_ASSERT(abs(pow(base, exponent).partial[1] - by_exponent) <= tolerance * abs(by_exponent));
}

/// Random value and partial derivatives; the value is a divisor, so it is not near 0.
rc::Gen<D> any_dual() {
  return rc::gen::map(rc::gen::tuple(between(0.5, 2), between(-2, 2), between(-2, 2)), [](const auto& t) {
    D x = std::get<0>(t);
    x.partial = {std::get<1>(t), std::get<2>(t)};
    return x;
  });
}

/// Do two results differ by at most @p units in the last place of the @p scale of their terms?
bool close(const D& a, const D& b, double scale, int units) {
  const double tolerance = units * epsilon * scale;
  return std::abs(a.value - b.value) <= tolerance && std::abs(a.partial[0] - b.partial[0]) <= tolerance &&
         std::abs(a.partial[1] - b.partial[1]) <= tolerance;
}

// Identities that no rule of differentiation uses. Values and partial derivatives are at most 2, so the terms
// of a product of three stay below 3 * 8 and the quotients below 2^5.
RC_GTEST_PROP(DualArithmetic, IsThatOfAField, ()) {
  const D a = *any_dual(), b = *any_dual(), c = *any_dual();
  RC_ASSERT(close(a * (b + c), a * b + a * c, 24, 8));
  RC_ASSERT(close((a * b) * c, a * (b * c), 24, 8));
  RC_ASSERT(close((a / b) * b, a, 32, 8));
  RC_ASSERT(close((a - b) + b, a, 4, 2));
  RC_ASSERT(-(a - b) == b - a);
  RC_ASSERT(+a == a);
  D d = a;
  d += b;
  d *= c;
  d -= b;
  d /= c;
  RC_ASSERT(close(d, a + b - b / c, 32, 32));
}

RC_GTEST_PROP(DualArithmetic, WithAConstantIsThatWithAConstantDual, ()) {
  const D a = *any_dual();
  const double s = *between(0.5, 2);
  const D constant = s;
  RC_ASSERT(a + s == a + constant && s + a == constant + a && a - s == a - constant);
  RC_ASSERT(s - a == constant - a && a * s == a * constant && s * a == constant * a);
  RC_ASSERT(close(a / s, a / constant, 8, 4) && close(s / a, constant / a, 16, 8));
}

// ---- Dual numbers where a function is not differentiable, not finite, or nearly so.

const double inf = std::numeric_limits<double>::infinity();

TEST(DualEdges, AConstantFactorMeetsInfinityAsANumberDoes) {
  D x = D::variable(inf, 0);
  // The rule for two dual numbers would give 2 * 1 + inf * 0 = NaN.
  EXPECT_EQ((2.0 * x).partial[0], 2);
  EXPECT_EQ((x / 2.0).partial[0], 0.5);
  EXPECT_EQ((x + 1.0).partial[0], 1);
  x *= 0.5;
  EXPECT_EQ(x.value, inf);
  EXPECT_EQ(x.partial[0], 0.5);
}

TEST(DualEdges, InfiniteSlopesReachOnlyTheirVariable) {
  const D x = D::variable(0, 0);
  for (const D& y : {sqrt(x), pow(x, 0.5)}) {
    EXPECT_EQ(y.value, 0);
    EXPECT_EQ(y.partial[0], inf);
    EXPECT_EQ(y.partial[1], 0) << "0 * inf";
  }
  EXPECT_EQ(log(x).value, -inf);
  EXPECT_EQ(log(x).partial[0], inf);
  EXPECT_EQ(log(x).partial[1], 0);
  EXPECT_EQ((1 / x).partial[1], 0);
}

TEST(DualEdges, PowersAtZero) {
  const D x = D::variable(0, 0);
  EXPECT_EQ(pow(x, 0), D(1.0));
  EXPECT_EQ(pow(x, 0.0), D(1.0));
  EXPECT_EQ(pow(x, 1), x);
  EXPECT_EQ(pow(x, 1.0), x);
  EXPECT_EQ(pow(x, 2), D(0.0));
  EXPECT_EQ(pow(x, 1.5), D(0.0));
  EXPECT_EQ(pow(x, D::variable(2, 1)), D(0.0));
  // As documented, products follow IEEE arithmetic.
  EXPECT_TRUE(std::isnan((x * sqrt(x)).partial[0]));
}

TEST(DualEdges, NegativeBasesHaveIntegerPowers) {
  const D x = D::variable(-2, 0), y = pow(x, 3), z = pow(x, -1);
  EXPECT_EQ(y.value, -8);
  EXPECT_EQ(y.partial[0], 12);
  EXPECT_EQ(z.value, -0.5);
  EXPECT_EQ(z.partial[0], -0.25);
  EXPECT_TRUE(std::isnan(pow(x, 0.5).value));
}

TEST(DualEdges, AbsoluteValueAtZeroIsDerivedFromTheRight) {
  EXPECT_EQ(abs(D::variable(0.0, 0)).partial[0], 1);
  EXPECT_EQ(abs(D::variable(-0.0, 0)).partial[0], 1);
  EXPECT_EQ(abs(D::variable(-1e-300, 0)).partial[0], -1);
}

TEST(DualEdges, TanhKeepsItsSlopeWhereItIsAlmostOne) {
  // Within eight units, although tanh(25) is 1 in doubles; beyond the range of cosh the result is 0.
  const Real exact = 1 / (cosh(Real(25)) * cosh(Real(25)));
  const D y = tanh(D::variable(25, 0));
  EXPECT_EQ(y.value, 1);
  EXPECT_LE(abs(y.partial[0] - exact), 8 * epsilon * exact);
  EXPECT_EQ(tanh(D::variable(-800, 0)).value, -1);
  EXPECT_EQ(tanh(D::variable(-800, 0)).partial[0], 0);
}

TEST(DualEdges, AnglesKeepTheirDerivativesInAllQuadrantsAndAtAllSizes) {
  for (const double size : {1e-300, 1.0, 1e300}) {
    for (const double x : {-3 * size, 3 * size}) {
      for (const double y : {-4 * size, 4 * size}) {
        const D angle = atan2(D::variable(y, 0), D::variable(x, 1));
        EXPECT_EQ(angle.value, std::atan2(y, x));
        // Four operations with half a unit each: within four units.
        EXPECT_NEAR(angle.partial[0], x / size / 25 / size, 4 * epsilon / size);
        EXPECT_NEAR(angle.partial[1], -y / size / 25 / size, 4 * epsilon / size);
      }
    }
  }
  EXPECT_FALSE(std::isfinite(atan2(D::variable(0, 0), D(0.0)).partial[0]));
  EXPECT_EQ(asin(D::variable(1, 0)).partial[0], HUGE_VAL);
}

TEST(DualEdges, NaNIsPassedOn) {
  const D x = D::variable(std::nan(""), 0);
  EXPECT_TRUE(std::isnan((x + 1).value));
  EXPECT_TRUE(std::isnan(exp(x).partial[0]));
  EXPECT_FALSE(x == x);
}

template <class A, class B>
concept HasOrder = requires(const A& a, const B& b) {
  a < b;
};

TEST(DualType, HasNoOrderAndSaysWhatIsInside) {
  static_assert(!HasOrder<D, D>);
  static_assert(!HasOrder<D, double>);
  using DD = Dual<D, 3>;
  static_assert(std::is_same_v<decltype(value_of(DD())), double>);
  static_assert(std::is_same_v<decltype(value_of(Dual<Real, 1>())), Real>);
  static_assert(std::is_same_v<decltype(value_of(2.0L)), long double>);
  EXPECT_EQ(value_of(DD(D(1.5))), 1.5);
  EXPECT_EQ(value_of(-3.0), -3.0);
}

TEST(DualType, EqualsInValueAndPartialDerivatives) {
  EXPECT_EQ(D(2.0), D(2));
  EXPECT_FALSE(D(2.0) == D::variable(2, 1));
  EXPECT_EQ(D::variable(2, 1).partial[0], 0);
  EXPECT_EQ(D::variable(2, 1).partial[1], 1);
  EXPECT_EQ(D(), D(0.0));
}

// ---- Jacobian and Hessian matrices of a function of all operations, against differences in 50 digits, which
// use no rule of differentiation.

/// A function of three variables in (0.5, 1.5): values, first and second derivatives below 200.
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
  // Truncation h^2 f'''/6 and rounding 1e-50/h stay below 1e-28; each of some twenty terms below 200 has a
  // few units of rounding: 64 units of 200 bound them.
  const Real h = 1e-16;
  for (int j = 0; j < 3; ++j) {
    const Vector<Real, 2> slope =
        (tangle<Real>(shifted(exact, j, h)) - tangle<Real>(shifted(exact, j, -h))) / Real(2 * h);
    for (int i = 0; i < 2; ++i) RC_ASSERT(abs(jacobian(i, j) - slope[i]) < 64 * 200 * epsilon);
  }
}

RC_GTEST_PROP(DualHessian, IsThatByDifferencesInFiftyDigits, ()) {
  using DD = Dual<Dual<double, 3>, 3>;
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
  using D3 = Dual<double, 3>;
  const Matrix<double, 3> a = (Matrix<double, 3>() << 1, 2, 3, 4, 5, 6, 7, 8, 10).finished();
  const Vector<double, 3> at(0.5, -2, 4);
  const Vector<D3, 3> x = variables(at);
  EXPECT_EQ(jacobian_of<double>(Vector<D3, 3>(a * x)), a);
  EXPECT_EQ(jacobian_of<double>(Vector<D3, 3>(2.0 * x + x / 2.0 - x)), (1.5 * Matrix<double, 3>::Identity()));
  EXPECT_EQ(jacobian_of<double>(Vector<D3, 1>(x.sum())), (Matrix<double, 1, 3>::Ones()));
  const D3 square = x.squaredNorm();  // exact: all numbers are short
  EXPECT_EQ(square.value, at.squaredNorm());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(square.partial[static_cast<std::size_t>(i)], 2 * at[i]);
  EXPECT_EQ(x.dot(at.cast<D3>()).partial[1], -2);
  const Vector<D3, 3> product = x.cwiseProduct(x);
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
}  // namespace nlmech::tests::dual_test
