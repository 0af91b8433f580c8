#include "nlmech/spacecraft/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "nlmech/spacecraft/poles.hpp"

namespace nlmech::spacecraft {
namespace {

/// Weights of all signals for one exponential: theta, torque, then y at each place.
using Weights = std::vector<Complex>;

/// Exponentials common to all signals.
struct Terms {
  std::vector<Complex> poles;
  std::vector<Weights> weights;  ///< one a pole
};

void require_options(const ResidueOptions& o) {
  if (o.pairs < 0 || o.pairs > 5000 || o.most < 1 || o.most > 5000)
    throw std::invalid_argument(
        fmt::format("residues: pairs = {}, most = {}; up to 5000 are possible", o.pairs, o.most));
  if (!(o.tolerance > 0)) throw std::invalid_argument(fmt::format("residues: tolerance = {:g}", o.tolerance));
}

void require_places(const Plant& plant, std::span<const double> places, double amplitude) {
  for (const double x : places) plant.appendage().require_place(x);
  if (!std::isfinite(amplitude))
    throw std::invalid_argument(fmt::format("residues: the amplitude {:g} is not finite", amplitude));
}

/// Bound of what the terms after the last leave out, if moduli fall like a power of their number that is at
/// least 1.5 and at most @p order.
double remainder(const std::vector<double>& moduli, double order) {
  const std::size_t n = moduli.size();
  if (n < 8) {
    double sum = 0;
    for (const double m : moduli) sum += m;
    return sum;
  }
  const auto largest = [&](std::size_t a, std::size_t b) {
    return *std::max_element(moduli.begin() + static_cast<std::ptrdiff_t>(a),
                             moduli.begin() + static_cast<std::ptrdiff_t>(b));
  };
  const double earlier = largest(n / 2, 3 * n / 4), later = largest(3 * n / 4, n);
  if (later == 0) return 0;
  // From the middle of one quarter to that of the next: 7/5 times the number.
  const double seen = std::log(std::max(earlier, later) / later) / std::log(1.4);
  const double power = std::clamp(seen, 1.5, order);
  // later * (3n/4)^power is at least the law's constant.
  const double last = later * std::pow(0.75, power);
  return 2 * 2 * last * static_cast<double>(n) / (power - 1);
}

/// Moduli of one signal's weights, times |p|^order.
std::vector<double> moduli(const Terms& terms, std::size_t signal, int order) {
  std::vector<double> m;
  for (std::size_t k = 0; k < terms.poles.size(); ++k)
    m.push_back(std::abs(terms.weights[k][signal]) * std::pow(std::abs(terms.poles[k]), order));
  return m;
}

ResidueBounds bounds_of(const Terms& terms, std::size_t places) {
  ResidueBounds b;
  b.theta = remainder(moduli(terms, 0, 0), 6);
  b.theta_dot = remainder(moduli(terms, 0, 1), 4);
  b.torque = remainder(moduli(terms, 1, 0), 4);
  for (std::size_t i = 0; i < places; ++i) {
    b.deflection.push_back(remainder(moduli(terms, 2 + i, 0), 5));
    b.deflection_dot.push_back(remainder(moduli(terms, 2 + i, 1), 3));
  }
  return b;
}

ExponentialSum sum_of(const Terms& terms, std::size_t signal, const std::array<double, 3>& polynomial) {
  std::vector<Complex> weights;
  weights.reserve(terms.poles.size());
  for (const Weights& w : terms.weights) weights.push_back(w[signal]);
  return {polynomial, terms.poles, std::move(weights)};
}

/// Is what is left out of theta and of every y small enough?
bool enough(const ResidueBounds& bounds, const Terms& terms, double tolerance) {
  const auto small = [&](double bound, std::size_t signal) {
    const std::vector<double> m = moduli(terms, signal, 0);
    return m.empty() || bound <= tolerance * *std::max_element(m.begin(), m.end());
  };
  bool all = small(bounds.theta, 0);
  for (std::size_t i = 0; i < bounds.deflection.size(); ++i) all = all && small(bounds.deflection[i], 2 + i);
  return all;
}

/// Terms for more and more pairs until the bounds are met.
template <class Make>
Terms enough_terms(const ResidueOptions& options, std::size_t places, TimeResponse& response,
                   const Make& make) {
  for (int pairs = options.pairs > 0 ? options.pairs : std::min(16, options.most);;
       pairs = std::min(2 * pairs, options.most)) {
    Terms terms = make(pairs, response.status);
    response.bounds = bounds_of(terms, places);
    if (options.pairs > 0 || pairs >= options.most || !response.status.ok() ||
        enough(response.bounds, terms, options.tolerance))
      return terms;
  }
}

/// The weights at a simple pole: residues of k1/(s P), k1 s (I_hub + 2B)/P, k1 g_3/(s P).
Weights at_pole(const ClosedLoop& loop, Complex p, std::span<const double> places, double scale) {
  const LoopTerms t = loop.terms(p, places);
  const Complex factor = scale * loop.gains().k1 / t.characteristic.slope;
  Weights w = {factor * t.determinant / p, factor * p * t.open_loop};
  for (const Complex& shape : t.shapes) w.push_back(factor * p * shape);
  return w;
}

/// How a pole lies among all poles of the step response, conjugates and s = 0 included.
struct Neighbours {
  Complex nearest;
  double first = std::numeric_limits<double>::infinity();   ///< distance of the nearest
  double second = std::numeric_limits<double>::infinity();  ///< of the next one
  std::size_t index = 0;  ///< of the nearest, itself if it is its own conjugate
  /// Two poles that nearly coincide: simple residues would cancel.
  [[nodiscard]] bool pair() const { return first < 0.02 * second; }
};

Neighbours neighbours(const std::vector<Complex>& poles, std::size_t k) {
  Neighbours n;
  const auto consider = [&](Complex other, std::size_t index) {
    const double distance = std::abs(other - poles[k]);
    if (distance < n.first) {
      n.second = n.first;
      n.first = distance;
      n.nearest = other;
      n.index = index;
    } else {
      n.second = std::min(n.second, distance);
    }
  };
  consider(0, k);
  // By modulus: others that could be near are near in the list.
  const std::size_t begin = k > 40 ? k - 40 : 0, end = std::min(poles.size(), k + 40);
  for (std::size_t j = begin; j < end; ++j) {
    if (j != k) consider(poles[j], j);
    if (poles[j].imag() != 0) consider(std::conj(poles[j]), j);
  }
  return n;
}

/// A pair by the trapezoidal rule on a circle round it, which converges geometrically.
void add_pair(const ClosedLoop& loop, Complex pole, const Neighbours& n, double scale,
              std::span<const double> places, Terms& terms) {
  constexpr int points = 48;
  Complex centre = (pole + n.nearest) / 2.;
  // On the real axis, or of two conjugates, it is its own conjugate.
  const bool own = std::abs(centre.imag()) <= n.first / 2;
  if (own) centre = centre.real();
  const double half = own ? 0.5 : 1;
  const double radius = std::min(0.4 * n.second, std::max(0.8 * std::abs(centre.real()), 3 * n.first));
  for (int k = 0; k < points; ++k) {
    const Complex from_centre = std::polar(radius, std::numbers::pi * (2 * k + 1) / points);
    const Complex s = centre + from_centre;
    const LoopTerms t = loop.terms(s, places);
    const Complex factor =
        half * scale * loop.gains().k1 * from_centre / (static_cast<double>(points) * t.characteristic.value);
    Weights w = {factor * t.determinant / s, factor * s * t.open_loop};
    for (const Complex& shape : t.shapes) w.push_back(factor * s * shape);
    terms.poles.push_back(s);
    terms.weights.push_back(std::move(w));
  }
}

Terms loop_terms(const ClosedLoop& loop, int pairs, double scale, std::span<const double> places,
                 Status& status) {
  const LoopPoles poles = loop.poles(pairs);
  status = poles.status;
  Terms terms;
  std::vector<bool> done(poles.s.size(), false);
  for (std::size_t k = 0; k < poles.s.size(); ++k) {
    if (done[k]) continue;
    const Complex p = poles.s[k];
    if (const Neighbours n = neighbours(poles.s, k); n.pair()) {
      done[n.index] = true;
      add_pair(loop, p, n, scale, places, terms);
      continue;
    }
    Weights w = at_pole(loop, p, places, p.imag() == 0 ? scale / 2 : scale);
    terms.poles.push_back(p);
    terms.weights.push_back(std::move(w));
  }
  return terms;
}

Terms plant_terms(const Plant& plant, int pairs, double torque, std::span<const double> places,
                  Status& status) {
  const Frequencies f = poles(plant, pairs);
  status = f.status;
  Terms terms;
  for (const double omega : f.omega) {
    const Complex p(0, omega);
    const Motion<Jet> motion = plant.appendage().motion_with_slope(p);
    const Complex factor = torque / plant.effective_inertia(motion).slope;
    Weights w = {factor * motion.determinant.value / (p * p * p), 0.};
    for (const double x : places) w.push_back(factor * plant.appendage().deflection(motion, x).value / p);
    terms.poles.push_back(p);
    terms.weights.push_back(std::move(w));
  }
  return terms;
}

void finish(TimeResponse& response, std::span<const double> places) {
  response.theta_dot = response.theta.derivative();
  response.places.assign(places.begin(), places.end());
  for (std::size_t i = 0; i < places.size(); ++i)
    response.deflection_dot.push_back(response.deflection[i].derivative());
}

/// Gauss's rule with 4 points on [a, b]: exact for polynomials of degree 7.
double integral(double a, double b, const std::function<double(double)>& f) {
  constexpr double points[] = {0.33998104358485626, 0.86113631159405258};
  constexpr double weights[] = {0.65214515486254614, 0.34785484513745386};
  const double middle = (a + b) / 2, half = (b - a) / 2;
  double sum = 0;
  for (int i = 0; i < 2; ++i)
    sum += weights[i] * (f(middle - half * points[i]) + f(middle + half * points[i]));
  return sum * half;
}

}  // namespace

TimeResponse step_response(const ClosedLoop& loop, double final_angle, std::span<const double> places,
                           const ResidueOptions& options) {
  require_options(options);
  require_places(loop.plant(), places, final_angle);
  TimeResponse response;
  const bool moves = loop.gains().k1 > 0;
  const Terms terms = moves ? enough_terms(options, places.size(), response,
                                           [&](int pairs, Status& status) {
                                             return loop_terms(loop, pairs, final_angle, places, status);
                                           })
                            : Terms{};
  if (!moves) response.bounds = bounds_of(terms, places.size());
  response.theta = sum_of(terms, 0, {moves ? final_angle : 0, 0, 0});
  response.torque = sum_of(terms, 1, {});
  for (std::size_t i = 0; i < places.size(); ++i) response.deflection.push_back(sum_of(terms, 2 + i, {}));
  finish(response, places);
  return response;
}

TimeResponse torque_response(const Plant& plant, double torque, std::span<const double> places,
                             const ResidueOptions& options) {
  require_options(options);
  require_places(plant, places, torque);
  TimeResponse response;
  const Terms terms = enough_terms(options, places.size(), response, [&](int pairs, Status& status) {
    return plant_terms(plant, pairs, torque, places, status);
  });
  const double gain = plant.rigid_gain();
  // 1/(s^2 (J - 2 strain s^2 + ...)) = 1/(J s^2) + 2 strain/J^2 + ...
  const double constant = 2 * statics(plant.parameters(), 0).strain * gain * gain;
  response.theta = sum_of(terms, 0, {torque * constant, 0, torque * gain / 2});
  response.torque = ExponentialSum({torque, 0, 0}, {}, {});
  for (std::size_t i = 0; i < places.size(); ++i)
    response.deflection.push_back(sum_of(terms, 2 + i, {torque * plant.static_deflection(places[i]), 0, 0}));
  finish(response, places);
  return response;
}

double pulse(const ExponentialSum& step, double time, double duration) {
  return time <= duration ? step.value(time) : step.value(time) - step.value(time - duration);
}

Statics statics(const Parameters& p, double x) {
  require_physical(p);
  if (!(x >= 0 && x <= p.length))
    throw std::invalid_argument(fmt::format("statics: x = {:g} is outside 0 to {:g}", x, p.length));
  const double ei = p.bending_stiffness();
  const auto moment = [&](double at) {
    const double load = integral(
        at, p.length, [&](double xi) { return p.mass_per_length * (p.hub_radius + xi) * (xi - at); });
    return load + p.tip_mass * (p.hub_radius + p.length) * (p.length - at) + p.tip_inertia;
  };
  const auto green = [&](double xi) {
    const double near = std::min(x, xi), far = std::max(x, xi);
    return near * near * (3 * far - near) / (6 * ei);
  };
  const auto square = [&](double xi) { return green(xi) * green(xi); };
  const double slope = x * x / (2 * ei), tip = green(p.length);
  Statics s{};
  s.strain = integral(0, p.length, [&](double at) { return moment(at) * moment(at) / ei; });
  s.green = x * x * x / (3 * ei);
  s.square = (p.mass_per_length * (integral(0, x, square) + integral(x, p.length, square)) +
              p.tip_mass * tip * tip + p.tip_inertia * slope * slope) /
             2;
  return s;
}

}  // namespace nlmech::spacecraft
