/// Derivatives of Kepler's motion and of Lambert's problem against differences in 100 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert_partials.hpp"
#include "tests/randomised/kepler_oracle.hpp"

namespace nlmech::orbit::randomised::transition_test {
namespace {

using nlmech::randomised::Case;
using nlmech::randomised::randomised_test;

/// Derivatives of position and velocity by x, y, z, vx, vy, vz and mu.
using Derivatives = Matrix<Real, 6, 7>;

/// Data of a motion: state, mu and time, which a relative error of a vector, of mu or of the time changes.
struct Data {
  BasicState<Real> start;
  Real mu, time;

  [[nodiscard]] Data changed(int d, const Real& by) const {
    Data c = *this;
    if (d < 3) c.start.position[d] += by * length(start.position);
    if (d >= 3 && d < 6) c.start.velocity[d - 3] += by * length(start.velocity);
    if (d == 6) c.mu *= 1 + by;
    if (d == 7) c.time *= 1 + by;
    return c;
  }
  /// By one-sided differences of 1e-45: errors of 1e-45 kappa, and of 1e-55 from rounding.
  [[nodiscard]] Derivatives derivatives() const {
    const Real part("1e-45"), r = length(start.position), speed = sqrt(mu / r);
    const auto end = conic<Real>(start, time, mu);
    Derivatives all;
    for (int j = 0; j < 7; ++j) {
      BasicState<Real> s = start;
      Real m = mu;
      const Real step = part * (j < 3 ? r : j < 6 ? Real(speed + length(start.velocity)) : mu);
      (j < 3 ? s.position[j] : j < 6 ? s.velocity[j - 3] : m) += step;
      const auto moved = conic<Real>(s, time, m);
      for (int i = 0; i < 3; ++i) {
        all(i, j) = (moved.position[i] - end.position[i]) / step;
        all(3 + i, j) = (moved.velocity[i] - end.velocity[i]) / step;
      }
    }
    return all;
  }
};

double norm(const Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>& m) {
  Real sum = 0;
  for (const Real& x : m.reshaped()) sum += x * x;
  return static_cast<double>(Real(sqrt(sum)));
}

/// Largest error of a 3x3 block or of half of the derivatives by mu, over (1 + kappa) eps of its norm,
/// with its condition number kappa: the sum of the effects of relative changes of all data.
double error_of_blocks(const KeplerTransition& k, const Data& data) {
  Matrix<double, 6, 7> mine;
  mine << k.transition, k.by_mu;
  const Real part("1e-18");
  const Derivatives exact = data.derivatives();
  std::array<Derivatives, 8> changed;
  for (int d = 0; d < 8; ++d) changed[static_cast<std::size_t>(d)] = data.changed(d, part).derivatives();
  double worst = 0;
  for (const int row : {0, 3}) {
    for (const int column : {0, 3, 6}) {
      const int columns = column == 6 ? 1 : 3;
      const auto block = [&](const Derivatives& m) { return m.block(row, column, 3, columns).eval(); };
      const double size = norm(block(exact));
      double effects = 0;
      for (const Derivatives& c : changed) effects += norm(block(c) - block(exact)) * 1e18;
      const double error = norm(mine.block(row, column, 3, columns).cast<Real>() - block(exact));
      if (error > 0) worst = std::max(worst, error / (eps * (size + effects)));
    }
  }
  return worst;
}

TEST(RandomisedTransition, KeplersMatrixIsAsExactAsItsData) {
  randomised_test({.quick = 40, .full = 10'000}, [](Draw& draw) {
    const Motion m = any_motion(draw);
    const KeplerTransition k = kepler_transition(m.start, m.time, m.mu);
    if (!k.status.ok()) return Case::refused();
    const std::string what = words(m.start, m.time, m.mu);
    const KeplerCondition kappa = kepler_condition(m.start, m.time, m.mu);
    if (k.state.position != propagate_kepler(m.start, m.time, m.mu).state.position) return Case::wrong(what);
    if (kappa.position * eps > 1e-6) return Case::undecided();  // effects of second order
    const double radial = m.start.position.dot(m.start.velocity) * m.time,
                 share = m.start.velocity.squaredNorm() * m.start.position.norm() / m.mu;
    const double allowed = std::max(16.0, radial < 0 ? 0.01 * share : 0);  // see kepler_transition()
    return Case::judged(error_of_blocks(k, {as<Real>(m.start), Real(m.mu), Real(m.time)}), allowed, what);
  });
}

/// v_1 of the transfer in 100 digits by Newton's iteration with the approximate inverse @p inverse.
/// @return false if it does not converge
bool find_velocity(const Vector3<Real>& from, const Vector3<Real>& to, const Real& time, const Real& mu,
                   const Matrix<double, 3>& inverse, BasicState<Real>& ends) {
  for (int i = 0; i < 40; ++i) {
    const auto end = conic<Real>({from, ends.position}, time, mu);
    const Vector3<Real> miss = end.position - to;
    ends.velocity = end.velocity;
    if (length(miss) < Real("1e-85") * length(to)) return true;
    ends.position -= inverse.cast<Real>() * miss;
  }
  return false;
}

// Relative errors of the four blocks and of both derivatives by the time are at most 64 kappa eps times the
// condition of d(r_2)/d(v_1), kappa the condition of the orbit: the matrix has errors of 8 kappa eps,
// products and the inverse some more.
TEST(RandomisedTransition, LambertsPartialsAreThoseOfDifferences) {
  randomised_test({.quick = 30, .full = 10'000}, [](Draw& draw) {
    const double mu = draw.log_uniform(1e-6, 1e20), r = draw.log_uniform(1e-6, 1e12);
    TransferProblem p{r * direction(draw), r * draw.log_uniform(0.01, 100) * direction(draw), 0, {.mu = mu}};
    const double size = std::max(p.from.norm(), p.to.norm());
    p.time = size * std::sqrt(size / mu) * draw.log_uniform(1e-2, 300);
    const LambertArc arc{draw.chance(0.5), draw.chance(0.5) ? 0 : draw.whole(0, 10),
                         draw.chance(0.5) ? LambertBranch::low : LambertBranch::high};
    const LambertSolution s = solve_lambert({p.from, p.to, p.time, mu}, arc);
    if (!s.status.ok()) return Case::refused();
    const LambertPartials d = lambert_partials(p, s.v1);
    if (!d.status.ok()) return Case::refused();
    const std::string what = words({p.from, s.v1}, p.time, mu);
    const KeplerCondition kappa = kepler_condition({p.from, s.v1}, p.time, mu);
    const double allowed = 64 * eps * std::max(kappa.position, kappa.velocity) * d.condition;
    if (allowed > 1e-4) return Case::undecided();
    const BasicState<Real> places = as<Real>(State{p.from, p.to});
    BasicState<Real> base = as<Real>(State{s.v1, s.v2});  // both velocities
    if (!find_velocity(places.position, places.velocity, Real(p.time), Real(mu), d.v1_by_r2, base))
      return Case::undecided();
    Derivatives exact;
    for (int j = 0; j < 7; ++j) {
      BasicState<Real> at = places, found = base;
      Real time = p.time;
      const Real step = Real("1e-40") * (j < 6 ? Real(size) : time);
      (j < 3 ? at.position[j] : j < 6 ? at.velocity[j - 3] : time) += step;
      if (!find_velocity(at.position, at.velocity, time, Real(mu), d.v1_by_r2, found))
        return Case::undecided();
      for (int i = 0; i < 3; ++i) {
        exact(i, j) = (found.position[i] - base.position[i]) / step;
        exact(3 + i, j) = (found.velocity[i] - base.velocity[i]) / step;
      }
    }
    Matrix<double, 6, 7> mine;
    mine << d.v1_by_r1, d.v1_by_r2, d.v1_by_time, d.v2_by_r1, d.v2_by_r2, d.v2_by_time;
    double worst = 0;
    for (const int row : {0, 3}) {
      for (const int column : {0, 3, 6}) {
        const int columns = column == 6 ? 1 : 3;
        const auto block = exact.block(row, column, 3, columns).eval();
        worst = std::max(worst, norm(mine.block(row, column, 3, columns).cast<Real>() - block) / norm(block));
      }
    }
    return Case::judged(worst, allowed, what);
  });
}

}  // namespace
}  // namespace nlmech::orbit::randomised::transition_test
