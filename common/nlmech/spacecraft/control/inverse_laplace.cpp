#include "nlmech/spacecraft/control/inverse_laplace.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/spacecraft/control/missed_residues.hpp"
#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

using std::numbers::pi;

void demand(bool right, const char* method, const char* what, double value) {
  if (!right) throw invalid_argument("{}: {} = {:g}", method, what, value);
}

void require_time(const char* method, double time) {
  demand(std::isfinite(time) && time > 0, method, "the time must be positive and finite; time", time);
}

Inverted not_finite(const char* method, double time, Complex s) {
  return {0, failed_with(Outcome::non_finite,
                         "{} at t = {:g}: the transform is not finite at s = {:g}{:+g}i; move the contour by "
                         "other nodes or another shift",
                         method, time, s.real(), s.imag())};
}

/// The value if it is a number.
Inverted checked(const char* method, double time, double value) {
  if (std::isfinite(value)) return {value, {}};
  return {0,
          failed_with(Outcome::non_finite,
                      "{} at t = {:g}: the sum is not finite; use fewer nodes or a smaller shift times time",
                      method, time)};
}

Status not_agreed(const char* method, double time, double first, double second) {
  return failed_with(Outcome::not_converged,
                     "{} at t = {:g}: two sums give {:.6g} and {:.6g}; use a degree or nodes whose "
                     "frequencies reach beyond the modes, residues for late times of a lightly damped "
                     "structure, or say which differences are negligible",
                     method, time, first, second);
}

/// Is nothing left out beyond the frequencies of a sum?
Status nothing_missed(const char* method, double time, const Transform& transform,
                      const SectorBoundary& boundary, double allowed) {
  const MissedResidues missed = missed_residues(transform, time, boundary);
  if (missed.amplitude <= allowed) return {};
  if (std::isnan(missed.amplitude)) {
    return failed_with(Outcome::not_converged,
                       "{} at t = {:g}: the transform is not finite at s = {:g}{:+g}i, beyond the "
                       "frequencies of the sum, so that the value cannot be verified; use residues",
                       method, time, missed.near.real(), missed.near.imag());
  }
  return failed_with(Outcome::not_converged,
                     "{} at t = {:g}: residues of up to {:.3g} lie beyond the frequencies of the sum, about "
                     "|s| = {:.1g}; use more nodes or a higher degree, or residues",
                     method, time, missed.amplitude, std::abs(missed.near));
}

/// The quotient-difference table's first row, the coefficients d of the continued fraction.
std::vector<Complex> continued_fraction(const std::vector<Complex>& a) {
  const std::size_t n = a.size() - 1;  // 2M
  std::vector<Complex> d(n + 1), q(n), e(n + 1, 0.);
  d[0] = a[0];
  for (std::size_t i = 0; i < n; ++i) q[i] = a[i + 1] / a[i];
  for (std::size_t r = 1; 2 * r <= n; ++r) {
    d[2 * r - 1] = -q[0];
    const std::size_t rows = n - 2 * r + 1;
    for (std::size_t i = 0; i < rows; ++i) e[i] = q[i + 1] - q[i] + e[i + 1];
    d[2 * r] = -e[0];
    for (std::size_t i = 0; i + 1 < rows; ++i) q[i] = q[i + 1] * e[i + 1] / e[i];
  }
  return d;
}

/// Its value at z, with the estimated remainder in place of the last term.
Complex fraction(const std::vector<Complex>& d, Complex z) {
  const std::size_t n = d.size() - 1;
  Complex a1 = 0, a = d[0], b1 = 1, b = 1;  // A_{i-2}, A_{i-1}; the same of B
  for (std::size_t i = 1; i <= n; ++i) {
    Complex step = d[i] * z;
    if (i == n) {
      const Complex h = (1. + z * (d[n - 1] - d[n])) / 2.;
      step = -h * (1. - std::sqrt(1. + z * d[n] / (h * h)));
    }
    const Complex next_a = a + step * a1, next_b = b + step * b1;
    a1 = a, a = next_a, b1 = b, b = next_b;
    const double size = std::max(std::abs(a), std::abs(b));
    if (size > 1e100) a1 /= size, a /= size, b1 /= size, b /= size;
  }
  return a / b;
}

