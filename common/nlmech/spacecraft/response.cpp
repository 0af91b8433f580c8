#include "nlmech/spacecraft/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/spacecraft/control/loop_residues.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

void require_options(const ResidueOptions& o) {
  if (o.pairs < 0 || o.pairs > 5000 || o.most < 1 || o.most > 5000)
    throw invalid_argument("residues: pairs = {}, most = {}; up to 5000 are possible", o.pairs, o.most);
  if (!(o.tolerance > 0)) throw invalid_argument("residues: tolerance = {:g}", o.tolerance);
}

void require_places(const Plant& plant, std::span<const double> places, double amplitude) {
  for (const double x : places) plant.appendage().require_place(x);
  if (!std::isfinite(amplitude))
    throw invalid_argument("residues: the amplitude {:g} is not finite", amplitude);
}

/// Bound of what the terms after the last leave out, if moduli fall like a power of their number that is at
/// least 1.5 and at most @p order; if they do not fall yet, they may stay up to number @p modes.
double remainder(const std::vector<double>& moduli, double order, double modes) {
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
  const double falling = 2 * 2 * last * static_cast<double>(n) / (power - 1);
  return seen < 1.5 ? falling + 2 * 2 * later * modes : falling;
}

/// What each pole, or group of nearly coincident ones, adds to one signal at t = 0, or to its rate.
std::vector<double> moduli(const ResidueTerms& terms, std::size_t signal, bool rate = false) {
  std::vector<double> m;
  for (const ResidueTerms::Group& g : terms.groups) m.push_back(std::abs((rate ? g.rate : g.value)[signal]));
  return m;
}

ResidueBounds bounds_of(const ResidueTerms& terms, std::size_t places) {
  ResidueBounds b;
  b.theta = remainder(moduli(terms, 0), 6, terms.modes);
  b.theta_dot = remainder(moduli(terms, 0, true), 4, terms.modes);
  b.torque = remainder(moduli(terms, 1), 4, terms.modes);
  for (std::size_t i = 0; i < places; ++i) {
    b.deflection.push_back(remainder(moduli(terms, 2 + i), 5, terms.modes));
    b.deflection_dot.push_back(remainder(moduli(terms, 2 + i, true), 3, terms.modes));
  }
  return b;
}

ExponentialSum sum_of(const ResidueTerms& terms, std::size_t signal,
                      const std::array<double, 3>& polynomial) {
  std::vector<Complex> weights;
  weights.reserve(terms.poles.size());
  for (const Weights& w : terms.weights) weights.push_back(w[signal]);
  return {polynomial, terms.poles, std::move(weights)};
}

/// Is what is left out of theta and of every y small enough, and of their rates?
bool enough(const ResidueBounds& bounds, const ResidueTerms& terms, double tolerance, double of_rates) {
  const auto small = [&](double bound, std::size_t signal, bool rate) {
    const std::vector<double> m = moduli(terms, signal, rate);
    return m.empty() || bound <= (rate ? of_rates : tolerance) * *std::max_element(m.begin(), m.end());
  };
  bool all = small(bounds.theta, 0, false) && small(bounds.theta_dot, 0, true);
  for (std::size_t i = 0; i < bounds.deflection.size(); ++i)
    all = all && small(bounds.deflection[i], 2 + i, false) && small(bounds.deflection_dot[i], 2 + i, true);
  return all;
}

