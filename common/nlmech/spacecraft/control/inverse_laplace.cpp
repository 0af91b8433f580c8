#include "nlmech/spacecraft/control/inverse_laplace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/spacecraft/plant/gauss_rule.hpp"
#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

using std::numbers::pi;

void demand(bool right, const char* what, double value) {
  if (!right) throw invalid_argument("talbot: {} = {:g}", what, value);
}

void require_nodes(double time, int nodes) {
  demand(std::isfinite(time) && time > 0, "the time must be positive and finite; time", time);
  demand(nodes >= 2 && nodes <= 200, "2 to 200 nodes are possible; nodes", nodes);
}

/// The radius at which the contour of so many nodes crosses the real axis.
double contour_radius(double time, int nodes) { return 2. * nodes / (5 * time); }

Inverted contour_sum(const Transform& transform, double time, int nodes) {
  const auto not_finite = [time](Complex s) -> Inverted {
    return {0, failed_with(Outcome::non_finite,
                           "talbot at t = {:g}: the transform is not finite at s = {:g}{:+g}i; move the "
                           "contour by another number of nodes",
                           time, s.real(), s.imag())};
  };
  const double r = contour_radius(time, nodes);
  const Complex first = transform(r);
  if (!is_finite(first)) return not_finite(r);
  double sum = std::exp(r * time) * first.real() / 2;
  for (int k = 1; k < nodes; ++k) {
    const double angle = k * pi / nodes, cotangent = 1 / std::tan(angle);
    const Complex s(r * angle * cotangent, r * angle);
    const Complex value = transform(s);
    if (!is_finite(value)) return not_finite(s);
    const double sigma = angle + (angle * cotangent - 1) * cotangent;
    sum += (std::exp(s * time) * value * Complex(1, sigma)).real();
  }
  const double value = sum * r / nodes;
  if (std::isfinite(value)) return {value, {}};
  return {0, failed_with(Outcome::non_finite, "talbot at t = {:g}: the sum is not finite; use fewer nodes",
                         time)};
}

/// What is found outside the contour.
struct MissedResidues {
  double amplitude = 0;  ///< of the oscillations that are left out, at the start; NaN if F was not finite
  Complex near = 0;      ///< about where the largest of them lies, or where F is not finite
};

/// Integrals of F ds and of F s ds along a line.
struct Moments {
  Complex zeroth = 0, first = 0;
  double size = 0;  ///< the integral of |F s ds|, against which roundings count
};
Moments operator+(const Moments& a, const Moments& b) {
  return {a.zeroth + b.zeroth, a.first + b.first, a.size + b.size};
}
Moments operator-(const Moments& a, const Moments& b) {
  return {a.zeroth - b.zeroth, a.first - b.first, a.size + b.size};
}

/// The sector of 0 to 135 degrees beyond Talbot's contour, radius phi/sin phi.
class Sector {
 public:
  static constexpr double widest = 0.75 * pi;  ///< its angle
  static constexpr double growth = 4;          ///< of one piece of it over the one before
  static constexpr int pieces = 17;

  Sector(const Transform& transform, double radius) : transform_(transform), radius_(radius) {}

  /// The contour's distance from 0.
  [[nodiscard]] double boundary(double angle) const {
    return angle > 0 ? radius_ * angle / std::sin(angle) : radius_;
  }
  /// From the real axis along the shape of the contour, @p scale times as far out.
  Moments arc(double scale) {
    const auto point = [&](double angle) {
      const double s = std::sin(angle), slope = radius_ * (s - angle * std::cos(angle)) / (s * s);
      const Complex turn = std::polar(scale, angle);
      return Point{boundary(angle) * turn, Complex(slope, boundary(angle)) * turn};
    };
    return line(0, widest / 3, point) + line(widest / 3, 2 * widest / 3, point) +
           line(2 * widest / 3, widest, point);
  }
  /// Outwards from the arc of @p scale to the next, by the logarithm of the distance.
  Moments ray(double angle, double scale, int parts) {
    const double from = std::log(boundary(angle) * scale), length = std::log(growth) / parts;
    const Complex direction = std::polar(1., angle);
    const auto point = [&](double u) {
      const Complex s = std::exp(u) * direction;
      return Point{s, s};
    };
    Moments sum;
    for (int i = 0; i < parts; ++i) sum = sum + line(from + i * length, from + (i + 1) * length, point);
    return sum;
  }
  [[nodiscard]] bool finite() const { return finite_; }
  /// Where F is not finite.
  [[nodiscard]] Complex last() const { return last_; }

