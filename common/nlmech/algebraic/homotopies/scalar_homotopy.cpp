#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/algebraic/solver_run.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::VectorXd;

constexpr const char* first_homotopy = "scalar-homotopy";

class Pass {
 public:
  Pass(const FirstScalarHomotopy& method, SolverRun& run)
      : method_(method), run_(run), origin_(run.x), way_(run.x.size()), w_(run.x.size()), f_(run.x.size()) {}

  Outcome step() {
    const double h = std::numbers::pi / 2 / method_.steps, phi = h * taken_;
    if (taken_ == 0) begin();
    Outcome outcome = velocity(run_.x, phi, run_.f, run_.norm);
    if (outcome != Outcome::success) return outcome;
    run_.trial = run_.x + h / 2 * w_;
    const double norm = run_.evaluate(run_.trial, f_);
    if (!(norm < HUGE_VAL)) return Outcome::non_finite;
    outcome = velocity(run_.trial, phi + h / 2, f_, norm);
    if (outcome != Outcome::success) return outcome;
    run_.trial = run_.x + h * w_;
    run_.evaluate_trial();
    if (!(run_.trial_norm < HUGE_VAL)) return Outcome::non_finite;
    taken_ = (taken_ + 1) % method_.steps;
    return run_.accept(taken_ == 0 ? 1 : std::pow(std::sin(h * taken_), 2));
  }

 private:
  void begin() {
    origin_ = run_.x;
    if (method_.weight > 0) return;
    run_.linearise(run_.x);
    run_.equations().apply_transposed(run_.f, w_);
    run_.equations().apply(w_, way_);
    weight_ = w_.norm() / way_.norm();
  }

  // dx/dphi = dx/dt 2 sin phi cos phi, into w_.
  Outcome velocity(const VectorXd& x, double phi, const VectorXd& f, double norm) {
    const double s = std::sin(phi), c = std::cos(phi);
    run_.linearise(x);
    run_.equations().apply_transposed(f, w_);
    if (phi > 0) {
      way_ = x - origin_;
      w_ = s * s * weight_ * weight_ * w_ - c * c * way_;
    }
    const double slope = w_.norm();
    if (!std::isfinite(slope)) return Outcome::non_finite;
    if (slope == 0) return Outcome::singular_matrix;
    if (phi > 0) {
      const double length = std::hypot(weight_ * norm, way_.norm());
      w_ *= -s * c * (length / slope) * (length / slope);
    } else {
      w_ *= -weight_ * norm / slope;  // limit phi -> 0 for a path that starts along -B^T F
    }
    return w_.allFinite() ? Outcome::success : Outcome::singular_matrix;
  }

  const FirstScalarHomotopy& method_;
  SolverRun& run_;
  VectorXd origin_, way_, w_, f_;
  double weight_ = method_.weight;
  int taken_ = 0;  // steps taken in this pass
};

}  // namespace

Report find_root(const FirstScalarHomotopy& method, Equations& equations, VectorXd& x,
                 const Observer& observer) {
  require_option(first_homotopy, method.steps >= 1, "steps", method.steps, "at least 1");
  require_option(first_homotopy, method.weight >= 0 && std::isfinite(method.weight), "weight", method.weight,
                 "0 or positive");
  return iterate<Pass>(first_homotopy, method, equations, x, observer,
                       {Outcome::singular_matrix,
                        "dh/dx is 0, so that the flow has no direction: |F| is stationary; start elsewhere"});
}

namespace {

const char* name_of(const ScalarHomotopy& method) {
  return method.function == ScalarHomotopy::Function::fixed_point ? "fixed-point homotopy"
                                                                  : "newton homotopy";
}

void check(const ScalarHomotopy& method) {
  const auto require = [&](bool good, const char* option, double value, const char* range) {
    require_option(name_of(method), good, option, value, range);
  };
  require(method.step > 0 && std::isfinite(method.step), "step", method.step, "positive");
  require(method.tolerance >= 0, "tolerance", method.tolerance, "0 or positive");
  require(method.steps >= 0, "steps", static_cast<double>(method.steps), "0 or positive");
}

/// A point of the flow: x, F and the velocity.
struct Point {
  explicit Point(Eigen::Index n) : x(n), f(n), velocity(n) {}
  Eigen::VectorXd x, f, velocity;
  double norm = 0;  // |F|
};

class HomotopyFlow {
 public:
  HomotopyFlow(const ScalarHomotopy& method, Equations& equations, const Eigen::VectorXd& x)
      : method_(method),
        equations_(equations),
        origin_(x),
        gradient_(x.size()),
        now_(x.size()),
        next_(x.size()) {
    now_.x = x;
  }

