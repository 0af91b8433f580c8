/// The programs of examples/ against what is known without the library's own solvers.
#include <gtest/gtest.h>

#include <cmath>

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/pages/page.hpp"
#include "tests/places.hpp"

namespace nlmech::tests::examples_test {
namespace {

std::string output_of(const std::string& program) {
  const scene::Finished run = scene::run_program({NLMECH_BINARY_DIR "/bin/" + program}, {});
  EXPECT_EQ(run.exit_code, 0) << program << run.errors;
  return run.output;
}

/// The pendulum returns after the period that elliptic integrals give. Single steps are held to 1e-8, and the
/// end of a period collects some: 1e-5 is what Newmark's operators, of order 2, leave with their estimate of
/// a step. A thousand equal steps leave h^2 by order 2, that is 7e-5, and h = 8e-3, times ten or so, by order
/// 1 and by radial functions, which do not contain the linear ones.
TEST(Examples, EveryIntegratorBringsThePendulumBack) {
  const auto lines = lines_in(output_of("every_integrator"));
  EXPECT_EQ(lines.size(), ivp::named_methods().size());
  for (const std::string& line : lines) {
    EXPECT_TRUE(line.ends_with(", success")) << line;
    const std::string name = line.substr(0, line.find(' '));
    const auto place = line.find("error ");
    ASSERT_NE(place, std::string::npos) << line;
    const double error = std::stod(line.substr(place + 6));
    const bool coarse = name == "euler" || name == "backward-euler" || name == "rbf-coll";
    const double equal = coarse ? 0.1 : 7e-5;
    EXPECT_LT(error, ivp::method_info(name).fixed_step() ? equal : 1e-5) << line;
  }
}

/// Another method comes to the printed ends. An error grows by some e^9 to t = 10, and tolerances of 1e-12 by
/// that to 1e-8.
TEST(Examples, ManyStartsEndWhereAnotherMethodEnds) {
  using namespace ivp;
  const System lorenz(problems::TextProblem("lorenz"));
  const std::vector<State> starts = {{0, 1, 0}, {0, 1.0001, 0}, {1, 1, 1}, {-1, 2, 20}};
  const auto lines = lines_in(output_of("many_starts"));
  ASSERT_EQ(lines.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto end = named_integrator("dop853", {.tolerance = 1e-13})(lorenz, starts[i], 0, 10, {}, {});
    ASSERT_TRUE(end.status.ok()) << end.status.text();
    const Read printed = read(lines[i]);
    ASSERT_EQ(printed.numbers.size(), 3U) << lines[i];
    for (Eigen::Index k = 0; k < 3; ++k)
      EXPECT_NEAR(printed.numbers[static_cast<std::size_t>(k)], end.x[k], 2e-6) << lines[i];
  }
}

/// Every printed velocity, integrated as an equation of motion, arrives. Velocities are printed to 5e-7 m/s,
/// which is at most a few mm after 4320 s: the growth of an error over less than a revolution or two is some
/// ten times t.
TEST(Examples, LambertsArcsArrive) {
  using namespace ivp;
  const System motion(problems::TextProblem("two-body"));
  const auto lines = lines_in(output_of("lambert"));
  EXPECT_EQ(lines.size(), 4U);
  for (const std::string& line : lines) {
    State x(6);
    x << 2.87e6, 5.19e6, 2.85e6, 0, 0, 0;
    const auto equals = line.find("v = ");
    ASSERT_NE(equals, std::string::npos) << line;
    const Read v = read(line.substr(equals + 4));
    for (std::size_t i = 0; i < 3; ++i) x[static_cast<Eigen::Index>(3 + i)] = v.numbers.at(i);
    const auto end =
        integrate(motion, x, 0, 4320, Rkn1210{.relative_tolerance = 1e-13, .absolute_tolerance = 1e-13});
    EXPECT_TRUE(end.status.ok()) << end.status.text();
    const double miss = (end.x.head<3>() - Vector<double, 3>(2.09e6, 7.82e6, 0)).norm();
    EXPECT_LT(miss, 10 * 5e-7 * 4320) << line;
  }
}

/// No transfer between circles is cheaper than Hohmann's. Steps of a hundredth of a year are 0.03 rad of the
/// synodic angle at most, and the sum is flat at its minimum: one part in a hundred.
TEST(Examples, PorkchopFindsHohmannsTransfer) {
  const Read found = read(output_of("porkchop"));
  ASSERT_EQ(found.numbers.size(), 3U);
  const double outer = 1.5, axis = (1 + outer) / 2;
  const double hohmann = std::sqrt(2 - 1 / axis) - 1 + std::sqrt(1 / outer) - std::sqrt(2 / outer - 1 / axis);
  EXPECT_GE(found.numbers[2], hohmann - 1e-6);
  EXPECT_LE(found.numbers[2], 1.01 * hohmann);
  EXPECT_NEAR(found.numbers[1] - found.numbers[0], std::sqrt(axis * axis * axis) / 2, 0.05);
}

}  // namespace
}  // namespace nlmech::tests::examples_test