 private:
  /// A place and its derivative by the parameter.
  struct Point {
    Complex s, slope;
  };
  template <class Place>
  Moments line(double from, double to, const Place& place) {
    const double middle = (from + to) / 2, half = (to - from) / 2;
    Moments sum;
    for (const GaussPoint& g : gauss_rule) {
      const Point p = place(middle + g.place * half);
      const Complex value = transform_(p.s);
      if (!is_finite(value) && finite_) {
        finite_ = false;
        last_ = p.s;
      }
      const Complex term = g.weight * half * value * p.slope;
      sum.zeroth += term;
      sum.first += term * p.s;
      sum.size += std::abs(term * p.s);
    }
    return sum;
  }

  const Transform& transform_;
  double radius_;
  bool finite_ = true;
  Complex last_ = 0;
};

/// Sums of the residues of F beyond the contour: (1/2 pi i) times the integrals of F, and of F s, along the
/// boundaries of the pieces of the sector, by Gauss's rule.
///
/// A simple pole shows with its residue, wherever it lies up to 4^17 = 1.7e10 times the contour; a double
/// one, whose residue can be 0, by the integral of F s as far as |s| t = 1000, and beyond with a part of it
/// only. Where F is analytic there, quadrature leaves less than 1e-12 of the largest |F s|. Some 1100 values
/// of F.
MissedResidues missed_residues(const Transform& transform, double time, double radius) {
  MissedResidues missed;
  Sector sector(transform, radius);
  double scale = 1, largest = 0;
  Moments inner = sector.arc(scale);
  for (int i = 0; i < Sector::pieces; ++i, scale *= Sector::growth) {
    const Moments outer = sector.arc(Sector::growth * scale);
    const Moments around = sector.ray(0, scale, 1) + outer - sector.ray(Sector::widest, scale, 2) - inner;
    if (!sector.finite()) return {std::numeric_limits<double>::quiet_NaN(), sector.last()};
    const double size = sector.boundary(Sector::widest) * Sector::growth * scale;
    // A pole and its conjugate: twice the residue. Of a double pole, or of two that cancel, the other
    // integral times t; far out less, and nothing where it is its own rounding.
    const bool rounding = std::abs(around.first) < 1e-12 * around.size;
    const double grown = std::abs(around.first) / size * (rounding ? 1 : std::clamp(size * time, 1., 1000.));
    const double amplitude = std::max(std::abs(around.zeroth), grown) / pi;
    missed.amplitude += amplitude;
    if (amplitude > largest) {
      largest = amplitude;
      missed.near = Complex(0, size / 2);
    }
    inner = outer;
  }
  return missed;
}

/// Is nothing left out beyond the contour?
Status nothing_missed(const Transform& transform, double time, double radius, double allowed) {
  const MissedResidues missed = missed_residues(transform, time, radius);
  if (missed.amplitude <= allowed) return {};
  if (std::isnan(missed.amplitude)) {
    return failed_with(Outcome::not_converged,
                       "talbot at t = {:g}: the transform is not finite at s = {:g}{:+g}i, beyond the "
                       "frequencies of the sum, so that the value cannot be verified; use residues",
                       time, missed.near.real(), missed.near.imag());
  }
  return failed_with(Outcome::not_converged,
                     "talbot at t = {:g}: residues of up to {:.3g} lie beyond the frequencies of the sum, "
                     "about |s| = {:.1g}; use more nodes, or residues",
                     time, missed.amplitude, std::abs(missed.near));
}

}  // namespace

double talbot_sum(const Transform& transform, double time, int nodes) {
  require_nodes(time, nodes);
  return contour_sum(transform, time, nodes).value;
}

Inverted talbot(const Transform& transform, double time, const TalbotOptions& options) {
  require_nodes(time, options.nodes);
  demand(options.agreement > 0, "the agreement must be positive; agreement", options.agreement);
  demand(options.negligible >= 0, "what is negligible must not be below zero; negligible",
         options.negligible);
  Inverted first = contour_sum(transform, time, options.nodes);
  if (!first.status.ok()) return first;
  // With other nodes, on a contour that is wider by a quarter.
  const Inverted second = contour_sum(transform, time, options.nodes + std::max(2, options.nodes / 4));
  const double largest = std::max(std::abs(first.value), std::abs(second.value));
  const double allowed = std::max(options.negligible, options.agreement * largest);
  if (!second.status.ok()) {
    first.status = second.status;
  } else if (!(std::abs(first.value - second.value) <= allowed)) {
    first.status = failed_with(Outcome::not_converged,
                               "talbot at t = {:g}: two sums give {:.6g} and {:.6g}; use nodes whose "
                               "frequencies reach beyond the modes, residues for late times of a lightly "
                               "damped structure, or say which differences are negligible",
                               time, first.value, second.value);
  } else {
    first.status = nothing_missed(transform, time, contour_radius(time, options.nodes), allowed);
  }
  return first;
}

}  // namespace nlmech::spacecraft
