/// Every function of a dual number against its derivative in closed form, in 50 digits.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>

#include "nlmech/program/dual.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::tests::dual_functions_test {
namespace {

using D = Dual<double, 2>;

/// A function of one variable: by dual numbers, its value and its derivative in 50 digits, and where to test.
struct Function {
  const char* name;
  D (*dual)(const D&);
  Real (*value)(const Real&);
  Real (*slope)(const Real&);
  double low, high;
};

// The arithmetic in dual numbers is written through generic functions, so that scalar operands are used too.
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

// Eight units in the last place: a rule has at most three operations and two library functions of at most two
// units each. Both partial derivatives follow, with the factors 3 and -0.5 of the argument's.
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

// Rounding p - 1 turns the power by eps |p log x| beyond the eight units of the rule.
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

/// Random value and partial derivatives, away from 0 where it divides.
rc::Gen<D> any_dual() {
  return rc::gen::map(rc::gen::tuple(between(0.5, 2), between(-2, 2), between(-2, 2)), [](const auto& t) {
    D x = std::get<0>(t);
    x.partial = {std::get<1>(t), std::get<2>(t)};
    return x;
  });
}

/// Are two results equal but for @p units in the last place of the @p scale of their terms?
bool close(const D& a, const D& b, double scale, int units) {
  const double tolerance = units * epsilon * scale;
  return std::abs(a.value - b.value) <= tolerance && std::abs(a.partial[0] - b.partial[0]) <= tolerance &&
         std::abs(a.partial[1] - b.partial[1]) <= tolerance;
}

// Identities that no rule of differentiation is built from. Values and partial derivatives are at most 2, so
// that the terms of a product of three stay below 3 * 8 and the quotients below 2^5.
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

// Terms: |exp| and |sinh| below e^2, times partial derivatives below 2.
RC_GTEST_PROP(DualFunctions, KeepTheirIdentities, ()) {
  const D x = *any_dual();
  RC_ASSERT(close(sin(x) * sin(x) + cos(x) * cos(x), 1.0, 4, 4));
  RC_ASSERT(close(cosh(x) * cosh(x) - sinh(x) * sinh(x), 1.0, 64, 16));
  RC_ASSERT(close(exp(log(x)), x, 4, 8));
  RC_ASSERT(close(sqrt(x) * sqrt(x), x, 4, 8));
  RC_ASSERT(close(tan(x / 2) * cos(x / 2), sin(x / 2), 8, 8));
  RC_ASSERT(close(tanh(x) * cosh(x), sinh(x), 16, 8));
  RC_ASSERT(close(pow(x, 3), x * x * x, 24, 8));
  RC_ASSERT(close(pow(x, 0.5), sqrt(x), 4, 8));
  RC_ASSERT(close(pow(x, x), exp(x * log(x)), 64, 8));
}

}  // namespace
}  // namespace nlmech::tests::dual_functions_test
