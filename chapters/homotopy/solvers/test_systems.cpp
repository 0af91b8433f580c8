#include "chapters/homotopy/solvers/test_systems.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace nlmech::chapters::homotopy {
namespace {

/// The text for i from @p first to @p last: {i}, {b} the number before it, {a} the one after it; "0" for
/// none.
std::string each(int first, int last, const std::string& text, std::string_view between = "") {
  std::vector<std::string> all;
  for (int i = first; i <= last; ++i)
    all.push_back(
        fmt::format(fmt::runtime(text), fmt::arg("i", i), fmt::arg("b", i - 1), fmt::arg("a", i + 1)));
  return all.empty() ? "0" : fmt::format("{}", fmt::join(all, between));
}

constexpr const char* ends = "x0 = 0; x11 = 0\n";  // beyond the unknowns

std::string discrete_integral() {
  std::string text = each(1, 10, "c{i} = (x{i} + {i}/11 + 1)^3\n");
  for (int i = 1; i <= 10; ++i)
    text += fmt::format("x{0} + ((11 - {0})/11*({1}) + {0}/11*({2}))/22 = 0\n", i,
                        each(1, i, "{i}/11*c{i}", " + "), each(i + 1, 10, "(11 - {i})/11*c{i}", " + "));
  return text;
}

std::string broyden_banded() {
  std::string text = ends + each(1, 11, "p{i} = x{i} (1 + x{i})\n") + each(1, 10, "x{i}(0) = -1\n");
  for (int i = 1; i <= 10; ++i)
    text += fmt::format("x{0} (2 + 5 x{0}^2) + 1 - ({1} + p{2}) = 0\n", i,
                        each(std::max(1, i - 5), i - 1, "p{i}", " + "), i + 1);
  return text;
}

/// Chebyshev's polynomials of 2 x - 1 by their recurrence: Ti_j is T_i at unknown j.
std::string chebyquad(int n) {
  std::string text =
      each(1, n, fmt::format("T0_{{i}} = 1; T1_{{i}} = 2 x{{i}} - 1; x{{i}}(0) = {{i}}/{}\n", n + 1));
  for (int i = 1; i <= n; ++i) {
    if (i > 1)
      text += each(1, n, fmt::format("T{}_{{i}} = 2 T1_{{i}} T{}_{{i}} - T{}_{{i}}\n", i, i - 1, i - 2));
    text += fmt::format("({})/{} + {} = 0\n", each(1, n, fmt::format("T{}_{{i}}", i), " + "), n,
                        i % 2 == 0 ? fmt::format("1/{}", i * i - 1) : "0");
  }
  return text;
}

/// The gradient of the sum of squares, as an energy.
std::string watson() {
  std::string text = "energy = x1^2 + (x2 - x1^2 - 1)^2";
  for (int k = 1; k <= 29; ++k)
    text +=
        fmt::format(" + ({} - ({})^2 - 1)^2", each(1, 5, fmt::format("{{i}}*x{{a}}*({}/29)^{{b}}", k), " + "),
                    each(1, 6, fmt::format("x{{i}}*({}/29)^{{b}}", k), " + "));
  return text + each(1, 6, "\nx{i}(0) = 0");
}

}  // namespace

std::vector<TestSystem> test_systems() {
  const std::vector<double> ones(10, 1.);
  const std::string parabola = each(1, 10, "x{i}(0) = {i}/11*({i}/11 - 1)\n");
  const std::string sum = each(1, 10, "x{i}", " + "), cosines = each(1, 10, "cos(x{i})", " + ");
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
      {"watson", watson(), {{-0.015725086401458457, 0.99299643243113452}}},
      // oracle: homotopy_systems chebyquad-7 *
      {"chebyquad-7", chebyquad(7), {{0.058069149620975482, 0.94193085037902452}}},
      {"chebyquad-8", chebyquad(8), {}, false, false},
      {"brown-almost-linear",
       each(1, 9, "x{i} + " + sum + " - 11 = 0\n") + each(1, 10, "x{i}", "*") + " - 1 = 0" +
           each(1, 10, "\nx{i}(0) = 0.5"),
       {ones}},
      // oracle: homotopy_systems discrete-boundary-value *
      {"discrete-boundary-value",
       ends + parabola + each(1, 10, "2 x{i} - x{b} - x{a} + (x{i} + {i}/11 + 1)^3/242 = 0\n"),
       {{-0.043164982518764871, -0.075416533685892084}}},
      // oracle: homotopy_systems discrete-integral-equation *
      {"discrete-integral-equation",
       discrete_integral() + parabola,
       {{-0.043164982518764871, -0.075416533685892084}}},
      {"trigonometric",
       each(1, 10, "10 - (" + cosines + ") + {i} (1 - cos(x{i})) - sin(x{i}) = 0; x{i}(0) = 0.1\n"),
       {std::vector<double>(10, 0.)}},
      {"variably-dimensioned",
       "s = " + each(1, 10, "{i} (x{i} - 1)", " + ") +
           each(1, 10, "\nx{i} - 1 + {i} s (1 + 2 s^2) = 0; x{i}(0) = 1 - {i}/10"),
       {ones},
       true},
      // oracle: homotopy_systems broyden-tridiagonal *
      {"broyden-tridiagonal",
       ends + each(1, 10, "(3 - 2 x{i}) x{i} - x{b} - 2*x{a} + 1 = 0; x{i}(0) = -1\n"),
       {{-0.57072213201122479, -0.41641225752869335}}},
      // oracle: homotopy_systems broyden-banded *
      {"broyden-banded", broyden_banded(), {{-0.42830286358725027, -0.58646927072043507}}},
      {"himmelblau", "x^2 + y = 11; x + y^2 = 7; x(0) = 0; y(0) = 0", {{3, 2}}},
      {"no-root", "x^2 + y^2 = -1e-6; x = y; x(0) = 3; y(0) = 1", {}, false, false}};
}

}  // namespace nlmech::chapters::homotopy
