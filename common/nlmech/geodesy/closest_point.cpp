#include "nlmech/geodesy/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace nlmech::geodesy {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double no_gap = 1e-100;  // gaps below this count as a sphere

/// Cosine and sine of the eccentric angle of the closest point, measured from the major axis.
struct Eccentric {
  double along_major, along_minor;
};

/// A lower bound of the root of (P/(u+gap))^2 + (Q/u)^2 = 1; the root is at most about twice as large.
///
/// Either term alone is at most 1 at the root, hence u >= Q and u >= P - gap. Where both bounds are poor,
/// near the disc, write v = u/gap, beta = Q/gap, d = 1 - P/gap; the equation reads
///   beta^2 = v^2 (v + d) (1 + v + P/gap)/(1 + v)^2,
/// and the last quotient is at most 3 for P <= 2 gap. So v^2 (v + d) >= beta^2/3, and according as v >= d or
/// not, v^3 >= beta^2/6 or v^2 >= beta^2/(6 d).
double lower_bound(double Q, double gap, double beyond) {
  const double simple = std::max(Q, beyond);
  if (simple > gap / 8) return simple;
  const double beta = Q / gap, d = -beyond / gap;
  // 6^(-1/3) = 0.5503. Not the cube root of a square, which might underflow.
  const double root = std::cbrt(beta), cubic = 0.55 * root * root;
  return std::max(simple, gap * (d > cubic ? beta / std::sqrt(6 * d) : cubic));
}

/// Solves for the closest point in the first quadrant.
/// @param P,Q    major axis * coordinate along it, and minor axis * coordinate along that
/// @param beyond P - gap with a relative error of one rounding, which determines the accuracy near the edge
/// of the disc
///
/// The point at distance t on the normal is the given one where u = t + minor^2 satisfies
/// (P/(u+gap))^2 + (Q/u)^2 = 1; the closest point belongs to its only root u > 0. Newton's method is applied
/// to
///   psi(u) = ((P/(u+gap))^2 + (Q/u)^2)^(-1/2) - 1.
/// psi is increasing, and concave by Minkowski's inequality for the exponent -2, since it is the "norm" with
/// that exponent of two linear functions of u. The tangent of a concave function lies above it: from any u at
/// or below the root the iterates therefore rise to the root and never pass it. psi is nearly linear and the
/// first u is within a factor of about 2: two to five steps on average, at most seven. The iteration limit is
/// never reached; it only makes termination evident.
Eccentric closest(double P, double Q, double gap, double beyond) {
  constexpr double negligible = 1e-280;  // below, Q/u underflows; the limit Q -> 0 is as accurate
  if (Q < negligible) {
    if (beyond > 0) return {1, Q / beyond};
    return {P / gap, std::sqrt(-beyond / gap * (1 + P / gap))};  // on the disc (or segment): u = 0
  }
  double u = lower_bound(Q, gap, beyond);
  for (int n = 0; n < 30; ++n) {
    const double A = P / (u + gap), B = Q / u;
    // A^2 - 1 in factors keeps its digits where A is near 1, close to the edge of the disc.
    const double excess = (beyond - u) / (u + gap) * (A + 1) + B * B;
    const double norm2 = A * A + B * B, norm = std::sqrt(norm2);
    const double step = norm2 * excess / ((norm + 1) * (A * A / (u + gap) + B * B / u));
    u += step;
    // Convergence is quadratic: after a relative step of 1e-9 the error is rounding.
    if (!(step > 1e-9 * u)) break;
  }
  return {P / (u + gap), Q / u};
}

/// |a^2 - b^2| = a^2 |2f - f^2| to twice the working precision. Fused multiply-adds give the rounding errors
/// of the products; that of the difference follows from the larger term, 2f or f^2.
std::pair<double, double> gap_of(double a, double f) {
  const double square = f * f, square_low = std::fma(f, f, -square);
  const double e2 = 2 * f - square;
  const double lost = std::abs(2 * f) > square ? (2 * f - e2) - square : 2 * f - (e2 + square);
  const double e2_low = lost - square_low;
  const double a2 = a * a, a2_low = std::fma(a, a, -a2);
  const double gap = a2 * e2, low = std::fma(a2, e2, -gap) + (a2 * e2_low + a2_low * e2);
  return e2 < 0 ? std::pair{-gap, -low} : std::pair{gap, low};
}

}  // namespace

ClosestPoint::ClosestPoint(const Ellipsoid& ellipsoid) : a_(ellipsoid.a()), b_(ellipsoid.b()) {
  const double larger = std::max(a_, b_), smaller = std::min(a_, b_);
  if (!std::isfinite(larger) || !(smaller >= std::numeric_limits<double>::min()) ||
      smaller < 1e-100 * larger) {
    throw std::invalid_argument(
        "ClosestPoint: semi-axes must be representable and of a ratio below 1e100, are " +
        std::to_string(a_) + " and " + std::to_string(b_));
  }
  scale_ = std::ldexp(1., -std::ilogb(larger));
  a_ *= scale_;
  b_ *= scale_;
  major_ = std::max(a_, b_);
  minor_ = std::min(a_, b_);
  std::tie(gap_, gap_low_) = gap_of(a_, ellipsoid.f());
}

GeodeticPoint ClosestPoint::operator()(const Cartesian& point) const noexcept {
  const auto [x, y, z] = point;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    return {{not_a_number, not_a_number, not_a_number}, Outcome::non_finite};
  }
  const double longitude = std::atan2(y, x);

  // For a sphere, and at distances where the ellipsoid is a point to rounding, the normal passes through the
  // centre. The power of two avoids overflow and underflow.
  const double extent = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (gap_ < no_gap || extent / 0x1p60 > 1 / scale_) {
    const double k = extent > 1 ? 0.25 : 0x1p60, r = std::hypot(x * k, y * k), R = std::hypot(r, z * k) / k;
    const double latitude = extent > 0 ? std::atan2(z * k, r) : std::copysign(std::numbers::pi / 2, z);
    return {{latitude, longitude, R - a_ / scale_},
            std::isfinite(R) ? Outcome::success : Outcome::non_finite};
  }

  const double r = std::hypot(x * scale_, y * scale_), zs = std::abs(z) * scale_;
  const bool oblate = a_ >= b_;
  const double along_major = oblate ? r : zs, along_minor = oblate ? zs : r;
  const double beyond = std::fma(major_, along_major, -gap_) - gap_low_;
  const Eccentric e = closest(major_ * along_major, minor_ * along_minor, gap_, beyond);
  const double cos_beta = oblate ? e.along_major : e.along_minor;
  const double sin_beta = oblate ? e.along_minor : e.along_major;

  // The normal is (b cos beta, a sin beta). Height by projection on it: an error of beta enters squared.
  const double normal_r = b_ * cos_beta, normal_z = a_ * sin_beta;
  const double height =
      ((r - a_ * cos_beta) * normal_r + (zs - b_ * sin_beta) * normal_z) / std::hypot(normal_r, normal_z);
  return {{std::copysign(std::atan2(normal_z, normal_r), z), longitude, height / scale_}, Outcome::success};
}

}  // namespace nlmech::geodesy
