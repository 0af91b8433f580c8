// adaptive-collocation on stiff problems with known solutions: every success is accurate to 30 tolerances,
// one and a half digits, times the condition number.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::ivp::ivp_stiff_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using randomised::Case;
using randomised::Draw;
using randomised::randomised_test;

constexpr double digits_and_a_half = 30;
constexpr double eps = 2.220446049250313e-16;

/// x' = A (x - g(t)) + g'(t), g_i = a_i sin(w_i t + p_i) + b_i, with the solutions g + exp(A t) (x0 - g(0)).
/// A consists of blocks (re, im; -im, re) in the coordinates V. The size is dynamic, so that it is compiled
/// once.
struct Forced {
  MatrixXd a = {}, v = {}, inverse = {};
  VectorXd real;       // real parts of the eigenvalues; pairs are adjacent
  VectorXd imaginary;  // imaginary part at the first of a pair; 0: none
  VectorXd amplitude, frequency, phase, mean;

  [[nodiscard]] VectorXd slope(double t, const VectorXd& x) const {
    return a * (x - forced(t)) +
           (amplitude.array() * frequency.array() * (frequency.array() * t + phase.array()).cos()).matrix();
  }
  [[nodiscard]] VectorXd forced(double t) const {
    return (mean.array() + amplitude.array() * (frequency.array() * t + phase.array()).sin()).matrix();
  }
  [[nodiscard]] VectorXd exact(double t, const VectorXd& x0) const {
    VectorXd c = inverse * (x0 - forced(0));
    for (Index i = 0; i < c.size(); ++i) {
      const double decay = std::exp(real[i] * t);
      if (imaginary[i] == 0) {
        c[i] *= decay;
        continue;
      }
      const double cosine = decay * std::cos(imaginary[i] * t), sine = decay * std::sin(imaginary[i] * t);
      const double first = c[i], second = c[i + 1];
      c[i] = cosine * first + sine * second;
      c[i + 1] = cosine * second - sine * first;
      ++i;
    }
    return forced(t) + v * c;
  }
};

/// The same problem for double only, with its Jacobian: compiles quickly.
struct ForcedProblem {
  static constexpr int dimension = Eigen::Dynamic;
  const Forced* p;  // must outlive this object

  [[nodiscard]] int size() const { return static_cast<int>(p->a.rows()); }
  void operator()(double t, const VectorXd& x, VectorXd& f) const { f = p->slope(t, x); }
  void jacobian(double /*t*/, const VectorXd& /*x*/, MatrixXd& j) const { j = p->a; }
};

