/// Multi-step transversal linearisation on linear problems: exact for every step.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/ivp/methods.hpp"

namespace nlmech::ivp::mtl_linear_test {
namespace {

using problems::TextProblem;
using testing::eps;

/// State of the linear oscillator by its closed form, underdamped, away from undamped resonance.
State exact(const TextProblem& p, const State& x0, double t) {
  using Complex = std::complex<long double>;
  const long double w = p.parameter("natural_frequency"), zeta = p.parameter("damping_ratio"),
                    wf = p.parameter("frequency");
  const Complex i(0, 1);
  // Steady state: the real part of c exp(i W t).
  const Complex c =
      static_cast<long double>(p.parameter("force")) / Complex(w * w - wf * wf, 2 * zeta * w * wf);
  const Complex root(-zeta * w, w * std::sqrt(1 - zeta * zeta));
  const long double x = x0[0] - c.real(), v = x0[1] - (i * wf * c).real();
  // Transient: the real part of d exp(root t).
  const Complex d(x, (root.real() * x - v) / root.imag());
  const Complex free = d * std::exp(root * static_cast<long double>(t));
  const Complex forced = c * std::exp(i * wf * static_cast<long double>(t));
  return {static_cast<double>((free + forced).real()),
          static_cast<double>((root * free + i * wf * forced).real())};
}

// Exact for every step size up to rounding errors: a block of p steps makes some 10 (1 + w h) eps, relative
// to the scale (1, w) of the state, and without damping they add up over the blocks.
TEST(Mtl, LinearProblemsAreExact) {
  const State x0{1, 0.5};
  for (const double w : {1e-3, 1., 30., 1e3}) {
    for (const double zeta : {0., 0.05, 0.7}) {
      for (const double h : {0.001, 0.1, 1.7}) {
        for (const int p : {1, 2, 3, 5, 8}) {
          const TextProblem problem("linear", {{"natural_frequency", w},
                                               {"damping_ratio", zeta},
                                               {"force", 2 * w * w},
                                               {"frequency", 0.3 * w + 0.1}});
          const double end = 7 * h * p;
          const auto s = integrate(System(problem), x0, 0, end, Mtl{.step = h, .points = p});
          ASSERT_TRUE(s.status.ok()) << s.status.text();
          const State reference = exact(problem, x0, end);
          const double bound = 7 * p * 20 * eps * (1 + w * h) * (4 + 4 / w);
          EXPECT_NEAR(s.x[0], reference[0], bound) << w << " " << zeta << " " << h << " " << p;
          EXPECT_NEAR(s.x[1], reference[1], bound * (1 + w)) << w << " " << zeta << " " << h << " " << p;
        }
      }
    }
  }
}

// At resonance the particular solution grows with time; a formula with the denominator w^2 - W^2 fails.
TEST(Mtl, ResonanceIsExact) {
  const TextProblem problem("linear", {{"force", 1}, {"frequency", 1}});
  const auto s = integrate(System(problem), State{0, 0}, 0, 30, Mtl{.step = 0.5, .points = 3});
  EXPECT_NEAR(s.x[0], 15 * std::sin(30.), 2e3 * eps);
  EXPECT_NEAR(s.x[1], (std::sin(30.) + 30 * std::cos(30.)) / 2, 2e3 * eps);
}

// Dense output resolves an oscillation with many periods in one block.
TEST(Mtl, DenseOutputOfAFastOscillation) {
  const TextProblem problem("linear", {{"natural_frequency", 100}});
  double worst = 0;
  State x(2);
  const auto observe = [&](const Step& step) {
    for (int i = 1; i < 20; ++i) {
      const double t = step.t0 + (step.t1 - step.t0) * i / 20;
      step.dense.at(t, x);
      worst = std::max(worst, std::abs(x[0] - std::cos(100 * t)));
    }
    return true;
  };
  static_cast<void>(integrate(System(problem), State{1, 0}, 0, 6, Mtl{.step = 0.5, .points = 3}, observe));
  EXPECT_LE(worst, 20 * 600 * eps);  // 600 rad, each with a rounding error
}

}  // namespace
}  // namespace nlmech::ivp::mtl_linear_test