  Report run(const Observer& observer) {
    Outcome outcome = residual(now_);
    report_.first = report_.least = now_.norm;
    if (outcome == Outcome::success && now_.norm > method_.tolerance) outcome = velocity(now_, 0);
    for (;;) {
      report_.least = std::min(report_.least, now_.norm);
      report_.last = now_.norm;
      if (outcome == Outcome::success && observer &&
          !observer({report_.statistics.steps, report_.time, now_.x, now_.f, now_.norm}))
        outcome = Outcome::interrupted;
      if (outcome != Outcome::success || now_.norm <= method_.tolerance) break;
      outcome = step();
    }
    if (outcome != Outcome::success) report_.status = Status::failure(outcome, sentence(outcome));
    return std::move(report_);
  }

  [[nodiscard]] const Eigen::VectorXd& x() const { return now_.x; }

 private:
  Outcome residual(Point& p) {
    equations_.residual(p.x, p.f);
    ++report_.statistics.right_hand_sides;
    p.norm = p.f.norm();
    return std::isfinite(p.norm) ? Outcome::success : Outcome::non_finite;
  }

  //! [scalar homotopy flow]
  // Eq. 2.14 with |F|^2/2 for dh/dt, its value on h = 0, and u = w = dh/dx.
  Outcome velocity(Point& p, double t) {
    equations_.linearise(p.x);
    ++report_.statistics.jacobians;
    equations_.apply_transposed(p.f, gradient_);
    if (method_.function == ScalarHomotopy::Function::fixed_point)
      gradient_ -= std::exp(-t) * (p.x - origin_);
    const double slope = gradient_.norm();
    if (!std::isfinite(slope)) return Outcome::non_finite;
    if (slope == 0) return Outcome::singular_matrix;
    // In this order no square can over- or underflow.
    gradient_ /= slope;
    p.velocity = (-0.5 * p.norm / slope * p.norm) * gradient_;
    return Outcome::success;
  }
  //! [scalar homotopy flow]

  // One step of Euler's method; evaluates F and the velocity at its end.
  Outcome step() {
    if (report_.statistics.steps >= method_.steps) return Outcome::step_limit;
    next_.x = now_.x + method_.step * now_.velocity;
    Outcome outcome = residual(next_);
    if (outcome == Outcome::success && next_.norm > method_.tolerance)
      outcome = velocity(next_, report_.time + method_.step);
    // Accept a point with vanishing gradient; the returned outcome ends the iteration afterwards.
    if (outcome != Outcome::success && outcome != Outcome::singular_matrix) return outcome;
    std::swap(now_, next_);
    report_.time += method_.step;
    ++report_.statistics.steps;
    return outcome;
  }

  [[nodiscard]] std::string sentence(Outcome outcome) const {
    const std::string place =
        fmt::format("{}: after {} steps, at fictitious time {:.6g} with |F| = {:.3g}", name_of(method_),
                    report_.statistics.steps, report_.time, now_.norm);
    switch (outcome) {
      case Outcome::singular_matrix:
        return place + ", the flow has no direction: |F| is stationary and not zero; start elsewhere";
      case Outcome::non_finite:
        return place + ", F or its derivative is not finite; take shorter steps or start elsewhere";
      case Outcome::interrupted: return place + ", stopped by the observer";
      default: return place + ", the allowed steps are used up; allow more, or start closer to a root";
    }
  }

  const ScalarHomotopy& method_;
  Equations& equations_;
  const Eigen::VectorXd origin_;
  Eigen::VectorXd gradient_;
  Point now_, next_;
  Report report_;
};

}  // namespace

Report find_root(const ScalarHomotopy& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  check(method);
  require_size(name_of(method), equations, x);
  HomotopyFlow flow(method, equations, x);
  Report report = flow.run(observer);
  x = flow.x();
  return report;
}

}  // namespace nlmech::algebraic
