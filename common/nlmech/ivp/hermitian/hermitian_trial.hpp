/// @file
/// One trial step by Hermitian operators: Newton's iteration, error estimates, dense output.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/hermitian/hermitian_operators.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/solution.hpp"

namespace nlmech::ivp {

/// A trial step from (t0, x0) to (t1, x1). f = (v, a) and g = (a, j) are the first two derivatives of the
/// state, by dual numbers.
class HermitianTrial : public DenseOutput {
 public:
  /// @param system outlives the trial
  HermitianTrial(const System& system, const HermitianPair& pair, const algebraic::Newton& newton)
      : system_(system),
        name_(pair.name),
        step_(solved_for_end(pair)),
        newton_(newton),
        x0_(State::Zero(system.size())),
        x1_(x0_),
        f0_(x0_),
        f1_(x0_),
        g0_(x0_),
        g1_(x0_),
        middle_(x0_),
        error_(x0_),
        known_(x0_),
        rise_(State::Zero(system.size() / 2)),
        missing_(rise_),
        answer_(rise_),
        filter_(system.size() / 2, system.size() / 2),
        lu_(system.size() / 2),
        fx_(system.size(), system.size()),
        gx_(system.size(), system.size()),
        workspace_(system.size()) {}

  /// Starts a segment on which f is smooth at (t, x). @return false if the right-hand side is not finite
  /// there
  /// @throws std::invalid_argument for a problem in double only
  [[nodiscard]] bool begin_segment(double t, double end, const State& x, Statistics& statistics) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    require_derivatives(name_, system_.second_derivative(segment_(t), x0_, f0_, g0_));
    statistics.right_hand_sides += 2;
    return f0_.allFinite() && g0_.allFinite();
  }

  /// Solves for the end of a step from @p t to @p t + @p h and estimates its error.
  /// @return success, or how Newton's iteration failed
  [[nodiscard]] Outcome attempt(double t, double h, Statistics& statistics) {
    t0_ = t;
    h_ = h;
    const double inside = segment_(t + h);
    predict();
    prepare();
    // [hermitian residual]
    const auto residual = [&](const State& x, State& r) {
      static_cast<void>(system_.second_derivative(inside, x, f1_, g1_, fx_, gx_));
      statistics.right_hand_sides += 2;
      const Eigen::Index m = x.size() / 2;
      for (Eigen::Index i = 0; i < m; ++i) {
        const double a = f1_[m + i], j = g1_[m + i];
        r[i] = x[i] - known_[i] - (h_ * h_) * (step_.qa1 * a + (h_ * step_.qj1) * j);
        r[m + i] = x[m + i] - known_[m + i] - h_ * (step_.va1 * a + (h_ * step_.vj1) * j);
      }
    };
    // [hermitian residual]
    const auto derivative = [&](const State& /*x*/, Jacobian& matrix) { assemble(matrix); };
    algebraic::Newton newton = newton_;
    // Rounding of f and g changes velocities by eps |x| / h times at most some tens, for any stiffness of f.
    newton.noise =
        std::max(newton.noise, 1024 * epsilon * greatest(x0_, 0, x0_.size()) * (1 + 1 / std::abs(h_)));
    const Outcome outcome = algebraic::solve(newton, residual, derivative, x1_, workspace_, statistics);
    if (outcome != Outcome::success) return outcome;
    static_cast<void>(system_.second_derivative(inside, x1_, f1_, g1_));
    statistics.right_hand_sides += 2;
    if (!f1_.allFinite() || !g1_.allFinite()) return Outcome::non_finite;
    estimate(statistics);
    return error_.allFinite() ? Outcome::success : Outcome::non_finite;
  }

  /// Accepts the trial; its end becomes the start of the next one.
  void accept() {
    std::swap(x0_, x1_);
    std::swap(f0_, f1_);
    std::swap(g0_, g1_);
  }

