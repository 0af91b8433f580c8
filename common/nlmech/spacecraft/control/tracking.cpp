#include "nlmech/spacecraft/control/tracking.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/spacecraft/plant/gauss_rule.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

double binomial(int n, int k) {
  double b = 1;
  for (int i = 1; i <= k; ++i) b = b * (n - k + i) / i;
  return b;
}

}  // namespace

SmoothTurn::SmoothTurn(double angle, double duration, int smoothness)
    : angle_(angle), duration_(duration), smoothness_(smoothness) {
  if (!std::isfinite(angle)) throw invalid_argument("SmoothTurn: the angle is {:g}", angle);
  if (!(duration > 0) || !std::isfinite(duration))
    throw invalid_argument("SmoothTurn: the duration is {:g}; it must be positive", duration);
  if (smoothness < 1 || smoothness > 6)
    throw invalid_argument("SmoothTurn: smoothness {}; 1 to 6 are possible", smoothness);
  // r' is proportional to x^m (1 - x)^m, x = t/T: integrated term by term, scaled to r(T) = angle.
  const int m = smoothness;
  coefficients_.assign(2 * static_cast<std::size_t>(m) + 2, 0);
  double total = 0;
  for (int k = 0; k <= m; ++k) {
    const double c = (k % 2 == 0 ? 1 : -1) * binomial(m, k) / (m + k + 1);
    coefficients_[static_cast<std::size_t>(m + k) + 1] = c;
    total += c;
  }
  for (double& c : coefficients_) c *= angle / total;
}

double SmoothTurn::polynomial(double time, int order) const {
  const double x = time / duration_;
  double sum = 0;
  for (std::size_t k = coefficients_.size(); k-- > static_cast<std::size_t>(order);) {
    double factor = coefficients_[k];
    for (int i = 0; i < order; ++i) factor *= static_cast<double>(k) - i;
    sum = sum * x + factor;
  }
  for (int i = 0; i < order; ++i) sum /= duration_;
  return sum;
}

double SmoothTurn::value(double time, int order) const {
  if (time <= 0) return order <= smoothness_ || time < 0 ? 0 : polynomial(0, order);
  if (time >= duration_) return order == 0 ? angle_ : 0;
  return polynomial(time, order);
}

Tracking::Tracking(const ClosedLoop& loop, const SmoothTurn& turn, TrackingLaw law,
                   std::span<const double> places, const ResidueOptions& options)
    : turn_(turn) {
  const Gains& g = loop.gains();
  if (!(g.k1 > 0)) throw invalid_argument("Tracking: k1 = {:g}; it must be positive", g.k1);
  // Its weights are k1/(p P') for theta and k1 g_3/(p P') for y.
  const TimeResponse step = step_response(loop, 1, places, options);
  status_ = step.status;
  const bool fed = law == TrackingLaw::feedforward;
  const int smooth = std::min(turn.smoothness() + 1, 4);
  error_order_ = fed ? smooth : 1;
  deflection_order_ = fed ? smooth : 2;
  const double rigid = loop.parameters().hub_inertia + loop.kappa() * loop.parameters().appendage_inertia();
  for (const double x : places) {
    const double limit = loop.plant().static_deflection(x) * loop.parameters().total_inertia();
    quasi_static_.push_back(deflection_order_ > 2 ? limit : 0);
  }
  for (std::size_t k = 0; k < step.theta.poles().size(); ++k) {
    const Complex p = step.theta.poles()[k];
    // (theta - r)/r = (N - P)/P with N = k1, or N = P of the rigid spacecraft.
    const Complex numerator = fed ? (p * p * rigid + g.k3 * p + g.k1) / g.k1 : Complex(1);
    Term term{p, numerator * step.theta.weights()[k], {}};
    for (int i = 1; i < error_order_; ++i) term.error /= p;
    for (std::size_t i = 0; i < places.size(); ++i) {
      Complex w = numerator * step.deflection[i].weights()[k];
      for (int j = 1; j < deflection_order_; ++j) w /= p;
      term.deflection.push_back(w);
    }
    terms_.push_back(std::move(term));
  }
}

struct Tracking::Course {
  static constexpr int pieces = 8;

  Course(const SmoothTurn& turn, double at) : time(at), end(std::min(at, turn.duration())) {
    for (std::size_t i = 0; i < turn.coefficients_.size(); ++i) {
      at_begin.push_back(turn.polynomial(0, static_cast<int>(i)));
      at_end.push_back(turn.polynomial(end, static_cast<int>(i)));
    }
    const double half = end / pieces / 2;
    points.reserve(pieces * gauss_rule.size());
    for (int i = 0; i < pieces; ++i) {
      for (const GaussPoint& g : gauss_rule) {
        const double tau = (2 * i + 1 + g.place) * half;
        points.push_back({tau, g.weight * half, turn.polynomial(tau, 1)});
      }
    }
  }

  /// r' at a point of Gauss's rule.
  struct Point {
    double tau, weight, rate;
  };
  double time, end;                      ///< the turn ends before, or is cut there
  std::vector<double> at_begin, at_end;  ///< r and its derivatives
  std::vector<Point> points;
};

Complex Tracking::convolution(Complex p, const Course& course, int order) const {
  const double end = course.end;
  Complex sum = 0;
  if (std::abs(p) * end > 20) {
    // By parts: a polynomial's derivatives end.
    const Complex decay = std::exp(p * end);
    Complex power = p;
    for (auto i = static_cast<std::size_t>(order); i < course.at_end.size(); ++i) {
      sum += (decay * course.at_begin[i] - course.at_end[i]) / power;
      power *= p;
    }
  } else {
    // Gauss's rule with 10 points on 8 pieces, |p h| <= 2.5: the remainder is below rounding. Of r', which
    // has one sign: higher derivatives would cancel for a short turn. Their integrals follow by parts.
    for (const Course::Point& g : course.points) sum += g.weight * std::exp(p * (end - g.tau)) * g.rate;
    for (int i = 1; i < order; ++i) sum = turn_.value(end, i) + p * sum;
  }
  return course.time > end ? sum * std::exp(p * (course.time - end)) : sum;
}

TrackedMotion Tracking::at(double time) const {
  if (!(time >= 0) || !std::isfinite(time))
    throw invalid_argument("Tracking: time {:g}; it must be at least 0", time);
  const Course course(turn_, time);
  double error = 0, rate = 0;
  std::vector<double> y(quasi_static_.size(), 0);
  for (std::size_t k = terms_.size(); k-- > 0;) {
    const Term& term = terms_[k];
    const Complex driven = convolution(term.pole, course, error_order_);
    error += 2 * (term.error * driven).real();
    rate += 2 * (term.error * term.pole * driven).real();
    const Complex bending =
        deflection_order_ == error_order_ ? driven : convolution(term.pole, course, deflection_order_);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += 2 * (term.deflection[i] * bending).real();
  }
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += quasi_static_[i] * turn_.value(time, 2);
  // With the regulator the weights add up to -1, so that r' drops out of theta'.
  const double reference = error_order_ == 1 ? 0 : turn_.value(time, 1);
  return {turn_.value(time) + error, reference + rate, error, std::move(y)};
}

}  // namespace nlmech::spacecraft
