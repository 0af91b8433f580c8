#include "nlmech/ivp/structural/alpha_family.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/cubic_hermite.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

AlphaScheme alpha_scheme(const Newmark& method) {
  require_within(method.name, "beta", method.beta, 0, 0.5);
  require_within(method.name, "gamma", method.gamma, 0, 1);
  return {.beta = method.beta, .gamma = method.gamma};
}

AlphaScheme alpha_scheme(const Hht& method) {
  require_within(method.name, "alpha", method.alpha, -1. / 3, 0);
  return {.alpha_m = 0,
          .alpha_f = -method.alpha,
          .beta = (1 - method.alpha) * (1 - method.alpha) / 4,
          .gamma = 0.5 - method.alpha,
          .forgets = method.form == Hht::Form::as_printed};
}

AlphaScheme alpha_scheme(const GeneralizedAlpha& method) {
  const double rho = method.rho_inf;
  require_within(method.name, "rho_inf", rho, 0, 1);
  const double alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
  const double root = 1 - alpha_m + alpha_f;
  return {.alpha_m = alpha_m, .alpha_f = alpha_f, .beta = root * root / 4, .gamma = root - 0.5};
}

namespace {

/// Stepper of the family; Newton's iteration with the exact Jacobian solves for a1, from a1 = a0.
class AlphaStepper : public Stepper {
 public:
  /// @param system outlives the stepper
  AlphaStepper(const System& system, std::string_view name, const AlphaScheme& scheme,
               const algebraic::Newton& newton)
      : Stepper(system.size()),
        system_(system),
        name_(name),
        scheme_(scheme),
        newton_(newton),
        hermite_(system.size()),
        jacobian_(system.size(), system.size()),
        q_(State::Zero(system.size() / 2)),
        v_(q_),
        a0_(q_),
        a1_(q_),
        g0_(q_),
        g1_(q_),
        workspace_(q_.size()) {}
  /// Name of the method.
  [[nodiscard]] std::string_view name() const { return name_; }

  /// The next step starts a segment on which f is smooth; the last acceleration is discarded.
  void begin_segment(double begin, double end) {
    segment_ = SmoothSegment(begin, end);
    starts_ = true;
  }

  /// Integrates from t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
    if (starts_) {
      q_ = positions(x0);
      v_ = velocities(x0);
      system_.acceleration(segment_(t), q_, v_, g0_);
      ++statistics.right_hand_sides;
      a0_ = g0_;
      join(q_, v_, g0_, hermite_.x1, hermite_.f1);
      starts_ = false;
    }
    hermite_.next_step(t, h);
    a1_ = a0_;
    if (Status status = solve(t, h, x0, statistics); !status.ok()) return status;
    advance(h, x0);
    // The force at the end, from the equation just solved.
    const auto [m, f] = std::pair(scheme_.alpha_m, scheme_.alpha_f);
    for (Eigen::Index i = 0; i < q_.size(); ++i)
      g0_[i] = ((1 - m) * a1_[i] + m * a0_[i] - f * g0_[i]) / (1 - f);
    join(q_, v_, g0_, hermite_.x1, hermite_.f1);
    x1 = hermite_.x1;
    a0_ = scheme_.forgets ? g0_ : a1_;
    return {};
  }

  /// Dense output: cubic Hermite interpolation.
  void at(double t, State& x) const override { hermite_.at(t, x); }

 private:
  // Positions and velocities that belong to the accelerations a1.
  void advance(double h, const State& x0) {
    const double beta = scheme_.beta, gamma = scheme_.gamma;
    const Eigen::Index size = q_.size();
    for (Eigen::Index i = 0; i < size; ++i) {
      const double v0 = x0[size + i], a0 = a0_[i], a1 = a1_[i];
      q_[i] = x0[i] + h * v0 + (h * h) * ((0.5 - beta) * a0 + beta * a1);
      v_[i] = v0 + h * ((1 - gamma) * a0 + gamma * a1);
    }
  }