  /// State at the start of the trial.
  [[nodiscard]] const State& begin_state() const { return x0_; }
  /// State at the end of the trial.
  [[nodiscard]] const State& end_state() const { return x1_; }
  /// dx/dt at the start.
  [[nodiscard]] const State& begin_derivative() const { return f0_; }

  /// max_i |e_i| / (atol + rtol max(|x0_i|, |x1_i|)) of the estimate e.
  [[nodiscard]] double error_of(double atol, double rtol) const {
    return worst_share(error_, x0_, x1_, atol, rtol);
  }
  /// A second estimate in the same norm, for steps that do not resolve the stiffness of the problem. The
  /// first estimate is valid for short steps; for an oscillation it vanishes at some large step sizes, which
  /// step-size control would find. The residual of the dense output at four points without symmetry, h^2 (q''
  /// - a) times (1 - h^2 a_q/12 - h a_v/2)^-1, cannot vanish at all of them: for the linear oscillator it is
  /// 2e-3 of the amplitude at h omega = 1 and grows with h omega, for every phase and the operators of Laier
  /// and Newmark (Argyris: from 5e-5). It is 0 for h^2 |a_q| <= 2 unless @p always is set, as for a first
  /// step, all of whose evaluations may meet a periodic load at the same phase.
  [[nodiscard]] double unresolved(double atol, double rtol, bool always, Statistics& statistics) {
    const Eigen::Index m = system_.size() / 2;
    const auto stiffness = fx_.bottomLeftCorner(m, m), damping = fx_.bottomRightCorner(m, m);
    if (!(h_ * h_ * greatest_row_sum(0) > 2) && !always) return 0;
    filter_ = -(h_ * h_ / 12) * stiffness - (h_ / 2) * damping;
    filter_.diagonal().array() += 1;
    lu_.compute(filter_);
    ++statistics.factorisations;
    double worst = 0;
    for (const double s : {0.17, 0.39, 0.62, 0.86}) {
      interpolate(s, middle_);
      system_.rhs(segment_(t0_ + s * h_), middle_, known_);
      ++statistics.right_hand_sides;
      curvature(s, missing_);
      missing_ -= velocities(known_);
      missing_ *= h_ * h_;
      lu_.solve(missing_, answer_);
      const double q = worst_share(answer_, positions(x0_), positions(x1_), atol, rtol),
                   v = worst_share(answer_ / h_, velocities(x0_), velocities(x1_), atol, rtol);
      if (std::isnan(q) || std::isnan(v)) return NAN;
      worst = std::max({worst, q, v});
    }
    return worst;
  }
  /// The estimate as a displacement, max(|e_q|, h |e_v|), relative to the largest of |q0|, |q1|, |h v0| and
  /// |h v1|.
  [[nodiscard]] double relative_displacement() const {
    const double size = std::max(displacement(x0_), displacement(x1_));
    return size > 0 ? displacement(error_) / size : 0;
  }
  /// Change of the stiffness h^2 a_q and the damping h a_v from start to end of the trial: 0 for a linear
  /// problem with constant coefficients, whose steps have one solution only.
  [[nodiscard]] double nonlinearity(Statistics& statistics) {
    system_.jacobian(segment_(t0_), x0_, fx_);
    system_.jacobian(segment_(t0_ + h_), x1_, gx_);
    statistics.jacobians += 2;
    gx_ -= fx_;
    const Eigen::Index m = system_.size() / 2;
    return std::max(h_ * h_ * gx_.bottomLeftCorner(m, m).cwiseAbs().maxCoeff(),
                    std::abs(h_) * gx_.bottomRightCorner(m, m).cwiseAbs().maxCoeff());
  }

