/// Statements of the paper about its examples, against the classical Runge-Kutta method. Its misprinted
/// formulas are tested in tests/program.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "chapters/algebraic_series/sections.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/program/runge_kutta.hpp"

namespace nlmech::chapters::algebraic_series::errata_test {
namespace {

using tests::expect_erratum;
using tests::runge_kutta;

// "Without any approximation or truncation in each time step": with the printed T = 0.1 and N = 20 v has a
// relative error of a tenth after five steps, u and w of a thousandth.
TEST(Claims, TwentyTermsOfTheLorenzSystemAreATruncation) {
  const ivp::System system{problems::TextProblem("lorenz")};
  const ivp::State x0 = problems::TextProblem("lorenz").initial_state();
  const auto field = [](double, const std::array<double, 3>& x) {
    return std::array{10 * (x[1] - x[0]), 28 * x[0] - x[1] - x[0] * x[2], x[0] * x[1] - 8.0 / 3 * x[2]};
  };
  const auto reference = runge_kutta(field, std::array{0.0, 1.0, 0.0}, 0, 0.5, 20'000);
  const auto printed = ivp::integrate(system, x0, 0, 0.5, published_series(0.1, 20));
  const auto corrected = ivp::integrate(system, x0, 0, 0.5, accurate_series());
  ASSERT_TRUE(printed.status.ok() && corrected.status.ok());
  for (Eigen::Index i = 0; i < 3; ++i) {
    // (0.5/20000)^4 times derivatives of about 1e8, and 20000 rounding errors that grow a hundredfold.
    expect_erratum("algebraic_series-truncation", {.printed = printed.x[i],
                                                   .corrected = corrected.x[i],
                                                   .oracle = reference[static_cast<std::size_t>(i)],
                                                   .tolerance = 1e-9});
  }
}

// "The partial segments arise from the transient behavior": after it every 31st section would be equal. The
// sections move around an island, 31 sections by 0.0778 of a full angle; here from one side to the other,
// after the 750 s of the paper.
TEST(Claims, SectionsDoNotSettle) {
  constexpr int first = 310, last = first + 6 * 31;
  const problems::TextProblem problem("oscillator");
  const auto all = sections(ivp::System(problem), problem.initial_state(), problem.initial_time, last + 1);
  const auto field = [](double t, const std::array<double, 2>& x) {
    return std::array{x[1], -0.306 * x[0] - 5 * x[1] * x[0] * x[0] * std::sin(2 * t)};
  };
  const auto section = [&](int k) {
    const double t0 = std::numbers::pi;
    return runge_kutta(field, std::array{-0.5, 0.0}, t0, t0 * (k + 1), 800 * k);
  };
  const auto a = section(first), b = section(last);
  // Steps of pi/800 have errors of 1e-10 each period, 1e-8 of the positions in total: 1e-4 of the distance.
  expect_erratum("algebraic_series-4.5", {.printed = 0,
                                          .corrected = (all.at(last) - all.at(first)).norm(),
                                          .oracle = std::hypot(b[0] - a[0], b[1] - a[1]),
                                          .tolerance = 1e-3});
}

}  // namespace
}  // namespace nlmech::chapters::algebraic_series::errata_test