  Status solve(double t, double h, const State& x0, Statistics& statistics) {
    const double t1 = segment_(t + h), wm = 1 - scheme_.alpha_m, wf = 1 - scheme_.alpha_f;
    const auto residual = [&](const State& /*a1_*/, State& r) {
      advance(h, x0);
      system_.acceleration(t1, q_, v_, g1_);
      ++statistics.right_hand_sides;
      for (Eigen::Index i = 0; i < r.size(); ++i)
        r[i] = wm * a1_[i] + scheme_.alpha_m * a0_[i] - wf * g1_[i] - scheme_.alpha_f * g0_[i];
    };
    const auto derivative = [&](const State& /*a1_*/, Jacobian& matrix) {
      join(q_, v_, g1_, hermite_.x1, hermite_.f1);  // as workspace: step() overwrites it
      system_.jacobian(t1, hermite_.x1, jacobian_);
      const double by_q = scheme_.beta * h * h, by_v = scheme_.gamma * h;
      const Eigen::Index size = q_.size();
      for (Eigen::Index k = 0; k < size; ++k) {
        for (Eigen::Index i = 0; i < size; ++i)
          matrix(i, k) = -wf * (by_q * jacobian_(size + i, k) + by_v * jacobian_(size + i, size + k));
        matrix(k, k) += wm;
      }
    };
    algebraic::Newton newton = newton_;
    newton.noise = std::max(newton.noise, noise(h, x0));
    const std::int64_t before = statistics.newton_iterations;
    const Outcome outcome = algebraic::solve(newton, residual, derivative, a1_, workspace_, statistics);
    if (outcome == Outcome::success) return {};
    return step_not_solved(name_, outcome, t, h, static_cast<int>(statistics.newton_iterations - before));
  }

  // Rounding of q and v changes g by at most eps (|g_q| |q| + |g_v| |v|), and so a1, for any stiffness of g,
  // by at most eps (|q|/(beta h^2) + |v|/(gamma h)). Such a change of a1 is below the rounding of q1 and v1.
  [[nodiscard]] double noise(double h, const State& x0) const {
    constexpr double eps = 4 * std::numeric_limits<double>::epsilon();
    const double q = greatest(x0, 0, q_.size()), v = greatest(x0, q_.size(), x0.size());
    const double by_q = scheme_.beta > 0 ? q / (scheme_.beta * h * h) : 0;
    return eps * (by_q + (scheme_.gamma > 0 ? v / (scheme_.gamma * std::abs(h)) : 0));
  }

  const System& system_;
  std::string_view name_;
  AlphaScheme scheme_;
  algebraic::Newton newton_;
  SmoothSegment segment_;
  CubicHermite hermite_;
  Jacobian jacobian_;
  State q_, v_, a0_, a1_, g0_, g1_;
  algebraic::Workspace<State> workspace_;
  bool starts_ = true;
};

// Integrates by a method of the family.
[[nodiscard]] Solution integrate_by_alpha(const InitialValueProblem& problem, std::string_view name,
                                          double step, const AlphaScheme& scheme,
                                          const algebraic::Newton& newton) {
  require_step(name, step);
  require_accelerations(name, problem.system);
  AlphaStepper stepper(problem.system, name, scheme, newton);
  return integrate_fixed_steps(problem, step, stepper);
}

}  // namespace

Solution run(const InitialValueProblem& problem, const Newmark& method) {
  return integrate_by_alpha(problem, method.name, method.step, alpha_scheme(method), method.newton);
}

Solution run(const InitialValueProblem& problem, const Hht& method) {
  return integrate_by_alpha(problem, method.name, method.step, alpha_scheme(method), method.newton);
}

Solution run(const InitialValueProblem& problem, const GeneralizedAlpha& method) {
  return integrate_by_alpha(problem, method.name, method.step, alpha_scheme(method), method.newton);
}

}  // namespace nlmech::ivp
