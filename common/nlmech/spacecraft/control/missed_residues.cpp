#include "nlmech/spacecraft/control/missed_residues.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "nlmech/spacecraft/plant/gauss_rule.hpp"
#include "nlmech/spacecraft/plant/jet.hpp"

namespace nlmech::spacecraft {
namespace {

constexpr double widest = 0.75 * std::numbers::pi, growth = 4;
constexpr int pieces = 17;

/// Integrals of F ds and of F (s - centre) ds along a line.
struct Moments {
  Complex zeroth = 0, first = 0;
  double size = 0;  ///< the integral of |F (s - centre) ds|, against which roundings count
};
Moments operator+(const Moments& a, const Moments& b) {
  return {a.zeroth + b.zeroth, a.first + b.first, a.size + b.size};
}
Moments operator-(const Moments& a, const Moments& b) {
  return {a.zeroth - b.zeroth, a.first - b.first, a.size + b.size};
}

/// One sector and its boundaries.
class Sector {
 public:
  Sector(const std::function<Complex(Complex)>& transform, const SectorBoundary& boundary)
      : transform_(transform), boundary_(boundary) {}

  /// From the real axis along the shape of the contour, @p scale times as far out.
  Moments arc(double scale) {
    const auto point = [&](double angle) { return on_arc(angle, scale); };
    return line(0, widest / 3, point) + line(widest / 3, 2 * widest / 3, point) +
           line(2 * widest / 3, widest, point);
  }
  /// Outwards from the arc of @p scale to the next, by the logarithm of the distance.
  Moments ray(double angle, double scale, bool finely) {
    const double from = std::log(boundary_.at(angle) * scale), length = std::log(growth);
    const Complex direction = std::polar(1., angle);
    const auto point = [&](double u) {
      const Complex s = std::exp(u) * direction;
      return Point{s, s};
    };
    if (!finely) return line(from, from + length, point);
    return line(from, from + length / 2, point) + line(from + length / 2, from + length, point);
  }
  [[nodiscard]] bool finite() const { return finite_; }
  [[nodiscard]] Complex last() const { return last_; }

 private:
  /// A place, less the centre, and its derivative by the parameter.
  struct Point {
    Complex s, slope;
  };
  [[nodiscard]] Point on_arc(double angle, double scale) const {
    const Complex turn = std::polar(scale, angle);
    return {boundary_.at(angle) * turn, Complex(boundary_.slope(angle), boundary_.at(angle)) * turn};
  }
  template <class Place>
  Moments line(double from, double to, const Place& place) {
    const double middle = (from + to) / 2, half = (to - from) / 2;
    Moments sum;
    for (const GaussPoint& g : gauss_rule) {
      const Point p = place(middle + g.place * half);
      const Complex value = transform_(boundary_.centre + p.s);
      if (!is_finite(value) && finite_) {
        finite_ = false;
        last_ = boundary_.centre + p.s;
      }
      const Complex term = g.weight * half * value * p.slope;
      sum.zeroth += term;
      sum.first += term * p.s;
      sum.size += std::abs(term * p.s);
    }
    return sum;
  }

  const std::function<Complex(Complex)>& transform_;
  SectorBoundary boundary_;
  bool finite_ = true;
  Complex last_ = 0;
};

}  // namespace

MissedResidues missed_residues(const std::function<Complex(Complex)>& transform, double time,
                               const SectorBoundary& boundary) {
  MissedResidues missed;
  Sector sector(transform, boundary);
  double scale = 1, largest = 0;
  Moments inner = sector.arc(scale);
  for (int i = 0; i < pieces; ++i, scale *= growth) {
    const Moments outer = sector.arc(growth * scale);
    const Moments around = sector.ray(0, scale, false) + outer - sector.ray(widest, scale, true) - inner;
    if (!sector.finite()) {
      missed.amplitude = std::numeric_limits<double>::quiet_NaN();
      missed.near = sector.last();
      return missed;
    }
    const double size = boundary.at(widest) * growth * scale;
    // A pole and its conjugate: twice the residue. Of a double pole, or of two that cancel, the other
    // integral times t; far out less, and nothing where it is its own rounding.
    const bool rounding = std::abs(around.first) < 1e-12 * around.size;
    const double grown = std::abs(around.first) / size * (rounding ? 1 : std::clamp(size * time, 1., 1000.));
    const double amplitude = std::max(std::abs(around.zeroth), grown) / std::numbers::pi;
    missed.amplitude += amplitude;
    if (amplitude > largest) {
      largest = amplitude;
      missed.near = boundary.centre + Complex(0, size / 2);
    }
    inner = outer;
  }
  return missed;
}

}  // namespace nlmech::spacecraft
