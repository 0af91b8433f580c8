#include "nlmech/algebraic/newton/energy_trust_region.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
/// Sets lambda between the bounds, nearer to the lower one.
void TrustRegionStep::pick() {
  lambda_ = std::max(std::sqrt(std::max(lower_, 0.) * upper_), lower_ + 0.01 * (upper_ - lower_));
}

/// Newton step for 1/|p| = 1/radius; from below it approaches lambda monotonically.
void TrustRegionStep::next(double radius, double length, const SymmetricSolver& b, const Eigen::VectorXd& p) {
  b.solve(p, v_);
  const double slope = p.dot(v_);
  lambda_ += length * length / slope * (length - radius) / radius;
  if (!(lambda_ > lower_ && lambda_ < upper_)) pick();
}

/// Hard case: p is inside the ball though lambda > 0. Adds a vector of small curvature to reach the boundary.
/// @return true if the result is accurate enough
bool TrustRegionStep::add_null_vector(const SymmetricSolver& b, const Eigen::VectorXd& g, double radius,
                                      Eigen::VectorXd& p) {
  // Inverse iteration, starting from a direction of negative curvature if one is known.
  if (w_.size() != p.size()) {
    w_.resize(p.size());
    for (Eigen::Index i = 0; i < w_.size(); ++i) w_[i] = 1 + 0.5 * std::sin(1. + static_cast<double>(i));
  }
  double curvature = 0;
  for (int k = 0; k < 3; ++k) {
    w_.normalize();
    b.solve(w_, v_);
    const double length = v_.norm();
    if (!std::isfinite(length) || length == 0) return false;
    curvature = w_.dot(v_) / (length * length);  // Rayleigh's quotient of v
    w_ = v_ / length;
  }
  lower_ = std::max(lower_, lambda_ - curvature);
  // |p + t w| = radius, the root of smaller size.
  const double along = p.dot(w_), rest = radius * radius - p.squaredNorm();
  const double root = std::sqrt(along * along + rest);
  const double t = along > 0 ? rest / (along + root) : rest / (along - root);
  if (!(t * t * curvature <= 0.1 * (lambda_ * radius * radius - g.dot(p)))) return false;
  p += t * w_;
  return true;
}

TrustRegionStep::Result TrustRegionStep::find(SymmetricSolver& b, const Eigen::VectorXd& g, double radius,
                                              Eigen::VectorXd& p) {
  Result result;
  lambda_ = lower_ = 0;
  upper_ = g.norm() / radius + b.norm();
  w_.resize(0);
  constexpr int most = 60;
  for (; result.factorisations < most;) {
    const Inertia inertia = b.factorise(lambda_);
    if (++result.factorisations == 1) result.negative = inertia.negative;
    if (!inertia.is_positive()) {
      lower_ = std::max(lower_, lambda_);
      if (inertia.negative > 0) {
        const double curvature = b.negative_direction(w_), square = w_.squaredNorm();
        if (std::isfinite(square)) lower_ = std::max(lower_, lambda_ - curvature / square);
      }
      const bool first = result.factorisations == 1;
      pick();
      // The multiplier of the last step is a good initial guess.
      if (first && last_ > lower_ && last_ < upper_) lambda_ = last_;
      if (!(upper_ > lower_)) upper_ = 2 * lower_ + b.norm() * 1e-15;
      continue;
    }
    b.solve(g, p);
    p = -p;
    result.length = p.norm();
    result.found = std::isfinite(result.length);
    if (!result.found) break;
    result.multiplier = lambda_;
    if (result.length <= radius) {
      if (lambda_ == 0 || result.length >= 0.9 * radius) break;
      upper_ = lambda_;
      if (add_null_vector(b, g, radius, p)) break;
    } else {
      if (result.length <= 1.1 * radius) break;
      lower_ = std::max(lower_, lambda_);
    }
    if (upper_ - lower_ <= 1e-14 * upper_) break;
    next(radius, result.length, b, p);
  }
  if (!result.found) return result;
  // If the iteration limit was reached, p may be too long.
  result.length = p.norm();
  if (result.length > 1.2 * radius) {
    p *= radius / result.length;
    result.length = radius;
  }
  b.multiply(p, v_);
  result.decrease = -(g.dot(p) + p.dot(v_) / 2);
  last_ = result.multiplier;
  return result;
}

namespace {

constexpr double shortest_radius = 1e-15;  // radius over |S x|, or over the first one

void check(const EnergyTrustRegion& method, const Equations& equations, const Eigen::VectorXd& x) {
  require_size("energy-trust-region", equations, x);
  if (method.scale.size() > 0 && !(method.scale.size() == x.size() && (method.scale.array() > 0).all()))
    throw std::invalid_argument("energy-trust-region: scale has another size than x, or is not positive");
  if (!(method.radius >= 0 && std::isfinite(method.radius)))
    throw invalid_argument("energy-trust-region: radius = {}; it must be 0 or positive", method.radius);
  if (method.iterations < 0)
    throw invalid_argument("energy-trust-region: iterations = {}; it must be 0 or positive",
                           method.iterations);
}

class Minimisation {
 public:
  Minimisation(const EnergyTrustRegion& method, Potential& equations, Eigen::VectorXd& x,
               const Observer& observer)
      : method_(method), equations_(equations), observer_(observer), x_(x), f_(x.size()) {}