/// Do the rates start within a hundredth of 0, as from rest? At t = 0 a sum is off by just what is left out,
/// which the bounds of theta and y do not tell: fast modes that hardly move theta may hold much of theta'.
bool starts_at_rest(const ResidueTerms& terms, std::size_t places) {
  const auto small = [&](std::size_t signal) {
    double start = 0, largest = 0;
    for (const ResidueTerms::Group& g : terms.groups) {
      start += 2 * g.rate[signal].real();
      largest = std::max(largest, std::abs(g.rate[signal]));
    }
    return std::abs(start) <= 1e-2 * largest;
  };
  bool all = small(0);
  for (std::size_t i = 0; i < places; ++i) all = all && small(2 + i);
  return all;
}

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of sums that end with the most terms that are allowed: fewer digits than asked for, but some.
Status few_digits(const ResidueTerms& terms, const TimeResponse& response, double tolerance) {
  if (enough(response.bounds, terms, std::max(tolerance, 1e-6), 1e-2)) return {};
  return failed_with(
      Outcome::not_converged,
      "residues: what {} poles leave out is up to {:g} of theta and {:g} of theta'; the spacecraft's hub is "
      "too light, or k2 or k3 too large, for its motion to be summed mode by mode",
      terms.groups.size(), response.bounds.theta, response.bounds.theta_dot);
}

/// Terms for more and more pairs until the bounds are met.
template <class Make>
ResidueTerms enough_terms(const ResidueOptions& options, std::size_t places, TimeResponse& response,
                          const Make& make) {
  for (int pairs = options.pairs > 0 ? options.pairs : std::min(16, options.most);;
       pairs = std::min(2 * pairs, options.most)) {
    ResidueTerms terms = make(pairs, response.status);
    response.bounds = bounds_of(terms, places);
    if (options.pairs > 0 || !response.status.ok() ||
        (enough(response.bounds, terms, options.tolerance, infinite) && starts_at_rest(terms, places)))
      return terms;
    if (pairs >= options.most) {
      response.status = few_digits(terms, response, options.tolerance);
      return terms;
    }
  }
}

ResidueTerms plant_terms(const Plant& plant, int pairs, double torque, std::span<const double> places,
                         Status& status) {
  const Frequencies f = poles(plant, pairs);
  status = f.status;
  ResidueTerms terms;
  for (const double omega : f.omega) {
    const Complex p(0, omega);
    const Motion<Jet> motion = plant.appendage().motion_with_slope(p);
    const Complex factor = torque / plant.effective_inertia(motion).slope;
    Weights w = {factor * motion.determinant.value / (p * p * p), 0.};
    for (const double x : places) w.push_back(factor * plant.appendage().deflection(motion, x).value / p);
    terms.add(p, std::move(w));
  }
  return terms;
}

/// Is a signal that begins with 0 right at the start? What is left out there is within the bound, and the
/// rest the rounding of its terms. A pole that is missing, or counts twice, shows here.
Status closes(const char* what, const ExponentialSum& sum, double bound) {
  const double start = sum.value(0), allowed = bound + 1e-9 * sum.envelope(0);
  if (std::abs(start) <= allowed) return {};
  return failed_with(Outcome::not_converged,
                     "step response: {} begins with {:g}, where 0 is right to {:g}; poles are missing, or so "
                     "near to each other that rounding decides; change a gain a little",
                     what, start, allowed);
}

/// All signals that begin with 0.
Status closed_at_start(const TimeResponse& r) {
  Status status = closes("theta", r.theta, r.bounds.theta);
  if (status.ok()) status = closes("theta'", r.theta_dot, r.bounds.theta_dot);
  for (std::size_t i = 0; i < r.deflection.size() && status.ok(); ++i) {
    status = closes("y", r.deflection[i], r.bounds.deflection[i]);
    if (status.ok()) status = closes("y'", r.deflection_dot[i], r.bounds.deflection_dot[i]);
  }
  return status;
}

void finish(TimeResponse& response, std::span<const double> places) {
  response.theta_dot = response.theta.derivative();
  response.places.assign(places.begin(), places.end());
  for (std::size_t i = 0; i < places.size(); ++i)
    response.deflection_dot.push_back(response.deflection[i].derivative());
  if (response.status.ok()) response.status = closed_at_start(response);
}

}  // namespace