  /// Dense output: quintic Hermite interpolation of positions, velocities and accelerations of both ends, and
  /// its derivative. Its error within a step is O(h^6) in positions and O(h^5) in velocities.
  void at(double t, State& x) const override {
    x.resize(system_.size());
    interpolate((t - t0_) / h_, x);
  }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  // Predicts the end by the Taylor polynomial; by the start if the last term exceeds the displacements.
  void predict() {
    const Eigen::Index n = x0_.size(), m = n / 2;
    for (Eigen::Index i = 0; i < n; ++i) x1_[i] = x0_[i] + h_ * f0_[i] + (h_ * h_ / 2) * g0_[i];
    for (Eigen::Index i = 0; i < m; ++i) x1_[i] += (h_ * h_ * h_ / 6) * g0_[m + i];
    const double size = displacement(x0_), last = h_ * h_ * greatest(g0_, m, n) * std::abs(h_);
    if (!(last <= size) || !x1_.allFinite()) x1_ = x0_;
  }

  // Computes the terms of the equations that do not depend on the end.
  void prepare() {
    const Eigen::Index m = x0_.size() / 2;
    for (Eigen::Index i = 0; i < m; ++i) {
      const double v = x0_[m + i], a = f0_[m + i], j = g0_[m + i];
      known_[i] = x0_[i] + (h_ * v + (h_ * h_) * (step_.qa0 * a + (h_ * step_.qj0) * j));
      known_[m + i] = v + h_ * (step_.va0 * a + (h_ * step_.vj0) * j);
    }
  }

  void assemble(Jacobian& matrix) const {
    const Eigen::Index m = matrix.rows() / 2;
    for (Eigen::Index k = 0; k < 2 * m; ++k) {
      for (Eigen::Index i = 0; i < m; ++i) {
        const double a = fx_(m + i, k), j = gx_(m + i, k);
        matrix(i, k) = -(h_ * h_) * (step_.qa1 * a + (h_ * step_.qj1) * j);
        matrix(m + i, k) = -h_ * (step_.va1 * a + (h_ * step_.vj1) * j);
      }
      matrix(k, k) += 1;
    }
  }

