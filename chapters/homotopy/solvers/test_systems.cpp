#include "chapters/homotopy/solvers/test_systems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace nlmech::chapters::homotopy {
namespace {

/// The text of equation i = 1..n and the start of unknown i.
std::string system_text(int n, const std::function<std::string(int)>& equation,
                        const std::function<double(int)>& start) {
  std::string text;
  for (int i = 1; i <= n; ++i) text += fmt::format("{} = 0\nx{}(0) = {:.17g}\n", equation(i), i, start(i));
  return text;
}

/// "a(1) + a(2) + ..." for the indices from @p first to @p last for which the text is not empty.
std::string sum_of(int first, int last, const std::function<std::string(int)>& term) {
  std::string text;
  for (int i = first; i <= last; ++i) {
    const std::string here = term(i);
    if (!here.empty()) text += (text.empty() ? "" : " + ") + here;
  }
  return text.empty() ? "0" : text;
}

/// x_i, or 0 beyond the ends.
std::string x_or_0(int i, int n) { return i < 1 || i > n ? "0" : fmt::format("x{}", i); }

/// Start of the two discrete boundary value problems: t (t - 1).
double parabola(int i, int n) {
  const double t = static_cast<double>(i) / (n + 1);
  return t * (t - 1);
}

std::string discrete_boundary_value(int n) {
  return system_text(
      n,
      [n](int i) {
        return fmt::format("2 x{0} - {1} - {2} + (x{0} + {0}/{3} + 1)^3/(2*{3}^2)", i, x_or_0(i - 1, n),
                           x_or_0(i + 1, n), n + 1);
      },
      [n](int i) { return parabola(i, n); });
}

std::string discrete_integral(int n) {
  const auto cube = [n](int j) { return fmt::format("(x{0} + {0}/{1} + 1)^3", j, n + 1); };
  return system_text(
      n,
      [&](int i) {
        const std::string below =
            sum_of(1, i, [&](int j) { return fmt::format("{}/{}*{}", j, n + 1, cube(j)); });
        const std::string above =
            sum_of(i + 1, n, [&](int j) { return fmt::format("{}/{}*{}", n + 1 - j, n + 1, cube(j)); });
        return fmt::format("x{0} + ({1}/{2}*({3}) + {0}/{2}*({4}))/(2*{2})", i, n + 1 - i, n + 1, below,
                           above);
      },
      [n](int i) { return parabola(i, n); });
}

std::string broyden_tridiagonal(int n) {
  return system_text(
      n,
      [n](int i) {
        return fmt::format("(3 - 2 x{0}) x{0} - {1} - 2*{2} + 1", i, x_or_0(i - 1, n), x_or_0(i + 1, n));
      },
      [](int) { return -1.; });
}

std::string broyden_banded(int n) {
  return system_text(
      n,
      [n](int i) {
        const std::string others = sum_of(std::max(1, i - 5), std::min(n, i + 1), [i](int j) {
          return j == i ? std::string() : fmt::format("x{0} (1 + x{0})", j);
        });
        return fmt::format("x{0} (2 + 5 x{0}^2) + 1 - ({1})", i, others);
      },
      [](int) { return -1.; });
}

std::string brown_almost_linear(int n) {
  const std::string sum = sum_of(1, n, [](int j) { return fmt::format("x{}", j); });
  return system_text(
      n,
      [&](int i) {
        if (i < n) return fmt::format("x{} + {} - {}", i, sum, n + 1);
        std::string product = "x1";
        for (int j = 2; j <= n; ++j) product += fmt::format("*x{}", j);
        return product + " - 1";
      },
      [](int) { return 0.5; });
}

std::string trigonometric(int n) {
  const std::string cosines = sum_of(1, n, [](int j) { return fmt::format("cos(x{})", j); });
  return system_text(
      n, [&](int i) { return fmt::format("{0} - ({1}) + {2} (1 - cos(x{2})) - sin(x{2})", n, cosines, i); },
      [n](int) { return 1. / n; });
}

std::string variably_dimensioned(int n) {
  const std::string sum = sum_of(1, n, [](int j) { return fmt::format("{0} (x{0} - 1)", j); });
  return fmt::format("s = {}\n", sum) +
         system_text(
             n, [](int i) { return fmt::format("x{0} - 1 + {0} s (1 + 2 s^2)", i); },
             [n](int i) { return 1 - static_cast<double>(i) / n; });
}

/// Chebyshev's polynomials of 2 x - 1 by their recurrence: Ti_j is T_i at unknown j.
std::string chebyquad(int n) {
  std::string text;
  for (int j = 1; j <= n; ++j) {
    text += fmt::format("T0_{0} = 1\nT1_{0} = 2 x{0} - 1\n", j);
    for (int i = 2; i <= n; ++i)
      text += fmt::format("T{0}_{1} = 2 T1_{1} T{2}_{1} - T{3}_{1}\n", i, j, i - 1, i - 2);
  }
  return text +
         system_text(
             n,
             [n](int i) {
               const std::string sum = sum_of(1, n, [i](int j) { return fmt::format("T{}_{}", i, j); });
               return fmt::format("({})/{} + {}", sum, n, i % 2 == 0 ? fmt::format("1/{}", i * i - 1) : "0");
             },
             [n](int j) { return static_cast<double>(j) / (n + 1); });
}

/// The gradient of the sum of squares, as an energy.
std::string watson(int n) {
  std::string text = "energy = x1^2 + (x2 - x1^2 - 1)^2";
  for (int i = 1; i <= 29; ++i) {
    const std::string slope =
        sum_of(2, n, [i](int j) { return fmt::format("{}*x{}*({}/29)^{}", j - 1, j, i, j - 2); });
    const std::string value = sum_of(1, n, [i](int j) { return fmt::format("x{}*({}/29)^{}", j, i, j - 1); });
    text += fmt::format(" + ({} - ({})^2 - 1)^2", slope, value);
  }
  for (int j = 1; j <= n; ++j) text += fmt::format("\nx{}(0) = 0", j);
  return text;
}

}  // namespace