  Report run() {
    Outcome outcome = start();
    while (outcome == Outcome::success) {
      if (is_polishing_due()) {
        const Polish end = polish();
        if (end == Polish::done) break;
        if (end == Polish::interrupted) outcome = Outcome::interrupted;
        if (outcome != Outcome::success) break;
      }
      outcome = step();
    }
    return finish(outcome);
  }

 private:
  enum class Polish : std::uint8_t { done, no_minimum, interrupted };

  Outcome start() {
    energy_ = equations_.energy(x_);
    if (!linearise(x_) || !std::isfinite(energy_)) return Outcome::non_finite;
    report_.first = report_.least = report_.last;
    scale_ = method_.scale.size() > 0 ? method_.scale : scale_of(diagonal_of(equations_));
    solver_.take_from(equations_, scale_);
    g_ = f_.cwiseQuotient(scale_);
    radius_ = first_radius_ = method_.radius > 0 ? method_.radius : descent();
    if (!see()) return Outcome::interrupted;
    plan();
    return planned_.found ? Outcome::success : Outcome::non_finite;
  }

  /// Length of the minimising step along -g; if the curvature along g is not positive, |B| replaces it.
  double descent() {
    solver_.multiply(g_, p_);
    const double square = g_.squaredNorm(), curvature = g_.dot(p_);
    const double bound = solver_.norm();
    if (square > 0 && curvature > 1e-3 * bound * square) return square / curvature * std::sqrt(square);
    if (square > 0 && bound > 0) return std::sqrt(square) / bound;
    return 1e-3;  // at a stationary point the model gives no length; the radius adapts
  }

  /// Evaluates F and B at @p x. @return false if not finite
  bool linearise(const Eigen::VectorXd& x) {
    equations_.residual(x, f_);
    ++report_.statistics.right_hand_sides;
    report_.last = f_.norm();
    report_.least =
        report_.statistics.right_hand_sides == 1 ? report_.last : std::min(report_.least, report_.last);
    if (!std::isfinite(report_.last)) return false;
    equations_.linearise(x);
    ++report_.statistics.jacobians;
    if (scale_.size() == 0) return true;
    solver_.take_from(equations_, scale_);
    g_ = f_.cwiseQuotient(scale_);
    return solver_.is_finite();
  }

  bool see() { return !observer_ || observer_({seen_, static_cast<double>(seen_++), x_, f_, report_.last}); }

  /// Computes the step at x_ for the current radius.
  void plan() {
    planned_ = step_.find(solver_, g_, radius_, p_);
    report_.statistics.factorisations += planned_.factorisations;
  }

  [[nodiscard]] double noise() {
    if (noise_at_ != report_.statistics.steps) {
      noise_ = rounding_of_energy(equations_, x_, energy_, trial_);
      noise_at_ = report_.statistics.steps;
    }
    return noise_;
  }

  /// Is p_ Newton's step, with a predicted decrease of V too small to verify?
  [[nodiscard]] bool is_polishing_due() {
    if (planned_.multiplier > 0 || report_.statistics.steps < no_polish_before_) return false;
    return planned_.decrease <= 1e-10 * descended_ || planned_.decrease <= 32 * noise();
  }

  Outcome step() {
    if (report_.statistics.steps + report_.statistics.rejected >= method_.iterations)
      return Outcome::step_limit;
    const double size = scale_.cwiseProduct(x_).norm();
    if (planned_.decrease <= 32 * noise()) {
      // The decrease is below rounding. If the step is on the boundary, enlarge the radius.
      if (planned_.multiplier == 0 || rejected_at_ == report_.statistics.steps ||
          radius_ > 1e3 * (size + first_radius_))
        return Outcome::not_converged;
      radius_ *= 4;
      ++report_.statistics.rejected;
      plan();
      return planned_.found ? Outcome::success : Outcome::not_converged;
    }
    trial_ = x_ + p_.cwiseQuotient(scale_);
    const double energy = equations_.energy(trial_), actual = energy_ - energy;
    const double ratio = std::isfinite(energy) ? (actual + noise()) / (planned_.decrease + noise()) : -1;
    if (ratio > 1e-4) {
      x_.swap(trial_);
      if (linearise(x_)) return accept(energy, actual, ratio);
      x_.swap(trial_);
      (void)linearise(x_);
    }
    ++report_.statistics.rejected;
    rejected_at_ = report_.statistics.steps;
    radius_ = 0.25 * planned_.length;
    if (!(radius_ > shortest_radius * std::max(size, 1e-6 * first_radius_)))
      return std::isfinite(energy) ? Outcome::not_converged : Outcome::non_finite;
    plan();
    return Outcome::success;
  }

