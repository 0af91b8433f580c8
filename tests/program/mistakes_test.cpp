/// Input errors in equations: the message marks the place and states what was expected.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nlmech/program/equations.hpp"
#include "tests/thrown.hpp"

namespace nlmech::program::mistakes_test {
namespace {

/// The message for a text; "" if it is accepted.
std::string refusal(const std::string& text, const Settings& settings = {}) {
  return tests::thrown<InputError>([&] { return Equations(SourceText("E", text), settings); });
}

struct Case {
  const char* text;
  const char* message;
};

TEST(Mistake, IsPointedAt) {
  const Case cases[] = {
      {"x'' + y = 0",
       "E:1:7: y is not defined: it has neither a derivative (y') nor a definition (y = ...)\n  x'' + y = "
       "0\n        ^"},
      {"x'' + ab = 0; a = 1; b = 2", "E:1:7: ab is not defined; a product is written a b\n"},
      {"x'' + = 0", "E:1:7: expected a number, a name or (\n  x'' + = 0\n        ^"},
      {"x'' + (x = 0", "E:1:10: expected an operator or )\n"},
      {"x'' + x", "E:1:8: expected an operator or =, but the text ends here\n"},
      {"x'' = x = 0", "E:1:9: an equation must have exactly one sign =\n"},
      {"x''^2 = x", "E:1:1: x'' is in a power; a highest derivative must occur linearly\n  x''^2 = x\n  ^^^"},
      {"sin(x') = x", "E:1:5: x' is in a function; a highest derivative must occur linearly\n"},
      {"x' y' = x; y' = 1",
       "E:1:4: y' is in a product with another one; a highest derivative must occur linearly\n"},
      {"1/x' = x", "E:1:3: x' is in a divisor; a highest derivative must occur linearly\n"},
      {"x + 1 = 0", "E:1:1: there is no unknown: a derivative is written x' or x''\n"},
      {"x'' = 1; x + x' = 0",
       "E:1:10: this equation has no highest derivative of an unknown; it needs one of x''\n"},
      {"x'' = y'", "E:1:7: y': no equation determines it\n"},
      {"x' = 1; x' = 2", "E:1:9: there are more equations than unknowns (x')\n"},
      {"x' + y' = 1; 2 x' + 2 y' = 3", "E:1:1: x': the equations do not determine it\n"},
      {"x'' - x'' = 3",
       "E:1:1: this equation has no highest derivative of an unknown; it needs one of x''\n"},
      {"x' = a(1 + x); a = 2",
       "E:1:6: a is no function; for a product write a*(...), or a blank before the bracket\n"},
      {"x' = -arctan(x)", "E:1:7: arctan is not a function here; atan is\n  x' = -arctan(x)\n        ^^^^^^"},
      {"x' = Sin(x)", "E:1:6: Sin is not a function here; sin is\n"},
      {"x' = sine(x)", "E:1:6: sine is not a function here; sin is\n"},
      {"x' = pow(x, 2)", "E:1:6: pow is not a function here; ^ is\n"},
      {"x' = gamma(x)", "E:1:6: gamma is not a function here; functions are sqrt exp log ln "},
      {"x' = besselj(0, x)", "E:1:6: besselj is not a function here; functions are sqrt exp log ln "},
      {"x' = gamma(1 + x); gamma = 2",
       "E:1:6: gamma is no function; for a product write gamma*(...), or a blank before the bracket\n"},
      {"x' = k(1 + x)",
       "E:1:6: k is no function; for a product write k*(...), or a blank before the bracket\n"},
      {"x' = -x(t - 1)",
       "E:1:7: x at another time: delays are not supported; for a product write x*(...), or a blank before"},
      {"x' = -x(t)", "E:1:7: write an unknown as x, without the time\n"},
      {"x' = if(x, 1, 2)", "E:1:10: expected an operator or one of < <= > >=\n"},
      {"x' = if(x = 1, 1, 2)", "E:1:11: expected an operator or one of < <= > >=\n"},
      {"x' = if(0 < x < 1, 1, 2)", "E:1:15: join two comparisons by and\n"},
      {"x' = if(x < 1, 2)", "E:1:6: if takes 3 arguments, not 2\n"},
      {"x' = if((x < 1 and t < 1, 2, 3)", "E:1:12: expected an operator or )\n"},
      {"x' = if(x < 1, x', 3)", "E:1:16: x' is in a function; a highest derivative must occur linearly\n"},
      {"x' = mod(t, x)", "E:1:13: the second argument of mod must be a number other than 0\n"},
      {"x' = mod(t, 1 - 1)", "E:1:13: the second argument of mod must be a number other than 0\n"},
      {"x' = table(\"a.csv\")", "E:1:6: tables are not supported here\n"},
      {"x' = table(a)", "E:1:12: the name of a file must be in quotation marks: table(\"load.csv\")\n"},
      {"x' = table(\"a\", 2)", "E:1:17: expected the word steps\n"},
      {"x' = table(\"a", "E:1:12: the name of a file must end with a quotation mark\n"},
      {"x' = sin(\"a\")", "E:1:10: a second derivative is written with two primes, x''\n"},
      {"x' = acosh(0.5) x", "E:1:6: the result is not a real number\n"},
      {"x' = sin x", "E:1:6: sin is a function, and needs its argument in brackets: sin(...)\n"},
      {"x' = sin^2(x)", "E:1:9: write a power of a function as sin(...)^2\n"},
      {"x' = atan2(x)", "E:1:6: atan2 takes 2 arguments, not 1\n"},
      {"x' = x ** 2", "E:1:8: write a power with ^\n"},
      {"x' = x 2", "E:1:8: a number must precede what it multiplies; else write * or ^\n"},
      {"x' = a/b x; a = 1; b = 2", "E:1:10: is this (a/b) x or a/(b x)? Set brackets, or write *\n"},
      {"x' = 1.2.3", "E:1:6: a number must have at most one decimal point\n"},
      {"x' = 1e999", "E:1:6: this number is beyond the range of double precision\n"},
      {"x' = x $ 2", "E:1:8: $ has no meaning here\n"},
      {"x\" = 2", "E:1:2: a second derivative is written with two primes, x''\n"},
      {"x' = (a)'", "E:1:9: a prime must directly follow the name of an unknown\n"},
      {"x''''' = 1", "E:1:1: derivatives go up to order 4\n"},
      {"t' = 1", "E:1:1: t is reserved for the time\n"},
      {"x' = x; sin = 2", "E:1:9: sin is a function, and needs its argument in brackets: sin(...)\n"},
      {"x' = a; a = b; b = a", "E:1:20: the definition of a depends on itself\n"},
      {"x' = a; a = 1; a = 2", "E:1:16: a is defined twice\n"},
      {"x' = e^x", "E:1:6: e is not defined; write exp(1), or exp(x) for e^x\n"},
      {"x' = 1; x(0) = 1; x(0) = 2", "E:1:19: given twice\n"},
      {"x'' = 1; x(0) = 1; x'(1) = 2", "E:1:20: another initial value is given at time 0\n"},
      {"x' = 1; x(0) = x", "E:1:16: an initial value must be a number, or an expression of constants\n"},
      {"x' = 1; x''(0) = 1", "E:1:9: no component of the state; these are x\n"},
      {"x' = y\ny' = 2 x +\nz' = 1", "E:3:4: an equation must have exactly one sign =\n"},
      {"x'' = \u2212x", "E:1:7: a minus sign is typed -\n  x'' = \u2212x\n        ^"},
      {"x'' = x\u00b2", "E:1:8: a square is typed ^2\n  x'' = x\u00b2\n         ^"},
      {"x'' = |x|", "E:1:7: an absolute value is typed abs(...)\n"},
      {"x'' = 30\u00b0", "E:1:9: angles are in radians: write a degree as pi/180\n"},
      {"x\u2032 = 1", "E:1:2: a derivative is typed with a straight prime, x'\n"},
      {"x' = x \xff", "E:1:8: \\xff has no meaning here\n  x' = x \\xff\n         ^^^^"},
      {"x' =\t\t$", "E:1:7: $ has no meaning here\n  x' =\\t\\t$\n          ^"},
      {"# a\u00f1o\r\nx' = 1 +\r\n  y\r\n",
       "E:3:3: y is not defined: it has neither a derivative (y') nor a definition (y = ...)\n    y\n    ^"},
      {"\xEF\xBB\xBFx' = y",
       "E:1:6: y is not defined: it has neither a derivative (y') nor a definition (y = ...)\n  x' = y\n     "
       "  ^"},
      {"x' = 1..2", "E:1:6: a number must have at most one decimal point\n"},
      {"x' = 1e400", "E:1:6: this number is beyond the range of double precision\n"},
      {"x' = 1e200^2", "E:1:6: the result is infinite, or beyond the range of double precision\n"},
      {"x' = 1 + x/(2 - 2)", "E:1:12: a division by zero\n"},
      {"x' = log(a) x; a = -1",
       "E:1:6: the result is not a real number\n  x' = log(a) x; a = -1\n       ^^^^^^"},
      {"x'/0 = 1", "E:1:4: a division by zero\n"},
      {"x' = x - 1 = 2", "E:1:12: an equation must have exactly one sign =\n"},
      {"x' = 2 x)", "E:1:9: expected an operator or the end of the equation\n"},
      {"x' = (x; y' = 1", "E:1:8: expected an operator or ), but the equation ends here\n"},
      {"x' = [x]", "E:1:6: only round brackets are allowed\n"},
      {"x' = x, y' = 1", "E:1:7: expected an operator or the end of the equation\n"},
      {"x'(1 + x') = 1", "E:1:4: the time of an initial value must be a number"},
      {"x' x' = 1", "E:1:4: x' is in a product with another one"},
      {"x'' + 2^x'' = 0", "E:1:9: x'' is in an exponent; a highest derivative must occur linearly\n"},
      {"x'' = abs(x'')", "E:1:11: x'' is in a function; a highest derivative must occur linearly\n"},
      {"x(t) = 1; x' = 1", "E:1:3: the time of an initial value must be a number"},
      {"x' = 1; x(0) 1 = 2", "E:1:9: x is no function; for a product write x*(...)"},
      {"x' = 1; t >= 2", "E:1:9: a condition on t must be an upper bound, the end: t <= 10\n"},
      {"x' = 1; t <= 2; t < 3", "E:1:17: given twice\n"},
      {"x' = 1; x >= 0; x >= 1", "E:1:17: given twice\n"},
      {"x' = 1; x >= 1; x <= 0", "E:1:17: the lower bound is above the upper bound\n"},
      {"x' = a; a = 1; a > 1", "E:1:16: this does not hold: a is 1\n"},
      {"x' = a; a = x; a > 1", "E:1:16: the left side of a condition must be a number"},
      {"x' = 1; x <= x", "E:1:14: a bound must be a number"},
      {"x' = 1; 2 x <= 1", "E:1:9: a condition must start with t, a component or a definition\n"},
      {"x' = 1; x' <= 1", "E:1:9: the left side of a condition must be a number"},
      {"x' = 1; x < 1 = 2", "E:1:15: expected an operator or the end of the condition\n"},
      {"x' = 1; conserved x'", "E:1:19: x' is not allowed here: it is not a component of the state\n"},
      {"x' = 1; conserved x = 2", "E:1:9: conserved is not defined"},
      {"x' = 1; conserved (x", "E:1:21: expected an operator or ), but the text ends here\n"},
      {"x' = 1; t \u2264 1", "E:1:11: this is typed <=\n"},
      {"", "E:1:1: there is no unknown: a derivative is written x' or x''\n"},
  };
  for (const Case& c : cases)
    EXPECT_EQ(refusal(c.text).substr(0, std::string(c.message).size()), c.message) << refusal(c.text);
}

TEST(Mistake, InColumns) {
  const auto refused = [](const std::string& text) {
    Equations equations(SourceText("E", "x'' = -x; r = 2 x"));
    std::vector<Equations::Column> columns;
    return tests::thrown<InputError>([&] { equations.read_columns("C", text, columns); });
  };
  const Case cases[] = {{"E = x^2 +", "C:1:10: expected a number, a name or (, but the text ends here\n"},
                        {"E = y", "C:1:5: y is not defined"},
                        {"E", "C:1:1: E is not defined"},
                        {"x", "C:1:1: x is a column already\n"},
                        {"E = x; E = 2 x", "C:1:8: E is already defined; take another name\n"},
                        {"r; r", "C:1:4: r is a column already\n"},
                        {"r = 3", "C:1:1: r is already defined; take another name\n"},
                        {"x'' = 3", "C:1:1: x'' is already defined; take another name\n"},
                        {"2 x", "C:1:1: a column must be name = expression, or the name of a definition\n"},
                        {"E = x = 2", "C:1:7: expected an operator, = or the end of the column\n"},
                        {";", "C:1:1: no column is given\n"}};
  for (const Case& c : cases)
    EXPECT_EQ(refused(c.text).substr(0, std::string(c.message).size()), c.message) << refused(c.text);
}

TEST(Mistake, OfASetting) {
  EXPECT_EQ(refusal("x' = a; a = 1", {{"b", 2}}),
            "--set b: the equation has no such definition; choose one of a");
  EXPECT_EQ(refusal("x' = a; a = 1", {{"x", 2}}),
            "--set x: the equation has no such definition; choose one of a");
  EXPECT_EQ(refusal("x' = 1", {{"t", 2}}), "--set t: the equation has no such definition");
  EXPECT_EQ(refusal("x' = a; a = 1", {{"a", std::nan("")}}), "--set a: must be a finite number, not nan");
  EXPECT_EQ(refusal("x' = a; a = 1; a > 0", {{"a", -2}}), "--set a=-2: the equations require a > 0");
  EXPECT_EQ(refusal("x' = a; a = 1; a > 0", {{"a", 2}}), "");
  // Conditions are checked before the expressions that they protect.
  EXPECT_EQ(refusal("x' = 1/a; b = 1/a; a = 1; a > 0; x(0) = 1/a", {{"a", 0}}),
            "--set a=0: the equations require a > 0");
  const std::string derived = refusal("x' = b; b = 2 a; a = 1; b > 0", {{"a", -1}});
  EXPECT_TRUE(derived.starts_with("E:1:25: this does not hold: b is -2 with the values of --set\n"))
      << derived;
  EXPECT_EQ(refusal("x' = 1/a; a = 1", {{"a", 0}}).substr(0, 26), "E:1:8: a division by zero\n");
}

TEST(Mistake, OfAnInitialState) {
  Equations e(SourceText("E", "x'' + y = 0; y' = x"));
  const auto refused = [&](const std::string& text) {
    return tests::thrown<InputError>([&] { return e.initial_state("--initial", text); });
  };
  EXPECT_EQ(refused("x=1, x'=2"),
            "E:1:14: an initial value is missing: --initial y=...\n  x'' + y = 0; y' = x\n               ^^");
  EXPECT_EQ(refused("x=1, x=2"), "--initial:1:6: given twice\n  x=1, x=2\n       ^");
  EXPECT_EQ(refused("x=1, z=2"),
            "--initial:1:6: no component of the state; these are x, y, x'\n  x=1, z=2\n       ^");
  EXPECT_EQ(refused("x=1, y"),
            "--initial:1:7: expected an operator or =, but the text ends here\n  x=1, y\n        ^");
  EXPECT_EQ(refused("x=1/0, y=1, x'=1"), "--initial:1:5: a division by zero\n  x=1/0, y=1, x'=1\n      ^");
}

TEST(Mistake, DepthIsBounded) {
  const std::string deep(100'000, '(');
  EXPECT_TRUE(tests::holds(refusal("x' = " + deep), "nested more than 200 deep"));
  EXPECT_TRUE(tests::holds(refusal("x' = " + std::string(100'000, '-') + "1"), "nested more than 200 deep"));
  std::string powers = "x' = 2";
  for (int i = 0; i < 1000; ++i) powers += "^2";
  EXPECT_TRUE(tests::holds(refusal(powers), "nested more than 200 deep"));
  std::string chain = "x' = a0; a5000 = 1";
  for (int i = 0; i < 5000; ++i) chain += ";a" + std::to_string(i) + "=a" + std::to_string(i + 1);
  EXPECT_TRUE(tests::holds(refusal(chain), "definitions are nested too deeply here"));
  EXPECT_TRUE(
      tests::holds(refusal(std::string(61, 'x') + "' = 1"), "a name must have at most 60 characters"));
  EXPECT_TRUE(tests::holds(refusal(std::string(1'000'001, ' ')), "longer than 1000000 bytes"));
}

// Definitions that double, nested choices and long lists of highest derivatives: shared subexpressions, or
// refused.
TEST(Mistake, GrowthIsBounded) {
  std::string doubling = "x' = a60; a0 = 1 + x";
  for (int i = 1; i <= 60; ++i) doubling += fmt::format("; a{0} = a{1} a{1} + a{1}", i, i - 1);
  EXPECT_EQ(refusal(doubling), "");
  EXPECT_LT(Equations(SourceText("E", doubling)).graph().nodes(), 300);
  std::string choices = "x' = a60; a0 = x";
  for (int i = 1; i <= 60; ++i) choices += fmt::format("; a{0} = abs(a{1} - {0}) + max(a{1}, {0})", i, i - 1);
  EXPECT_EQ(refusal(choices), "");
  EXPECT_LT(Equations(SourceText("E", choices)).graph().nodes(), 1000);

  // 1500 highest derivatives, each multiplied by each of 1500 factors: two million operations.
  std::string sum = "F = x0'", product = "0 = F";
  for (int i = 1; i < 1500; ++i) {
    sum += fmt::format(" + x{}'", i);
    product += fmt::format(" (1 + t/{})", i);
  }
  const char* const too_many = "the equations have more than 1000000 operations";
  EXPECT_TRUE(tests::holds(refusal(product + "; " + sum), too_many));
  std::string copies = "0 = F";
  for (int i = 0; i < 100'000; ++i) copies += "+F";
  EXPECT_TRUE(tests::holds(refusal(copies + "; " + sum), too_many));
}

TEST(Mistake, LongSumsAreNone) {
  std::string sum = "x' = 0";
  for (int i = 0; i < 100'000; ++i) sum += "+x";
  EXPECT_EQ(refusal(sum), "");
}

/// Random sequences of the language's tokens are read or refused. More of them: tests/randomised.
TEST(Mistake, NoTextBreaksTheReader) {
  const char* const words[] = {"x",  "x'", "x''", "y",     "y'",   "t",    "a",      "1",     "2.5",
                               "+",  "-",  "*",   "/",     "^",    "(",    ")",      "=",     ";",
                               ",",  "\n", " ",   "sin(",  "abs(", "min(", "atan2(", "sqrt(", "1e300",
                               "pi", "'",  "#",   "x(0)=", "\xff", "e"};
  std::mt19937 random(20261124);
  int accepted = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = i % 2 == 0 ? "x' = " : "";
    for (auto n = random() % 12; n > 0; --n) text += words[random() % std::size(words)];
    accepted += refusal(text).empty() ? 1 : 0;
  }
  EXPECT_GT(accepted, 200);
}

}  // namespace
}  // namespace nlmech::program::mistakes_test
