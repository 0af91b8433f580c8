/// Typed equations: any text is read within bounds or refused at a place; values, derivatives and Taylor
/// coefficients of random expressions agree with a separate expression tree in 60 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/machine_code/machine_code.hpp"
#include "nlmech/program/problem.hpp"
#include "tests/randomised/expression_tree.hpp"
#include "tests/randomised/mutation.hpp"

namespace nlmech::randomised::equations_test {
namespace {

using program::Equations;
using program::Problem;
using program::SourceText;

const std::vector<std::string>& examples() {
  static const std::vector<std::string> all = {
      "x'' + 0.1 x' + x + 3 x^3 = 0.2 cos(1.1 t)",
      "(1 + x^2) x'' + x x'^2 = 0; x(0) = 1; x'(0) = -2",
      "2 a'' + b'' cos(a - b) + b'^2 sin(a - b) + 2 g sin(a) = 0\nb'' + a'' cos(a - b) = g; g = 9.81 # m/s^2",
      "w'''' = -max(w, 0) + sign(w') - abs(w'')/min(t, 2) + atan2(w, w')^0.5",
      "r = sqrt(x^2 + y^2)\r\nx' = y/r\r\ny' = -x/r + t^2^x - .5e-3 pi erf(t)\r\n",
      "L i' + R i + B x' = U cos(w t); m x'' + (k + k3 x^2) x = B i; L = 5e-4; R = 6; U = 8; w = 2 pi*40\n"
      "m = 0.02; k = 1500; k3 = 4e7; B = 7; i(0) = 0; x(0) = 0; x'(0) = 1/2",
      "x0' + x1' = 1; x1' - x2' x1 = exp(-t); x0' + x1' + x2' = tanh(x0); x3' x3 + x0' = log(1 + x3^2)"};
  return all;
}

/// Words of the language in random order.
std::string babble(Draw& draw) {
  static const std::vector<std::string> words = {"x",
                                                 "x'",
                                                 "x''",
                                                 "y",
                                                 "y'",
                                                 "t",
                                                 "a",
                                                 "k2",
                                                 "1",
                                                 "2.5",
                                                 "1e300",
                                                 "pi",
                                                 "+",
                                                 "-",
                                                 "*",
                                                 "/",
                                                 "^",
                                                 "(",
                                                 ")",
                                                 "=",
                                                 ";",
                                                 ",",
                                                 "\n",
                                                 " ",
                                                 "'",
                                                 "sin(",
                                                 "abs(",
                                                 "min(",
                                                 "atan2(",
                                                 "sqrt(",
                                                 "max(",
                                                 "sign(",
                                                 "a = ",
                                                 "x(0)=",
                                                 "\r\n#c\r\n",
                                                 "\xff",
                                                 "-(",
                                                 "x''=",
                                                 "^(1/2)",
                                                 ")(",
                                                 "\xe2\x88\x92",
                                                 "erf("};
  std::string text = draw.chance(0.7) ? "x'' = " : "";
  for (int n = draw.whole(0, 40); n > 0; --n) text += draw.one_of(words);
  return text;
}

// Does the message consist of a description, the line of the text, and a caret?
bool points(const std::string& message) {
  const auto lines = std::count(message.begin(), message.end(), '\n');
  return message.size() < 1500 && message.starts_with("E:") && lines == 2 && message.back() == '^';
}

// An accepted text can be evaluated, and its graph is bounded: each character adds a few operations, and
// powers up to 64 a dozen, for each of four highest derivatives.
bool is_bounded(const std::string& text) {
  const Equations equations(SourceText("E", text));
  const auto most = 200 * (static_cast<int>(text.size()) + 10);
  if (equations.graph().nodes() > most || equations.size() > most) return false;
  const Problem problem(equations);
  Vector<double, Eigen::Dynamic> x = Eigen::VectorXd::LinSpaced(equations.size(), -1, 2), f(equations.size());
  problem(0.5, x, f);
  if (problem.switches() > 0) {
    const program::Mode mode(static_cast<std::size_t>(problem.switches()), 0);
    std::vector<double> values(mode.size()), rates(mode.size());
    problem.in_mode(mode).surfaces(0.5, x, values, rates);
  }
  return equations.slopes().size() == static_cast<std::size_t>(equations.size());
}

TEST(RandomisedEquations, AnyTextIsReadOrRefused) {
  randomised_test({.quick = 3000, .full = 1'000'000, .least_right = 0.02}, [](Draw& draw) {
    const std::string text = draw.chance(0.5) ? damaged(draw, examples()) : babble(draw);
    try {
      return is_bounded(text) ? Case::judged(0, 1, {}) : Case::wrong("out of bounds: " + shown(text));
    } catch (const InputError& error) {
      return points(error.what()) ? Case::refused()
                                  : Case::wrong(shown(text) + " is told " + shown(error.what()));
    }
  });
}

// Error over its bound: some hundred times the effect of rounding every operation, evaluated in 60 digits.
double ratio(double got, const Estimate& exact) {
  if (!std::isfinite(got)) return std::numeric_limits<double>::infinity();
  return static_cast<double>(abs(Real(got) - exact.value)) / static_cast<double>(exact.spread);
}

/// `x' = first, y' = second` with definitions, and a point.
struct Trial {
  explicit Trial(Draw& draw) : trees{Tree(draw), Tree(draw)} {
    for (double& p : point) p = draw.chance(0.2) ? draw.whole(-2, 2) : draw.uniform(-3, 3);
    text = trees[0].text("x'", "d") + "; " + trees[1].text("y'", "e");
  }
  [[nodiscard]] std::string where() const {
    return fmt::format("{} at t, x, y = {:.17g}, {:.17g}, {:.17g}", text, point[0], point[1], point[2]);
  }
  std::array<Tree, 2> trees;
  std::array<double, 3> point{};  // t, x, y
  std::string text;
};

// Cases near limits of a domain are undecided, without a report: the oracle excludes them.
template <class ErrorOf>
Case judged(Draw& draw, const ErrorOf& error_of) {
  const Trial trial(draw);
  try {
    const std::optional<double> worst = error_of(trial);
    return worst ? Case::judged(*worst, 1, trial.where()) : Case::undecided();
  } catch (const InputError& error) {
    // Refused correctly if a part is not finite for any state.
    const bool known = trial.trees[0].value(trial.point) && trial.trees[1].value(trial.point);
    return known ? Case::wrong(trial.where() + " is refused: " + error.what()) : Case::refused();
  }
}

TEST(RandomisedEquations, ValuesAndDerivatives) {
  randomised_test({.quick = 300, .full = 100'000, .least_right = 0.3}, [](Draw& draw) {
    return judged(draw, [](const Trial& trial) -> std::optional<double> {
      const ivp::System system{Problem(Equations(SourceText("E", trial.text)))};
      const ivp::State x{trial.point[1], trial.point[2]};
      ivp::State f(2), g(2);
      ivp::Jacobian j;
      system.rhs(trial.point[0], x, f);
      system.jacobian(trial.point[0], x, j);
      if (!system.time_derivative(trial.point[0], x, g)) return std::nullopt;
      double worst = 0;
      for (int i = 0; i < 2; ++i) {
        const Tree& tree = trial.trees[static_cast<std::size_t>(i)];
        const auto value = tree.value(trial.point);
        if (!value) return std::nullopt;
        worst = std::max(worst, ratio(f[i], *value));
        for (int by = 0; by < 3; ++by) {
          const auto slope = tree.derivative(trial.point, by);
          if (!slope) return std::nullopt;
          worst = std::max(worst, ratio(by == 0 ? g[i] : j(i, by - 1), *slope));
        }
      }
      return worst;
    });
  });
}

// The same bits, but that all NaN are alike.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

double special(Draw& draw) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return draw.chance(0.1) ? draw.one_of({infinity, -infinity, std::nan("")}) : draw.any_finite();
}

TEST(RandomisedEquations, MachineCodeHasTheBitsOfTheInterpreter) {
  const program::Program nothing(program::Graph(1), {});
  if (machine_code::values(nothing, 0, 0) == nullptr) GTEST_SKIP() << "no machine code here";
  randomised_test({.quick = 300, .full = 100'000, .least_right = 0.5}, [](Draw& draw) {
    const Trial trial(draw);
    try {
      const Equations equations(SourceText("E", trial.text));
      const program::Program program(equations.graph(), equations.slopes());
      const auto code = machine_code::values(program, 0, 2);
      if (code == nullptr) return Case::wrong(trial.where() + " has no code");
      for (int i = 0; i < 20; ++i) {
        const bool any = draw.chance(0.3);
        const double t = any ? special(draw) : draw.uniform(-3, 3);
        const std::array<double, 2> x = {any ? special(draw) : draw.uniform(-3, 3),
                                         any ? special(draw) : draw.uniform(-3, 3)};
        std::array<double, 2> got{}, expected{};
        program.run(t, x, 0, 2, [&](int k, double v) { expected[static_cast<std::size_t>(k)] = v; });
        (*code)(t, x.data(), got.data());
        if (!same(got[0], expected[0]) || !same(got[1], expected[1]))
          return Case::wrong(fmt::format("{} at {:.17g}, {:.17g}, {:.17g}", trial.text, t, x[0], x[1]));
      }
      return Case::judged(0, 1, {});
    } catch (const InputError&) {
      return Case::refused();
    }
  });
}

// Coefficients grow as powers of the first one: for exp(12 pi/y) of size 1e52 the sixth is 1e327.
bool is_beyond_doubles(const std::array<std::vector<Estimate>, 2>& coefficients) {
  return std::ranges::any_of(coefficients, [](const auto& of) {
    return std::ranges::any_of(of, [](const Estimate& c) { return abs(c.value) > 1e280; });
  });
}

TEST(RandomisedEquations, TaylorCoefficients) {
  constexpr int order = 6;
  randomised_test({.quick = 60, .full = 20'000, .least_right = 0.1}, [](Draw& draw) {
    return judged(draw, [](const Trial& trial) -> std::optional<double> {
      const auto exact = solution(trial.trees, trial.point, order);
      if (!exact || is_beyond_doubles(*exact)) return std::nullopt;
      const ivp::System system{Problem(Equations(SourceText("E", trial.text)))};
      const ivp::State x{trial.point[1], trial.point[2]};
      auto series = system.taylor(order);
      series.begin_segment(trial.point[0], x);
      series.expand(trial.point[0], x, 1);
      double worst = 0;
      for (int i = 0; i < 2; ++i) {
        for (int k = 0; k <= order; ++k)
          worst = std::max(worst, ratio(series.coefficients(i)[k],
                                        (*exact)[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]));
      }
      return worst;
    });
  });
}

}  // namespace
}  // namespace nlmech::randomised::equations_test
