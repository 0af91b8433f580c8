#include "chapters/two_body_series/series/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

/// Relative errors from which a position has less than six digits, and no digit.
constexpr double few_digits = 1e-6, none = 0.125;

/// |a - b|/|b| without overflow or underflow of squares.
double relative_distance(const orbit::Vector3<double>& a, const orbit::Vector3<double>& b) {
  return (a - b).stableNorm() / b.stableNorm();
}

Accuracy by_data(const orbit::State& state, const orbit::State& start, double time, double mu) {
  const double off = eps * orbit::large_condition(start, state, time, mu, few_digits / eps);
  if (off == 0) return {};
  return {off,
          fmt::format("the data, rounded to doubles, determine the position at t = {:.6g} to {:.1g} of the "
                      "distance",
                      time, off),
          {}};
}

}  // namespace

Accuracy accuracy_of(const orbit::State& state, const orbit::State& start, double time,
                     const orbit::Gravity& gravity, const ComputedBy& by) {
  Accuracy data = by_data(state, start, time, gravity.mu);
  if (!by.tolerance || gravity.degree() > 0) return data;
  const orbit::KeplerSolution exact = orbit::propagate_kepler(start, time, gravity.mu);
  if (!exact.status.ok()) return {data.off, data.sentence, exact.status};
  const double off = relative_distance(state.position, exact.state.position);
  if (off < std::max(few_digits, 8 * data.off)) return data;
  const std::string place = fmt::format(
      "the position at t = {:.6g} differs from Kepler's solution by {:.1g} of the distance: the tolerance "
      "{:g} of a step is too large for it; take a smaller one, or --method kepler",
      time, off, *by.tolerance);
  if (off < none) return {off, place, {}};
  return {off, place, failed_with(Outcome::outside_validity, "{}: {}", by.method, place)};
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