TimeResponse step_response(const ClosedLoop& loop, double final_angle, std::span<const double> places,
                           const ResidueOptions& options) {
  require_options(options);
  require_places(loop.plant(), places, final_angle);
  TimeResponse response;
  const bool moves = loop.gains().k1 > 0;
  const ResidueTerms terms =
      moves ? enough_terms(options, places.size(), response,
                           [&](int pairs, Status& status) {
                             return loop_residues(loop, pairs, final_angle, places, status);
                           })
            : ResidueTerms{};
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
  const ResidueTerms terms = enough_terms(options, places.size(), response, [&](int pairs, Status& status) {
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

Status certain_at(const TimeResponse& response, double time) {
  if (!(time >= 0) || !std::isfinite(time))
    throw invalid_argument("certain_at: time {:g}; it must be at least 0", time);
  const auto judged = [time](const std::string& what, const ExponentialSum& f) -> Status {
    const auto [c0, c1, c2] = f.polynomial();
    const double smooth = std::abs(c0 + time * (c1 + time * c2));
    double largest = smooth, fastest = 0;
    for (std::size_t k = 0; k < f.poles().size(); ++k) {
      largest = std::max(largest, 2 * std::abs(f.weights()[k]));
      fastest = std::max(fastest, std::abs(f.poles()[k]));
    }
    if (!std::isfinite(smooth))
      return failed_with(Outcome::non_finite, "step: {} is not finite at t = {:g} s; ask for an earlier time",
                         what, time);
    // Below a phase of 1e12 no sum of them can be off by as much.
    if (fastest * time < 1e10 || f.uncertainty(time) <= 1e-3 * largest) return {};
    return failed_with(Outcome::outside_validity,
                       "step: at t = {:g} s rounding leaves the phase of the oscillations of {} open, {:g} "
                       "of {:g}; ask for an earlier time",
                       time, what, f.uncertainty(time), largest);
  };
  Status status = judged("theta", response.theta);
  if (status.ok()) status = judged("theta'", response.theta_dot);
  for (std::size_t i = 0; i < response.deflection.size() && status.ok(); ++i) {
    status = judged(fmt::format("y at {:g}", response.places[i]), response.deflection[i]);
    if (status.ok())
      status = judged(fmt::format("y' at {:g}", response.places[i]), response.deflection_dot[i]);
  }
  return status;
}

double pulse(const ExponentialSum& step, double time, double duration) {
  return time <= duration ? step.value(time) : step.value(time) - step.value(time - duration);
}

Statics statics(const Parameters& p, double x) {
  require_physical(p);
  if (!(x >= 0 && x <= p.length))
    throw invalid_argument("statics: x = {:g} is outside 0 to {:g}", x, p.length);
  using Rule = boost::math::quadrature::gauss<double, 7>;  // polynomials, of degree 6 at most
  const double ei = p.bending_stiffness();
  const auto moment = [&](double at) {
    const double load = Rule::integrate(
        [&](double xi) { return p.mass_per_length * (p.hub_radius + xi) * (xi - at); }, at, p.length);
    return load + p.tip_mass * (p.hub_radius + p.length) * (p.length - at) + p.tip_inertia;
  };
  const auto green = [&](double xi) {
    const double near = std::min(x, xi), far = std::max(x, xi);
    return near * near * (3 * far - near) / (6 * ei);
  };
  const auto square = [&](double xi) { return green(xi) * green(xi); };
  const double slope = x * x / (2 * ei), tip = green(p.length);
  Statics s{};
  s.strain = Rule::integrate([&](double at) { return moment(at) * moment(at) / ei; }, 0., p.length);
  s.green = x * x * x / (3 * ei);
  s.square = (p.mass_per_length * (Rule::integrate(square, 0., x) + Rule::integrate(square, x, p.length)) +
              p.tip_mass * tip * tip + p.tip_inertia * slope * slope) /
             2;
  return s;
}

}  // namespace nlmech::spacecraft
