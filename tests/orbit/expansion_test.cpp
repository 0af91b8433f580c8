/// The recursion of analytic continuation against derivatives of Kepler's motion that it does not know, and
/// the misprints of Eqs 3.66 and 3.68.
#include "nlmech/orbit/expansion.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "nlmech/orbit/convergence.hpp"
#include "nlmech/orbit/extended.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::expansion_test {
namespace {

using namespace oracle;

/// Taylor coefficients of Kepler's motion up to the tenth: Newton's interpolation at 31 times about 0, in 50
/// digits. What is left out is below (0.3/rho)^20 for the orbits here, rounding below 1e-50 0.02^-10.
std::vector<Vector3<Real>> coefficients_of_kepler(const State& s, double mu, double spacing) {
  constexpr int count = 31, wanted = 11;
  std::vector<Real> t;
  std::vector<Vector3<Real>> d;
  constexpr int middle = count / 2;
  for (int i = 0; i < count; ++i) {
    t.emplace_back((i - middle) * spacing);
    d.push_back(kepler(s, (i - middle) * spacing, mu).position);
  }
  for (int level = 1; level < count; ++level) {
    for (int i = count - 1; i >= level; --i) {
      const auto k = static_cast<std::size_t>(i);
      d[k] = (d[k] - d[k - 1]) / Real(t[k] - t[k - static_cast<std::size_t>(level)]);
    }
  }
  std::vector<Vector3<Real>> p(count, Vector3<Real>::Zero());
  for (std::size_t i = count; i-- > 0;) {
    // p <- p (x - t_i) + d_i
    for (std::size_t k = count - 1; k > 0; --k) p[k] = p[k - 1] - t[i] * p[k];
    p[0] = d[i] - t[i] * p[0];
  }
  p.resize(wanted);
  return p;
}

TEST(Expansion, IsTheTaylorSeriesOfKeplersMotion) {
  const State states[] = {propagate_kepler(at_periapsis(0.1), 1, 1).state,
                          {{1, 0.5, -0.2}, {-0.3, 0.9, 0.5}},
                          {{1, 0, 0.3}, {0.2, 1.9, 0}},
                          {{1, 2, 2}, {0, 0, 0}}};
  for (const State& s : states) {
    const auto exact = coefficients_of_kepler(s, 1, 0.0078125);
    Expansion<Real> series({}, 10);
    series.expand(as<Real>(s), 10);
    for (int k = 0; k <= 10; ++k) {
      const Vector3<Real> d = series.coefficient(k) - exact[static_cast<std::size_t>(k)];
      EXPECT_LT(Real(length(d)), Real(1e-18) * pow(Real(4), k)) << k;  // (0.12/rho)^31 4^k
    }
  }
}

// In derivatives, as printed: g^(n+1) by Eq. 3.66 with the "binomial coefficient" taken for p/2 or for C(p,
// 2) = 3.
std::vector<Vector3<Real>> by_equation_366(const State& start, const Real& p_half, int orders) {
  const auto s = as<Real>(start);
  std::vector<Vector3<Real>> r = {s.position, s.velocity};
  std::vector<Real> f, g;
  const auto binomial = [](int n, int m) {
    Real b = 1;
    for (int i = 1; i <= m; ++i) b = b * (n - m + i) / i;
    return b;
  };
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (int n = 0; n + 2 <= orders; ++n) {
    Real sum = 0;
    for (int m = 0; m <= n; ++m) sum += binomial(n, m) * r[at(m)].dot(r[at(n - m)]);
    f.push_back(sum);
    if (n == 0) {
      g.push_back(pow(f[0], Real(-1.5)));
    } else {
      const int k = n - 1;  // g^(k+1)
      Real inner = p_half * f[1] * g[at(k)];
      for (int m = 1; m <= k; ++m) {
        inner += binomial(k, m) * (p_half * f[at(m + 1)] * g[at(k - m)] + f[at(m)] * g[at(k - m + 1)]);
      }
      g.push_back(-inner / f[0]);
    }
    Vector3<Real> a = Vector3<Real>::Zero();
    for (int m = 0; m <= n; ++m) a -= binomial(n, m) * g[at(n - m)] * r[at(m)];
    r.push_back(a);
  }
  Real factorial = 1;
  for (int k = 0; k <= orders; ++k) {
    if (k > 1) factorial *= k;
    r[at(k)] /= factorial;
  }
  return r;
}

// Read as the number p/2 = 3/2 the equation gives the derivatives of Kepler's motion; read as the binomial
// coefficient C(3, 2) = 3 that is printed, it goes wrong from the first derivative of g: r^(3) on, unless f'
// = 0.
TEST(Errata, Equation366) {
  const State s = {{1, 0.5, -0.2}, {-0.3, 0.9, 0.5}};
  const auto exact = coefficients_of_kepler(s, 1, 0.0078125);
  const auto corrected = by_equation_366(s, Real(1.5), 10), printed = by_equation_366(s, Real(3), 10);
  for (std::size_t k = 0; k <= 10; ++k) {
    const Vector3<Real> d = corrected[k] - exact[k];
    EXPECT_LT(Real(length(d)), Real(1e-18) * pow(Real(4), static_cast<int>(k))) << k;
  }
  const Vector3<Real> wrong = printed[3] - exact[3];
  EXPECT_GT(Real(length(wrong) / length(exact[3])), Real(0.1));
  // At a periapsis f' = 0 and the misprint shows first in the fourth coefficient: a fifth of it.
  const State low = {{1 - 0.1, 0, 0}, {0, std::sqrt(1.1 / 0.9), 0}};
  const auto at_rest = by_equation_366(low, Real(3), 4), right = by_equation_366(low, Real(1.5), 4);
  EXPECT_LT(length(Vector3<Real>(at_rest[3] - right[3])), Real(1e-45));
  EXPECT_GT(Real(length(Vector3<Real>(at_rest[4] - right[4])) / length(right[4])), Real(0.15));
}

// Equation 3.68 prints g for g_3. With another p of the family of Eq. 3.63, say 5 (the first of gravity's
// higher terms), r'' = -mu g_5 r is another force, already in the second coefficient.
TEST(Errata, Equation368NeedsTheThirdPower) {
  const State s = {{1, 0.5, -0.2}, {-0.3, 0.9, 0.5}};
  const auto exact = coefficients_of_kepler(s, 1, 0.0078125);
  const auto r = as<Real>(s).position;
  const Real f = r.dot(r);
  const auto second = [&](const Real& p) { return Vector3<Real>(-pow(f, Real(-p / 2)) * r / 2); };
  EXPECT_LT(length(Vector3<Real>(second(3) - exact[2])), Real(1e-17));
  EXPECT_GT(length(Vector3<Real>(second(5) - exact[2])), Real(0.05));
}

// |r_k| ~ rho^-k k^(-5/3): the singularity is a branch point (t - t*)^(2/3). The ratio of coefficients far
// out shows the radius that convergence.hpp computes from closed forms.
TEST(Expansion, CoefficientsDecayWithTheRadiusOfConvergence) {
  const State s = propagate_kepler(at_periapsis(0.7), 0.4, 1).state;
  const int order = 240;
  Expansion<Real> series({}, order);
  series.expand(as<Real>(s), order);
  // A pair of complex singularities lets single coefficients oscillate: the largest of a dozen does not.
  const auto largest = [&](int from) {
    Real most = 0;
    for (int k = from; k < from + 12; ++k)
      most = std::max(most, Real(length(series.coefficient(k)) * pow(Real(k), Real(5) / 3) *
                                 pow(Real(convergence_radius(s, 1)), k)));
    return static_cast<double>(most);
  };
  // If rho were wrong by 1 %, a hundred orders would change this by a factor e.
  EXPECT_NEAR(largest(220) / largest(110), 1, 0.2);
}

/// Error of one revolution in fixed steps of @p order in 50 digits.
Real error_of_order(int order, int velocity_degree, int steps) {
  const State start = at_periapsis(0.3);
  BasicState<Real> s = as<Real>(start);
  Expansion<Real> series({}, std::max(order, velocity_degree + 1));
  for (int i = 0; i < steps; ++i) {
    series.expand(s, std::max(order, velocity_degree + 1));
    const auto change = series.increments(Real(3.5) / steps, order, velocity_degree);
    s.position += change.position;
    s.velocity += change.velocity;
  }
  return length(Vector3<Real>(s.position - kepler(start, 3.5, 1).position));
}

// Degrees (K, K - 1) are of order K - 1, (K, K) of order K: the lower degree decides.
TEST(Expansion, OrderOfConvergenceIsTheLowerDegree) {
  const auto order = [](int k, int velocity, int steps) {
    return std::log2(static_cast<double>(
        Real(error_of_order(k, velocity, steps) / error_of_order(k, velocity, 2 * steps))));
  };
  EXPECT_NEAR(order(4, 3, 600), 3, 0.1);
  EXPECT_NEAR(order(4, 4, 600), 4, 0.1);
  EXPECT_NEAR(order(10, 9, 400), 9, 0.3);
  EXPECT_NEAR(order(10, 10, 400), 10, 0.3);
  EXPECT_NEAR(order(12, 11, 400), 11, 0.3);
}

TEST(Expansion, ContinuesInExtendedPrecision) {
  const State s = at_periapsis(0.5);
  for (const double t : {-9., 30.}) {
    const auto end = continue_analytically<Real>(as<Real>(s), Real(t), {}, 40, Real(1e-40));
    EXPECT_LT(length(Vector3<Real>(end.position - kepler(s, t, 1).position)), Real(1e-36)) << t;
  }
}

}  // namespace
}  // namespace nlmech::orbit::expansion_test