struct End {
  Status status;
  VectorXd x;
};
End end_of(const Forced& p, const VectorXd& x0, double end, const AdaptiveCollocation& method) {
  const auto s = integrate(System(ForcedProblem{&p}), State(x0), 0, end, method, {}, {.steps = 20'000});
  return {s.status, s.x};
}

Forced draw_forced(Draw& draw, Index n) {
  const VectorXd none = VectorXd::Zero(n);
  Forced p{
      .real = none, .imaginary = none, .amplitude = none, .frequency = none, .phase = none, .mean = none};
  MatrixXd blocks = MatrixXd::Zero(n, n), random(n, n);
  for (Index i = 0; i < n; ++i) {
    const bool is_pair = i + 1 < n && draw.chance(0.3);
    const double rate = draw.chance(0.15) ? 0 : draw.log_uniform(1e-3, 1e9);
    p.real[i] = blocks(i, i) = -rate;
    if (!is_pair) continue;
    // From overdamped to weakly damped; a weakly damped frequency reaches at most a few thousand rad.
    p.imaginary[i] = rate > 100 ? rate * draw.log_uniform(0.01, 3) : draw.log_uniform(0.1, 300);
    p.real[i + 1] = blocks(i + 1, i + 1) = -rate;
    blocks(i, i + 1) = p.imaginary[i];
    blocks(i + 1, i) = -p.imaginary[i];
    ++i;
  }
  for (double& entry : random.reshaped()) entry = draw.normal();
  // Rotated, and sheared by at most 2: a condition number of some tens.
  p.v = Eigen::HouseholderQR<MatrixXd>(random).householderQ();
  for (Index i = 0; i + 1 < n; ++i) p.v.col(i + 1) += draw.uniform(-2, 2) * p.v.col(i);
  p.inverse = p.v.inverse();
  p.a = p.v * blocks * p.inverse;
  for (Index i = 0; i < n; ++i) {
    p.amplitude[i] = draw.chance(0.3) ? 0 : draw.log_uniform(1e-3, 10);
    p.frequency[i] = draw.log_uniform(0.01, 20);
    p.phase[i] = draw.uniform(0, 6.28);
    p.mean[i] = draw.chance(0.5) ? 0 : draw.signed_log(1e-3, 10);
  }
  return p;
}

/// Number of periods of all weakly damped and driven motions: each may add an error of a tolerance.
double turns(const Forced& p, double end) {
  double angle = (p.frequency.array() * (p.amplitude.array() > 0).cast<double>()).sum() * end;
  for (Index i = 0; i < p.real.size(); ++i) {
    const double life = std::min(end, 5 / std::max(-p.real[i], 1e-300));
    angle += std::abs(p.imaginary[i]) * life;
  }
  return angle / (2 * std::numbers::pi);
}

Case forced_case(Draw& draw, Index n) {
  const Forced p = draw_forced(draw, n);
  const double end = draw.log_uniform(1e-2, 30), tolerance = draw.log_uniform(1e-12, 1e-2);
  const double absolute = draw.chance(0.5) ? tolerance : tolerance * draw.log_uniform(1e-3, 1);
  // A start on the smooth solution, or away from it, with a transient.
  VectorXd x0 = p.forced(0);
  if (draw.chance(0.7)) {
    for (double& x : x0) x += draw.signed_log(1e-8, 10);
  }
  const End s = end_of(p, x0, end, {.relative_tolerance = tolerance, .absolute_tolerance = absolute});
  if (!s.status.ok()) return Case::refused(s.status.text());
  const VectorXd exact = p.exact(end, x0);
  double size = x0.cwiseAbs().maxCoeff() + (p.mean.cwiseAbs() + p.amplitude.cwiseAbs()).maxCoeff();
  const double condition =
      p.v.cwiseAbs().rowwise().sum().maxCoeff() * p.inverse.cwiseAbs().rowwise().sum().maxCoeff();
  const double of_a_step = absolute + (tolerance + 100 * eps) * size;
  const double bound = digits_and_a_half * of_a_step * condition * (1 + turns(p, end));
  // A is rounded: the errors of slow eigenvalues are relative to the fast ones.
  const double blur =
      eps * p.real.cwiseAbs().maxCoeff() * end * condition * (x0 - p.forced(0)).cwiseAbs().maxCoeff();
  const auto what =
      fmt::format("n = {}, rates {} {}, end {:.17g}, tolerance {:.17g}, absolute {:.17g}", n,
                  fmt::join(p.real, " "), fmt::join(p.imaginary, " "), end, tolerance, absolute);
  if (blur > 0.1 * bound) return Case::undecided(what);
  return Case::judged((s.x - exact).cwiseAbs().maxCoeff(), bound, what);
}

TEST(RandomisedStiff, LinearSystemsOfAnySpectrum) {
  randomised_test({.quick = 150, .full = 40'000}, [](Draw& draw) {
    constexpr Index sizes[] = {2, 3, 6};
    return forced_case(draw, sizes[draw.whole(0, 2)]);
  });
}

/// y' = -rate (y - g) (1 + c (y - g)^2) + g', g = 1/(1 + t) + sin(w t) (A. Prothero and A. Robinson, Math.
/// Comp. 28 (1974) 145-162, with a nonlinear term): y = g from y(0) = g(0).
struct Manifold {
  static constexpr int dimension = 1;
  double rate, bend, frequency;
  template <class T>
  void operator()(const T& t, const Vector<T, 1>& y, Vector<T, 1>& f) const {
    using std::cos;
    using std::sin;
    const T away = y[0] - 1 / (1 + t) - sin(frequency * t);
    f[0] =
        frequency * cos(frequency * t) - 1 / ((1 + t) * (1 + t)) - rate * away * (1 + bend * (away * away));
  }
  [[nodiscard]] double exact(double t) const { return 1 / (1 + t) + std::sin(frequency * t); }
};

TEST(RandomisedStiff, SlowManifolds) {
  randomised_test({.quick = 400, .full = 40'000}, [](Draw& draw) {
    const Manifold p{.rate = draw.log_uniform(1, 1e10),
                     .bend = draw.chance(0.5) ? 0 : draw.log_uniform(0.1, 1e3),
                     .frequency = draw.log_uniform(0.01, 30)};
    const double end = draw.log_uniform(0.1, 20), tolerance = draw.log_uniform(1e-13, 1e-2);
    const auto s =
        integrate(System(p), State{p.exact(0)}, 0, end,
                  AdaptiveCollocation{.relative_tolerance = tolerance, .absolute_tolerance = tolerance}, {},
                  {.steps = 100'000});
    if (!s.status.ok()) return Case::refused(s.status.text());
    return Case::judged(
        std::abs(s.x[0] - p.exact(end)), digits_and_a_half * 3 * (tolerance + 10 * eps),
        fmt::format("rate {:.17g}, bend {:.17g}, frequency {:.17g}, end {:.17g}, tolerance {:.17g}", p.rate,
                    p.bend, p.frequency, end, tolerance));
  });
}

/// y1' = -(r + 2) y1 + r y2^2, y2' = y1 - y2 - y2^2 (P. Kaps, Dissertation, Innsbruck 1977): y1 = exp(-2 t),
/// y2 = exp(-t) whatever r.
struct Kaps {
  static constexpr int dimension = 2;
  double rate;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& y, Vector<T, 2>& f) const {
    f[0] = rate * (y[1] * y[1] - y[0]) - 2 * y[0];
    f[1] = y[0] - y[1] - y[1] * y[1];
  }
};

TEST(RandomisedStiff, KapsProblem) {
  randomised_test({.quick = 400, .full = 40'000}, [](Draw& draw) {
    const Kaps p{.rate = draw.log_uniform(1, 1e12)};
    const double end = draw.log_uniform(0.01, 10), tolerance = draw.log_uniform(1e-13, 1e-2);
    const double absolute = draw.chance(0.5) ? tolerance : tolerance * draw.log_uniform(1e-6, 1);
    const auto s =
        integrate(System(p), State{1, 1}, 0, end,
                  AdaptiveCollocation{.relative_tolerance = tolerance, .absolute_tolerance = absolute}, {},
                  {.steps = 100'000});
    if (!s.status.ok()) return Case::refused(s.status.text());
    const State exact{std::exp(-2 * end), std::exp(-end)};
    // y1 follows y2^2, so its absolute error is at least 2 y2 times that of y2.
    const double most =
        ((s.x - exact).cwiseAbs().array() / (absolute + (tolerance + 10 * eps) * exact.array())).maxCoeff();
    return Case::judged(most, digits_and_a_half * 2,
                        fmt::format("rate {:.17g}, end {:.17g}, tolerance {:.17g}, absolute {:.17g}", p.rate,
                                    end, tolerance, absolute));
  });
}

}  // namespace
}  // namespace nlmech::ivp::ivp_stiff_test