std::vector<TestSystem> test_systems() {
  const std::vector<double> ones(10, 1.);
  return {
      {"rosenbrock", "10 (y - x^2) = 0; 1 - x = 0; x(0) = -1.2; y(0) = 1", {{1, 1}}, true},
      {"freudenstein-roth",
       "-13 + x + ((5 - y) y - 2) y = 0; -29 + x + ((y + 1) y - 14) y = 0; x(0) = 0.5; y(0) = -2",
       {{5, 4}},
       true},
      // oracle: homotopy_systems powell-badly-scaled *
      {"powell-badly-scaled",
       "1e4 x y = 1; exp(-x) + exp(-y) = 1.0001; x(0) = 0; y(0) = 1",
       {{1.0981593296998175e-5, 9.1061467398665240}}},
      {"powell-singular",
       "x1 + 10 x2 = 0; sqrt(5) (x3 - x4) = 0; (x2 - 2 x3)^2 = 0; sqrt(10) (x1 - x4)^2 = 0; x1(0) = 3; x2(0) "
       "= -1; "
       "x3(0) = 0; x4(0) = 1",
       {{0, 0, 0, 0}},
       true},
      {"powell-1970", "x = 0; 10 x/(x + 0.1) + 2 y^2 = 0; x(0) = 3; y(0) = 1", {{0, 0}}, true},
      {"helical-valley",
       "10 (z - 10 atan2(y, x)/(2 pi)) = 0; 10 (sqrt(x^2 + y^2) - 1) = 0; z = 0; x(0) = -1; y(0) = 0; z(0) = "
       "0",
       {{0, 0, 1}},  // z, y, x
       true},
      {"wood",
       "energy = 100 (y - x^2)^2 + (1 - x)^2 + 90 (w - z^2)^2 + (1 - z)^2 + 10 (y + w - 2)^2 + (y - w)^2/10; "
       "x(0) = -3; y(0) = -1; z(0) = -3; w(0) = -1",
       {{1, 1, 1, 1}}},
      // oracle: homotopy_systems watson *
      {"watson", watson(6), {{-0.015725086401458457, 0.99299643243113452}}},
      // oracle: homotopy_systems chebyquad-7 *
      {"chebyquad-7", chebyquad(7), {{0.058069149620975482, 0.94193085037902452}}},
      {"chebyquad-8", chebyquad(8), {}, false, false},
      {"brown-almost-linear", brown_almost_linear(10), {ones}},
      // oracle: homotopy_systems discrete-boundary-value *
      {"discrete-boundary-value",
       discrete_boundary_value(10),
       {{-0.043164982518764871, -0.075416533685892084}}},
      // oracle: homotopy_systems discrete-integral-equation *
      {"discrete-integral-equation", discrete_integral(10), {{-0.043164982518764871, -0.075416533685892084}}},
      {"trigonometric", trigonometric(10), {std::vector<double>(10, 0.)}},
      {"variably-dimensioned", variably_dimensioned(10), {ones}, true},
      // oracle: homotopy_systems broyden-tridiagonal *
      {"broyden-tridiagonal", broyden_tridiagonal(10), {{-0.57072213201122479, -0.41641225752869335}}},
      // oracle: homotopy_systems broyden-banded *
      {"broyden-banded", broyden_banded(10), {{-0.42830286358725027, -0.58646927072043507}}},
      {"himmelblau", "x^2 + y = 11; x + y^2 = 7; x(0) = 0; y(0) = 0", {{3, 2}}},
      {"no-root", "x^2 + y^2 = -1e-6; x = y; x(0) = 3; y(0) = 1", {}, false, false}};
}

}  // namespace nlmech::chapters::homotopy
