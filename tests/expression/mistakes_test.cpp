/// A mistake in an equation is pointed at, with a sentence that says what was expected.
#include <gtest/gtest.h>

#include <random>

#include "nlmech/expression/equations.hpp"

namespace nlmech::expression::mistakes_test {
namespace {

std::string refusal(const std::string& text, const Settings& settings = {}) {
  try {
    (void)Equations(SourceText("E", text), settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
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
      {"x'' + x", "E:1:8: expected an operator or =, and here the text ends\n"},
      {"x'' = x = 0", "E:1:9: an equation has one sign =\n"},
      {"x''^2 = x",
       "E:1:1: x'' stands in a power; a highest derivative has to stand linearly\n  x''^2 = x\n  ^^^"},
      {"sin(x') = x", "E:1:5: x' stands in a function; a highest derivative has to stand linearly\n"},
      {"x' y' = x; y' = 1",
       "E:1:4: y' stands in a product with another one; a highest derivative has to stand linearly\n"},
      {"1/x' = x", "E:1:3: x' stands in a divisor; a highest derivative has to stand linearly\n"},
      {"x + 1 = 0", "E:1:1: there is no unknown: a derivative is written x' or x''\n"},
      {"x'' = 1; x + x' = 0", "E:1:10: no highest derivative of an unknown stands here; there are x''\n"},
      {"x'' = y'", "E:1:7: y': there is no equation left for it\n"},
      {"x' = 1; x' = 2", "E:1:9: there are more equations than unknowns (x')\n"},
      {"x' + y' = 1; 2 x' + 2 y' = 3", "E:1:1: x': the equations do not determine it\n"},
      {"x'' - x'' = 3", "E:1:1: no highest derivative of an unknown stands here; there are x''\n"},
      {"x' = a(1 + x); a = 2",
       "E:1:6: a is no function; for a product write a*(...), or a blank before the bracket\n"},
      {"x' = sin x", "E:1:6: sin is a function, and needs its argument in brackets: sin(...)\n"},
      {"x' = sin^2(x)", "E:1:9: a power of a function is written sin(...)^2\n"},
      {"x' = atan2(x)", "E:1:6: atan2 has 2 arguments, and here 1\n"},
      {"x' = x ** 2", "E:1:8: a power is written with ^\n"},
      {"x' = x 2", "E:1:8: a number stands before what it multiplies; else write * or ^\n"},
      {"x' = a/b x; a = 1; b = 2", "E:1:10: is this (a/b) x or a/(b x)? Set brackets, or write *\n"},
      {"x' = 1.2.3", "E:1:6: a number has one decimal point\n"},
      {"x' = 1e999", "E:1:6: this number is beyond the range of double precision\n"},
      {"x' = x $ 2", "E:1:8: $ has no meaning here\n"},
      {"x\" = 2", "E:1:2: a second derivative is written with two primes, x''\n"},
      {"x' = (a)'", "E:1:9: a prime stands directly behind the name of an unknown\n"},
      {"x''''' = 1", "E:1:1: derivatives go up to order 4\n"},
      {"t' = 1", "E:1:1: t is the time\n"},
      {"x' = x; sin = 2", "E:1:9: sin is a function, and needs its argument in brackets: sin(...)\n"},
      {"x' = a; a = b; b = a", "E:1:20: the definition of a leads back to itself\n"},
      {"x' = a; a = 1; a = 2", "E:1:16: a is defined a second time\n"},
      {"x' = e^x", "E:1:6: e is not defined; write exp(1), or exp(x) for e^x\n"},
      {"x' = 1; x(0) = 1; x(0) = 2", "E:1:19: given a second time\n"},
      {"x'' = 1; x(0) = 1; x'(1) = 2", "E:1:20: another initial value is at the time 0\n"},
      {"x' = 1; x(0) = x",
       "E:1:16: an initial value is a number, or an expression of definitions that are\n"},
      {"x' = 1; x''(0) = 1", "E:1:9: no component of the state; these are x\n"},
      {"x' = y\ny' = 2 x +\nz' = 1", "E:3:4: an equation has one sign =\n"},
      {"", "E:1:1: there is no unknown: a derivative is written x' or x''\n"},
  };
  for (const Case& c : cases)
    EXPECT_EQ(refusal(c.text).substr(0, std::string(c.message).size()), c.message) << refusal(c.text);
}

TEST(Mistake, OfASetting) {
  EXPECT_EQ(refusal("x' = a; a = 1", {{"b", 2}}), "--set b: the equation has no such definition; there is a");
}

TEST(Mistake, OfAnInitialState) {
  Equations e(SourceText("E", "x'' + y = 0; y' = x"));
  const auto refused = [&](const std::string& text) -> std::string {
    try {
      (void)e.initial_state("--initial", text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refused("x=1, x'=2"),
            "E:1:14: an initial value is missing: --initial y=...\n  x'' + y = 0; y' = x\n               ^^");
  EXPECT_EQ(refused("x=1, x=2"), "--initial:1:6: given a second time\n  x=1, x=2\n       ^");
  EXPECT_EQ(refused("x=1, z=2"),
            "--initial:1:6: no component of the state; these are x, y, x'\n  x=1, z=2\n       ^");
  EXPECT_EQ(refused("x=1, y"),
            "--initial:1:7: expected an operator or =, and here the text ends\n  x=1, y\n        ^");
  EXPECT_EQ(refused("x=1/0, y=1, x'=1"),
            "--initial:1:3: an initial value is finite, and this is inf\n  x=1/0, y=1, x'=1\n    ^^^");
}

TEST(Mistake, DepthIsBounded) {
  const std::string deep(100'000, '(');
  EXPECT_NE(refusal("x' = " + deep).find("nested more than 200 deep"), std::string::npos);
  EXPECT_NE(refusal("x' = " + std::string(100'000, '-') + "1").find("nested more than 200 deep"),
            std::string::npos);
  std::string powers = "x' = 2";
  for (int i = 0; i < 1000; ++i) powers += "^2";
  EXPECT_NE(refusal(powers).find("nested more than 200 deep"), std::string::npos);
  std::string chain = "x' = a0; a5000 = 1";
  for (int i = 0; i < 5000; ++i) chain += ";a" + std::to_string(i) + "=a" + std::to_string(i + 1);
  EXPECT_NE(refusal(chain).find("definitions are nested too deeply here"), std::string::npos);
  EXPECT_NE(refusal(std::string(1'000'001, ' ')).find("longer than 1000000 bytes"), std::string::npos);
}

TEST(Mistake, LongSumsAreNone) {
  std::string sum = "x' = 0";
  for (int i = 0; i < 100'000; ++i) sum += "+x";
  EXPECT_EQ(refusal(sum), "accepted");
}

/// Random sentences of the language's words: each is read or refused. tests/adversary has many more of them.
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
    accepted += refusal(text) == "accepted" ? 1 : 0;
  }
  EXPECT_GT(accepted, 200);
}

}  // namespace
}  // namespace nlmech::expression::mistakes_test
