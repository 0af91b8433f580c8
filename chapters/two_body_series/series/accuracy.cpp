#include "chapters/two_body_series/series/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

/// Relative errors from which a position or velocity has less than six digits, and no digit.
constexpr double few_digits = 1e-6, none = 0.125;

/// |a - b|/|b| without overflow or underflow of squares.
double relative_distance(const orbit::Vector3<double>& a, const orbit::Vector3<double>& b) {
  return (a - b).stableNorm() / b.stableNorm();
}

/// Errors relative to the distance and to the speed.
struct Errors {
  double position = 0, velocity = 0;
};

/// Is the body at rest to rounding, beside the speed on a circle? Then its velocity has no digit to judge.
bool is_at_rest(const orbit::State& state, double mu) {
  return state.velocity.stableNorm() <= 64 * eps * std::sqrt(mu / state.position.stableNorm());
}

/// Effects of rounding of the data, those of at least few_digits. A body that is far slower than on a circle
/// changes its velocity most: an error of the position is one of the time, and gravity makes it one of the
/// velocity.
Errors by_data(const orbit::State& state, const orbit::State& start, double time, double mu) {
  const double speed = state.velocity.stableNorm(), least = few_digits / eps;
  const double slow = std::max(1.0, mu / state.position.stableNorm() / speed / speed);
  const double kappa = orbit::large_condition(start, state, time, mu, least / slow);
  const double velocity =
      kappa > 0 && slow > 1 && !is_at_rest(state, mu) ? orbit::kepler_condition(start, time, mu).velocity : 0;
  return {kappa >= least ? eps * kappa : 0, velocity >= least ? eps * velocity : 0};
}

/// The error that a message names: that of the position, unless it is small or the velocity alone has no
/// digit.
struct Named {
  Named(const Errors& errors, double time) {
    const bool is_position = errors.position >= none || (errors.position > 0 && errors.velocity < none);
    off = is_position ? errors.position : errors.velocity;
    what = fmt::format("{} at t = {:.6g}", is_position ? "position" : "velocity", time);
    unit = is_position ? "distance" : "speed";
  }
  double off;             ///< 0 if no digit is missing
  std::string what;       ///< "position at t = 3"
  std::string_view unit;  ///< "distance"
};

}  // namespace

Accuracy accuracy_of(const orbit::State& state, const orbit::State& start, double time,
                     const orbit::Gravity& gravity, const ComputedBy& by) {
  const Errors data = by_data(state, start, time, gravity.mu);
  const Named rounding(data, time);
  Accuracy by_rounding{.off = rounding.off, .sentence = {}, .status = {}};
  if (rounding.off > 0)
    by_rounding.sentence = fmt::format("the data, rounded to doubles, determine the {} to {:.1g} of the {}",
                                       rounding.what, rounding.off, rounding.unit);
  if (!by.tolerance || gravity.degree() > 0) return by_rounding;
  const orbit::KeplerSolution exact = orbit::propagate_kepler(start, time, gravity.mu);
  if (!exact.status.ok()) return {by_rounding.off, by_rounding.sentence, exact.status};
  // Errors of the data are no errors of the method.
  const auto beyond = [](double error, double of_data) {
    return error < std::max(few_digits, 8 * of_data) ? 0 : error;
  };
  const double velocity =
      is_at_rest(exact.state, gravity.mu) ? 0 : relative_distance(state.velocity, exact.state.velocity);
  const Named method({beyond(relative_distance(state.position, exact.state.position), data.position),
                      beyond(velocity, data.velocity)},
                     time);
  if (method.off == 0) return by_rounding;
  const std::string sentence = fmt::format(
      "the {} differs from Kepler's solution by {:.1g} of the {}: the tolerance {:g} of a step is too large "
      "for it; take {}--method kepler",
      method.what, method.off, method.unit, *by.tolerance, *by.tolerance > 1e-15 ? "a smaller one, or " : "");
  if (method.off < none) return {method.off, sentence, {}};
  return {method.off, sentence, failed_with(Outcome::outside_validity, "{}: {}", by.method, sentence)};
}

std::string_view OrbitAccuracy::add(Accuracy row) {
  const std::string_view name = !row.status.ok() ? to_string(row.status.outcome())
                                : row.off > 0    ? low_accuracy
                                                 : to_string(Outcome::success);
  if (status.ok()) status = row.status;
  if (row.off > worst.off) worst = std::move(row);
  return name;
}

void append_state(std::string& text, double t, const orbit::State& state) {
  const auto &p = state.position, &v = state.velocity;
  fmt::format_to(std::back_inserter(text), "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}", t, p[0],
                 p[1], p[2], v[0], v[1], v[2]);
}

std::string inside_the_earth(const orbit::State& start) {
  constexpr double deep = 1e6;  // m
  const double r = start.position.stableNorm(), alpha = orbit::reciprocal_axis(start, earth_mu);
  // The apoapsis distance is less than 2 a.
  if (!(r < deep && alpha > 0 && 2 / alpha < deep)) return {};
  return fmt::format(
      "without --mu lengths are metres about the Earth, and this orbit stays within {:.6g} m of its centre; "
      "give --mu in your units (398600.4418 for kilometres and seconds)",
      2 / alpha);
}

}  // namespace nlmech::chapters::two_body_series