  // Error estimate: the residuals of two operators of higher order than those of the table. One has both ends
  // with their jerks and is exact for q of degree 6; the other has the acceleration in the middle of the
  // dense output, a new evaluation, and is exact for v of degree 6.
  void estimate(Statistics& statistics) {
    measure_rise();
    interpolate(0.5, middle_);
    const double inside = segment_(t0_ + h_ / 2);
    system_.rhs(inside, middle_, known_);
    ++statistics.right_hand_sides;
    const Eigen::Index m = x0_.size() / 2;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index k = m + i;
      const double a0 = f0_[k], a1 = f1_[k], j0 = g0_[k], j1 = g1_[k];
      error_[i] = x1_[i] - x0_[i] - (h_ / 2) * (x0_[k] + x1_[k]) - (h_ * h_ / 10) * (a0 - a1) -
                  (h_ * h_ * h_ / 120) * (j0 + j1);
      error_[k] = x1_[k] - x0_[k] - (h_ / 30) * (7 * (a0 + a1) + 16 * known_[k]) - (h_ * h_ / 60) * (j0 - j1);
    }
  }

  // (q1 - q0)/h by the formula with less rounding: the difference has eps |q|/h, the equation of the step has
  // that of its terms (for the jerk: that of the acceleration times the damping).
  void measure_rise() {
    const Eigen::Index m = rise_.size(), n = 2 * m;
    const double h = std::abs(h_), q = std::max(greatest(x0_, 0, m), greatest(x1_, 0, m)),
                 v = std::max(greatest(x0_, m, n), greatest(x1_, m, n));
    const double damping = greatest_row_sum(m), force = greatest_row_sum(0) * q + damping * v;
    const bool by_equation = h * (v + h * force * (1 + h * damping)) < q;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index k = m + i;
      rise_[i] = by_equation ? x0_[k] + h_ * (step_.qa0 * f0_[k] + step_.qa1 * f1_[k] +
                                              h_ * (step_.qj0 * g0_[k] + step_.qj1 * g1_[k]))
                             : (x1_[i] - x0_[i]) / h_;
    }
  }

  // Largest row sum of |da_i/dx_k| over positions (@p begin = 0) or velocities (@p begin = m).
  [[nodiscard]] double greatest_row_sum(Eigen::Index begin) const {
    const Eigen::Index m = rise_.size();
    double most = 0;
    for (Eigen::Index i = m; i < 2 * m; ++i) {
      double sum = 0;
      for (Eigen::Index k = begin; k < begin + m; ++k) sum += std::abs(fx_(i, k));
      most = std::max(most, sum);
    }
    return most;
  }

  void interpolate(double s, State& x) const {
    const double r = 1 - s, s3 = s * s * s, r3 = r * r * r;
    const Eigen::Index m = rise_.size();
    for (Eigen::Index i = 0; i < m; ++i) {
      const double q0 = x0_[i], q1 = x1_[i], v0 = x0_[m + i], v1 = x1_[m + i], a0 = f0_[m + i],
                   a1 = f1_[m + i];
      x[i] = q0 + (s3 * (10 - s * (15 - 6 * s))) * (q1 - q0) + (h_ * s * r3 * (1 + 3 * s)) * v0 -
             (h_ * r * s3 * (1 + 3 * r)) * v1 + (h_ * h_ / 2 * s * s * r3) * a0 +
             (h_ * h_ / 2 * s3 * r * r) * a1;
      x[m + i] = (30 * s * s * r * r) * rise_[i] + (r * r * (1 + s * (2 - 15 * s))) * v0 +
                 (s * s * (1 + r * (2 - 15 * r))) * v1 + (h_ / 2 * s * r * r * (2 - 5 * s)) * a0 -
                 (h_ / 2 * r * s * s * (2 - 5 * r)) * a1;
    }
  }

  // The second derivative of the positions of interpolate().
  void curvature(double s, State& c) const {
    const double r = 1 - s;
    const auto v0 = velocities(x0_), v1 = velocities(x1_), a0 = velocities(f0_), a1 = velocities(f1_);
    c = ((60 * s * r * (r - s)) * rise_ + (r * r * (2 - 30 * s) - 2 * r * (1 + s * (2 - 15 * s))) * v0 +
         (2 * s * (1 + r * (2 - 15 * r)) - s * s * (2 - 30 * r)) * v1) /
            h_ +
        (r * r * (1 - 5 * s) - r * s * (2 - 5 * s)) * a0 + (s * s * (1 - 5 * r) - s * r * (2 - 5 * r)) * a1;
  }

  // max_i |e_i| / (atol + rtol max(|a_i|, |b_i|)); NaN if a term is NaN.
  template <class E, class A>
  [[nodiscard]] static double worst_share(const E& e, const A& a, const A& b, double atol, double rtol) {
    double worst = 0;
    for (Eigen::Index i = 0; i < e.size(); ++i) {
      const double part = std::abs(e[i]) / (atol + rtol * std::max(std::abs(a[i]), std::abs(b[i])));
      if (std::isnan(part)) return part;
      worst = std::max(worst, part);
    }
    return worst;
  }

  [[nodiscard]] double displacement(const State& x) const {
    const Eigen::Index m = rise_.size();
    return std::max(greatest(x, 0, m), std::abs(h_) * greatest(x, m, 2 * m));
  }

  const System& system_;
  std::string_view name_;
  HermitianStep step_;
  algebraic::Newton newton_;
  SmoothSegment segment_;
  State x0_, x1_, f0_, f1_, g0_, g1_, middle_, error_, known_;
  State rise_, missing_, answer_;
  Jacobian filter_;
  algebraic::DenseLu<double> lu_;
  Jacobian fx_, gx_;
  algebraic::Workspace<State> workspace_;
  double t0_ = 0, h_ = 1;
};

}  // namespace nlmech::ivp
