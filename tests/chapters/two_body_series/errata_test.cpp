/// Misprints of section 3.2: printed and corrected form against an independent oracle.
#include <gtest/gtest.h>

#include <boost/math/special_functions/factorials.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "chapters/two_body_series/orbits/published_runs.hpp"
#include "chapters/two_body_series/series/raw_recursion.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::chapters::two_body_series::errata_test {
namespace {

using Real = ExtendedReal<50>;
constexpr double eps = std::numeric_limits<double>::epsilon();

Real length(const orbit::Vector3<Real>& v) { return sqrt(v.dot(v)); }

orbit::BasicState<Real> extended(const orbit::State& s) {
  return {s.position.cast<Real>(), s.velocity.cast<Real>()};
}

/// r^(n)(0)/n! of Kepler's motion from the polynomial through 31 points of the closed solution; Cauchy's
/// integral over a circle in the complex plane would need complex Stumpff functions. Truncation error: (15
/// d/rho)^(31 - n), d the distance of the points: below 1e-17 of r_0 for n <= 10.
std::vector<orbit::Vector3<Real>> coefficients_of_the_closed_solution(const Orbit& orbit, int order) {
  constexpr int count = 31;
  const Real d = period_of(orbit) / 4000;
  std::vector<Real> t;
  std::vector<orbit::Vector3<Real>> c;
  for (int i = 0; i < count; ++i) {
    t.emplace_back((i - count / 2) * d);
    c.push_back(orbit::kepler_state(extended(orbit.start), t.back(), Real(earth_mu)).position);
  }
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (int level = 1; level < count; ++level) {  // divided differences
    for (int i = count - 1; i >= level; --i)
      c[at(i)] = (c[at(i)] - c[at(i - 1)]) / Real(t[at(i)] - t[at(i - level)]);
  }
  std::vector<orbit::Vector3<Real>> p(count, orbit::Vector3<Real>::Zero());
  for (int i = count - 1; i >= 0; --i) {  // p <- p (t - t_i) + c_i
    for (int k = count - 1; k > 0; --k) p[at(k)] = p[at(k - 1)] - t[at(i)] * p[at(k)];
    p[0] = c[at(i)] - t[at(i)] * p[0];
  }
  p.resize(at(order) + 1);
  return p;
}

/// |r^(n)|/n! of the dissertation's recursion with Eq. 3.66 in this reading.
double size_of_term(const Orbit& orbit, Equation366 reading, int n) {
  const auto found = raw_derivatives<Real>(extended(orbit.start), Real(earth_mu), n, reading);
  return static_cast<double>(
      Real(length(found.back()) / boost::math::factorial<Real>(static_cast<unsigned>(n))));
}

/// Relative error of r^(n)/n! of the dissertation's recursion with Eq. 3.66 in this reading.
std::vector<double> errors_of_recursion(const Orbit& orbit, Equation366 reading, int order) {
  const auto exact = coefficients_of_the_closed_solution(orbit, order);
  const auto found = raw_derivatives<Real>(extended(orbit.start), Real(earth_mu), order, reading);
  std::vector<double> errors;
  Real factorial = 1;
  for (int n = 0; n <= order; ++n) {
    if (n > 1) factorial *= n;
    const auto i = static_cast<std::size_t>(n);
    errors.push_back(static_cast<double>(Real(length(found[i] / factorial - exact[i]) / length(exact[i]))));
  }
  return errors;
}

// Eq. 3.66 prints C(p, 2) instead of the number p/2, and lacks a bracket. Both states are at their periapsis,
// where f' = 0: the first error appears in g'', that is in the fourth coefficient (recorded: 20 %), the
// second where a binomial coefficient is not 1, in the sixth.
TEST(Errata, Equation3_66) {
  for (const Orbit& orbit : {low_orbit(), high_orbit()}) {
    const auto corrected = errors_of_recursion(orbit, Equation366::corrected, 10),
               bracketed = errors_of_recursion(orbit, Equation366::bracketed, 10),
               literal = errors_of_recursion(orbit, Equation366::literal, 10);
    for (std::size_t n = 0; n <= 10; ++n) EXPECT_LT(corrected[n], 1e-12) << orbit.name << " " << n;
    for (const auto& printed : {bracketed, literal}) {
      for (std::size_t n = 0; n <= 3; ++n) EXPECT_LT(printed[n], 1e-12) << orbit.name << " " << n;
      for (std::size_t n = 4; n <= 10; ++n) EXPECT_GT(printed[n], 0.01) << orbit.name << " " << n;
    }
    EXPECT_NEAR(bracketed[5], literal[5], 1e-12);
    const auto exact = coefficients_of_the_closed_solution(orbit, 6);
    for (const int n : {4, 6}) {
      tests::expect_erratum("two_body_series-3.66",
                            {.printed = size_of_term(orbit, Equation366::literal, n),
                             .corrected = size_of_term(orbit, Equation366::corrected, n),
                             .oracle = static_cast<double>(length(exact[static_cast<std::size_t>(n)])),
                             .tolerance = 1e-12});  // what the polynomial through 31 places leaves out
    }
    EXPECT_GT(std::abs(bracketed[6] - literal[6]), 1e-3);
  }
  EXPECT_NEAR(errors_of_recursion(low_orbit(), Equation366::literal, 4)[4], 0.2, 0.05);
}

/// Largest energy error over orbits in the dissertation's steps.
double greatest_error(const Orbit& orbit, int orbits, Equation366 reading) {
  orbit::State s = orbit.start;
  const double before = orbit::energy(s, earth_mu), step = period_of(orbit) / orbit.steps;
  double greatest = 0;
  for (int k = 0; k < orbits * orbit.steps; ++k) {
    s = raw_step(raw_derivatives<double>(s, earth_mu, orbit.order, reading), step);
    greatest = std::max(greatest, std::abs(orbit::energy(s, earth_mu) / before - 1));
  }
  return greatest;
}

// Hence the program behind the tables used p/2: with the misprint the error is a thousand times the printed
// one (recorded: 1.9e-3 over five orbits).
TEST(Errata, Equation3_66InOrbit) {
  EXPECT_NEAR(greatest_error(low_orbit(), 5, Equation366::bracketed), 1.9e-3, 0.05e-3);
  EXPECT_LT(greatest_error(low_orbit(), 5, Equation366::corrected), 1e-8);
}

// Derivatives and binomial coefficients in metres and seconds agree with the library's normalised
// coefficients: the same step up to rounding of the terms, the largest of which are r and h v.
TEST(Recursion, AsPrintedIsTheLibrarys) {
  for (const Orbit& orbit : {low_orbit(), high_orbit()}) {
    orbit::State s = orbit.start;
    const double step = period_of(orbit) / orbit.steps;
    for (int k = 0; k < orbit.steps; ++k) {
      const auto propagated = orbit::propagate(s, 0, step, orbit::Gravity{.mu = earth_mu},
                                               orbit::FixedContinuation{.step = step, .order = orbit.order});
      ASSERT_TRUE(propagated.status.ok());
      const orbit::State recursive = raw_step(raw_derivatives<double>(s, earth_mu, orbit.order), step);
      const double r = s.position.norm(), v = s.velocity.norm();
      EXPECT_LE((recursive.position - propagated.x.position).norm(), 8 * eps * (r + step * v))
          << orbit.name << k;
      EXPECT_LE((recursive.velocity - propagated.x.velocity).norm(),
                32 * eps * (v + step * earth_mu / (r * r)))
          << orbit.name << k;
      s = propagated.x;
    }
  }
}

// At order 30 in SI units no derivative is near the range of double: they decrease as n!/rho^n.
TEST(Recursion, RawDerivativesStayWithinDoubles) {
  const Orbit orbit = high_orbit();
  for (const double turns : {0.0, 0.01, 0.1, 0.5}) {
    const orbit::State s = orbit::propagate_kepler(orbit.start, turns * period_of(orbit), earth_mu).state;
    for (const auto& d : raw_derivatives<double>(s, earth_mu, 30)) {
      EXPECT_GT(d.norm(), 1e-100) << turns;
      EXPECT_LT(d.norm(), 1e8) << turns;
    }
  }
}

// "Combining Eq. (3.61), Eq. (3.66) and Eq. (3.68)": f itself (3.61) contains no derivatives; with f^(n) = f
// for n = 0 and 0 otherwise g is constant and the orbit a harmonic oscillation. 3.62 is needed.
TEST(Errata, Equation3_62IsMeantWhereTheTextSays3_61) {
  const Orbit orbit = low_orbit();
  const auto exact = coefficients_of_the_closed_solution(orbit, 4);
  const Real r = length(exact[0]), rate = Real(earth_mu) / (r * r * r);
  EXPECT_LT(length(-rate * exact[0] / 2 - exact[2]), Real(1e-12) * length(exact[2]));
  EXPECT_GT(length(rate * rate * exact[0] / 24 - exact[4]), Real(0.1) * length(exact[4]));
  tests::expect_erratum("two_body_series-3.61", {.printed = static_cast<double>(Real(rate * rate * r / 24)),
                                                 .corrected = size_of_term(orbit, Equation366::corrected, 4),
                                                 .oracle = static_cast<double>(length(exact[4])),
                                                 .tolerance = 1e-12});
}

/// g^(n + 1) by the corrected Eq. 3.66, from the derivatives of f and of the g on its right-hand side.
double next_derivative(double p, const std::vector<double>& f, const std::vector<double>& g) {
  const std::size_t n = g.size() - 1;
  double sum = p / 2 * f[1] * g[n], binomial = 1;
  for (std::size_t m = 1; m <= n; ++m) {
    binomial = binomial * static_cast<double>(n - m + 1) / static_cast<double>(m);
    sum += binomial * (p / 2 * f[m + 1] * g[n - m] + f[m] * g[n - m + 1]);
  }
  return -sum / f[0];
}

// The g of 3.66 and 3.68 has no index, although 3.63 has one for every p. For f = exp t all derivatives of f
// at 0 are 1, those of g_p are (-p/2)^n: p = 5 needs g_5 on the right-hand side of 3.66. 3.68 needs g_3: with
// g_5 the second derivative differs from that of the closed solution.
TEST(Errata, IndexOfG) {
  const auto powers = [](double p) { return std::vector{1.0, -p / 2, p * p / 4, -p * p * p / 8}; };
  tests::expect_erratum("two_body_series-3.66-index",
                        {.printed = next_derivative(5, std::vector(5, 1.0), powers(3)),
                         .corrected = next_derivative(5, std::vector(5, 1.0), powers(5)),
                         .oracle = std::pow(-2.5, 4),
                         .tolerance = 16 * eps});
  const Orbit orbit = low_orbit();
  const double r = orbit.start.position.norm();
  const auto exact = coefficients_of_the_closed_solution(orbit, 2);
  tests::expect_erratum("two_body_series-3.68", {.printed = earth_mu * std::pow(r, -5) * r,
                                                 .corrected = earth_mu * std::pow(r, -3) * r,
                                                 .oracle = static_cast<double>(Real(2 * length(exact[2]))),
                                                 .tolerance = 1e-12});
}

// The textbook form of Lagrange's F and G against Kepler's problem in 50 digits: eps times the amplification
// of twenty orbits (kappa).
TEST(TextbookForm, IsKeplersMotion) {
  for (const Orbit& orbit : {low_orbit(), high_orbit()}) {
    for (const double turns : {0.01, 0.3, 0.5, 1.0, 7.77, 20.0}) {
      const double t = turns * period_of(orbit);
      const auto exact = orbit::kepler_state(extended(orbit.start), Real(t), Real(earth_mu));
      const orbit::State s = textbook_f_and_g(orbit.start, t, earth_mu);
      const double kappa = orbit::kepler_condition(orbit.start, t, earth_mu).position;
      EXPECT_LE(static_cast<double>(
                    Real(length(s.position.cast<Real>() - exact.position) / length(exact.position))),
                16 * eps * kappa)
          << orbit.name << " " << turns;
    }
  }
}

// 2-norms, not root mean squares: over twice the orbits a linearly growing error has 2^1.5 times the norm.
TEST(Norm, IsTheRootOfTheSum) {
  EXPECT_EQ(norm_of({3, 4}), 5);
  EXPECT_EQ(norm_of({}), 0);
}

}  // namespace
}  // namespace nlmech::chapters::two_body_series::errata_test
