#include "nlmech/algebraic/newton/trust_region_step.hpp"

#include <algorithm>
#include <cmath>

namespace nlmech::algebraic {

/// A point between the bounds, nearer to the lower one.
void TrustRegionStep::pick() {
  lambda_ = std::max(std::sqrt(std::max(lower_, 0.) * upper_), lower_ + 0.01 * (upper_ - lower_));
}

/// Newton's iteration for 1/|p| = 1/radius: it comes from below lambda without overshooting.
void TrustRegionStep::next(double radius, double length, const SymmetricSolver& b, const Eigen::VectorXd& p) {
  b.solve(p, v_);
  const double slope = p.dot(v_);
  lambda_ += length * length / slope * (length - radius) / radius;
  if (!(lambda_ > lower_ && lambda_ < upper_)) pick();
}

/// p is inside the ball though lambda > 0: is it, with a vector of small curvature added, good enough?
bool TrustRegionStep::add_null_vector(const SymmetricSolver& b, const Eigen::VectorXd& g, double radius,
                                      Eigen::VectorXd& p) {
  // Inverse iteration, from a direction of negative curvature if one has been met.
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
      // The last step's multiplier is a good guess for this one's.
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
  // After the last of too many iterations p may be too long.
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

}  // namespace nlmech::algebraic