/// With the half period @p scale times the time.
Inverted de_hoog_by(const Transform& transform, double time, const DeHoogOptions& options, double scale) {
  const double half_period = scale * time;
  const double shift = options.abscissa - std::log(options.tolerance) / (2 * half_period);
  std::vector<Complex> a(2 * static_cast<std::size_t>(options.degree) + 1);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Complex s(shift, static_cast<double>(k) * pi / half_period);
    a[k] = transform(s);
    if (!is_finite(a[k])) return not_finite("de_hoog", time, s);
  }
  a[0] /= 2.;
  const Complex sum = fraction(continued_fraction(a), std::polar(1., pi * time / half_period));
  return checked("de_hoog", time, std::exp(shift * time) / half_period * sum.real());
}

}  // namespace

namespace {

Inverted talbot_by(const Transform& transform, double time, int nodes) {
  const double r = 2. * nodes / (5 * time);
  const Complex first = transform(r);
  if (!is_finite(first)) return not_finite("talbot", time, r);
  double sum = std::exp(r * time) * first.real() / 2;
  for (int k = 1; k < nodes; ++k) {
    const double angle = k * pi / nodes, cotangent = 1 / std::tan(angle);
    const Complex s(r * angle * cotangent, r * angle);
    const Complex value = transform(s);
    if (!is_finite(value)) return not_finite("talbot", time, s);
    const double sigma = angle + (angle * cotangent - 1) * cotangent;
    sum += (std::exp(s * time) * value * Complex(1, sigma)).real();
  }
  return checked("talbot", time, sum * r / nodes);
}

void require_nodes(double time, int nodes) {
  require_time("talbot", time);
  demand(nodes >= 2 && nodes <= 200, "talbot", "2 to 200 nodes are possible; nodes", nodes);
}

void require_options(double time, const DeHoogOptions& options) {
  require_time("de_hoog", time);
  demand(options.degree >= 1 && options.degree <= 1000, "de_hoog", "the degree must be 1 to 1000; degree",
         options.degree);
  demand(options.tolerance > 0 && options.tolerance < 1, "de_hoog",
         "the tolerance must be between 0 and 1; tolerance", options.tolerance);
  demand(std::isfinite(options.abscissa), "de_hoog", "the abscissa must be finite; abscissa",
         options.abscissa);
  demand(std::isfinite(options.scale) && options.scale > 0.5, "de_hoog", "the scale must be above 1/2; scale",
         options.scale);
  demand(options.agreement > 0, "de_hoog", "the agreement must be positive; agreement", options.agreement);
  demand(options.negligible >= 0, "de_hoog", "what is negligible must not be below zero; negligible",
         options.negligible);
}

/// The first sum, with the status of both and of what lies beyond them.
Inverted verified(const char* method, const Transform& transform, double time, Inverted first,
                  const Inverted& second, double agreement, double negligible,
                  const SectorBoundary& boundary) {
  const double largest = std::max(std::abs(first.value), std::abs(second.value));
  const double allowed = std::max(negligible, agreement * largest);
  if (!second.status.ok())
    first.status = second.status;
  else if (!(std::abs(first.value - second.value) <= allowed))
    first.status = not_agreed(method, time, first.value, second.value);
  else
    first.status = nothing_missed(method, time, transform, boundary, allowed);
  return first;
}

}  // namespace

double talbot_sum(const Transform& transform, double time, int nodes) {
  require_nodes(time, nodes);
  return talbot_by(transform, time, nodes).value;
}

Inverted talbot(const Transform& transform, double time, const TalbotOptions& options) {
  require_nodes(time, options.nodes);
  demand(options.agreement > 0, "talbot", "the agreement must be positive; agreement", options.agreement);
  demand(options.negligible >= 0, "talbot", "what is negligible must not be below zero; negligible",
         options.negligible);
  Inverted first = talbot_by(transform, time, options.nodes);
  if (!first.status.ok()) return first;
  // Of other nodes, and on a contour that is wider by a quarter.
  const Inverted second = talbot_by(transform, time, options.nodes + std::max(2, options.nodes / 4));
  return verified("talbot", transform, time, std::move(first), second, options.agreement, options.negligible,
                  {.centre = 0, .radius = 2. * options.nodes / (5 * time), .talbot = true});
}