  Outcome accept(double energy, double actual, double ratio) {
    ++report_.statistics.steps;
    energy_ = energy;
    descended_ += std::max(0., actual);
    if (ratio < 0.25)
      radius_ = 0.5 * planned_.length;
    else if (ratio > 0.7 && planned_.length > 0.8 * radius_)
      radius_ = (ratio > 0.9 && ratio < 1.1 ? 3 : 2) * radius_;
    if (!see()) return Outcome::interrupted;
    plan();
    return planned_.found ? Outcome::success : Outcome::not_converged;
  }

  //! [increments at the floor]
  /// Newton's iteration from x_ with first step p_. Restores x_, F and B unless it succeeds.
  Polish polish() {
    kept_ = x_;
    double before = HUGE_VAL;
    for (int k = 0; k < 100; ++k) {
      const double length = p_.norm(), size = scale_.cwiseProduct(x_).norm();
      if (length <= 4 * eps * size || (length > 0.9 * before && is_at_floor(length, size)))
        return Polish::done;
      if (length > 0.9 * before) break;
      before = length;
      x_ += p_.cwiseQuotient(scale_);
      const bool finite = linearise(x_);
      ++report_.statistics.newton_iterations;
      ++report_.statistics.factorisations;
      if (!finite) break;
      if (!solver_.factorise().is_positive()) {
        if (go_on_from_saddle()) return Polish::no_minimum;
        break;
      }
      if (!see()) return Polish::interrupted;
      solver_.solve(g_, p_);
      p_ = -p_;
    }
    x_ = kept_;
    (void)linearise(x_);
    plan();
    no_polish_before_ = report_.statistics.steps + 1;
    return Polish::no_minimum;
  }

  /// Continues from an iterate at which B is not positive definite and V agrees within rounding: next to a
  /// limit point, V may decrease further from here. @return false if V is greater than that
  bool go_on_from_saddle() {
    const double energy = equations_.energy(x_);
    if (!(energy <= energy_ + 32 * rounding_of_energy(equations_, kept_, energy_, trial_))) return false;
    ++report_.statistics.steps;
    energy_ = energy;
    no_polish_before_ = report_.statistics.steps + 1;
    plan();
    return planned_.found;
  }

  /// Is an increment of this length due to rounding? Compares with Newton's increment for the change of F
  /// under two random perturbations of x in its last digits.
  bool is_at_floor(double length, double size) {
    const double rounding = rounding_of_residual(equations_, x_, f_, [&](const Eigen::VectorXd& change) {
      change_ = change.cwiseQuotient(scale_);
      solver_.solve(change_, trial_);
      return trial_.norm();
    });
    report_.statistics.right_hand_sides += 2;
    return length <= 64 * std::max(rounding, eps * size);
  }
  //! [increments at the floor]

  Report finish(Outcome outcome) {
    if (outcome == Outcome::success) {
      equations_.residual(x_, f_);  // for equations_.status(), which refers to the last evaluation
      if (equations_.status().outcome() == Outcome::wrong_branch) report_.status = equations_.status();
    } else {
      report_.status = Status::failure(outcome, sentence(outcome));
    }
    return std::move(report_);
  }

  [[nodiscard]] std::string sentence(Outcome outcome) const {
    const std::string place = fmt::format(
        "energy-trust-region: after {} steps ({} rejected), with V = {:.6g}, |F| = {:.3g}, radius {:.3g}",
        report_.statistics.steps, report_.statistics.rejected, energy_, report_.last, radius_);
    const std::string why = equations_.status().ok() ? "" : " (" + equations_.status().sentence() + ")";
    switch (outcome) {
      case Outcome::non_finite:
        return place + ", V, F or its derivative is not finite" + why + "; start elsewhere";
      case Outcome::not_converged:
        return place +
               ", V cannot decrease by more than its rounding, and the point is not a minimum to rounding "
               "(it is degenerate); start elsewhere or change the load slightly";
      case Outcome::interrupted: return place + ", stopped by the observer";
      default: return place + ", the allowed steps are used up; allow more, or start closer";
    }
  }

  const EnergyTrustRegion& method_;
  Potential& equations_;
  const Observer& observer_;
  Eigen::VectorXd& x_;
  Eigen::VectorXd f_, g_, p_, scale_, trial_, kept_, change_;
  SymmetricSolver solver_;
  TrustRegionStep step_;
  TrustRegionStep::Result planned_;
  Report report_;
  double energy_ = 0, radius_ = 0, first_radius_ = 0, descended_ = 0, noise_ = 0;
  std::int64_t noise_at_ = -1, rejected_at_ = -1, no_polish_before_ = 0, seen_ = 0;
};

}  // namespace

Report find_root(const EnergyTrustRegion& method, Potential& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  check(method, equations, x);
  return Minimisation(method, equations, x, observer).run();
}

}  // namespace nlmech::algebraic