double de_hoog_sum(const Transform& transform, double time, const DeHoogOptions& options) {
  require_options(time, options);
  return de_hoog_by(transform, time, options, options.scale).value;
}

Inverted de_hoog(const Transform& transform, double time, const DeHoogOptions& options) {
  require_options(time, options);
  Inverted first = de_hoog_by(transform, time, options, options.scale);
  if (!first.status.ok()) return first;
  // Of two more, the one that is farther off.
  Inverted second = de_hoog_by(transform, time, options, 1.1 * options.scale);
  const Inverted third = de_hoog_by(transform, time, options, 1.23 * options.scale);
  if (second.status.ok() &&
      (!third.status.ok() || std::abs(third.value - first.value) > std::abs(second.value - first.value)))
    second = third;
  const double highest = 2 * options.degree * pi / (options.scale * time);
  return verified("de_hoog", transform, time, std::move(first), second, options.agreement, options.negligible,
                  {.centre = options.abscissa, .radius = highest / 4, .talbot = false});
}

std::vector<Inverted> bromwich(const Transform& transform, std::span<const double> times,
                               const BromwichOptions& options) {
  const double half_period = options.half_period;
  demand(std::isfinite(half_period) && half_period > 0, "bromwich",
         "the half period must be positive; half period", half_period);
  demand(std::isfinite(options.shift), "bromwich", "the shift must be finite; shift", options.shift);
  demand(options.frequency * half_period >= pi && options.frequency * half_period < 1e9, "bromwich",
         "the highest frequency must hold 1 to 3e8 multiples of pi/T; frequency", options.frequency);
  demand(options.agreement > 0, "bromwich", "the agreement must be positive; agreement", options.agreement);
  for (const double t : times)
    demand(t > 0 && t < 2 * half_period, "bromwich", "times lie between 0 and twice the half period; time",
           t);
  const auto terms = static_cast<long>(options.frequency * half_period / pi);
  // Every second term makes a sum of half the period, whose aliasing is the root of that of the whole.
  std::vector<double> sums(times.size(), 0), halves(times.size(), 0);
  for (long k = 0; k <= terms; ++k) {
    const Complex s(options.shift, static_cast<double>(k) * pi / half_period);
    const Complex value = transform(s) * (k == 0 ? 0.5 : 1.);
    if (!is_finite(value)) {
      return std::vector<Inverted>(times.size(), not_finite("bromwich", times.empty() ? 0 : times[0], s));
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double angle = s.imag() * times[i];
      const double term = value.real() * std::cos(angle) - value.imag() * std::sin(angle);
      sums[i] += term;
      if (k % 2 == 0) halves[i] += 2 * term;
    }
  }
  std::vector<Inverted> inverted;
  double largest = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double factor = std::exp(options.shift * times[i]) / half_period;
    inverted.push_back(checked("bromwich", times[i], factor * sums[i]));
    largest = std::max(largest, std::abs(inverted.back().value));
  }
  if (times.empty()) return inverted;
  const double allowed = options.agreement * largest;
  const Status beyond = nothing_missed("bromwich", *std::max_element(times.begin(), times.end()), transform,
                                       {.centre = 0, .radius = options.frequency, .talbot = false}, allowed);
  const double last =
      std::abs(transform(Complex(options.shift, static_cast<double>(terms) * pi / half_period)));
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!inverted[i].status.ok()) continue;
    const double rest = last * std::exp(options.shift * times[i]) / (pi * times[i]);
    const double half = std::exp(options.shift * times[i]) / half_period * (halves[i] - sums[i]);
    const double aliased =
        std::max(std::exp(-2 * options.shift * half_period) * largest, 4 * half * half / largest);
    inverted[i].status = beyond;
    if (beyond.ok() && !(rest + aliased <= allowed)) {
      inverted[i].status =
          failed_with(Outcome::not_converged,
                      "bromwich at t = {:g}: what is left out may be {:.3g} beyond the highest frequency, "
                      "and {:.3g} by aliasing; raise the frequency, or the shift times the half period",
                      times[i], rest, aliased);
    }
  }
  return inverted;
}

}  // namespace nlmech::spacecraft
