#include "chapters/algebraic_series/sections.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nlmech::chapters::algebraic_series {

std::vector<ivp::State> sections(const ivp::System& oscillator, const ivp::State& x0, double t0,
                                 std::int64_t count, const ivp::Limits& limits) {
  const double t1 = t0 + std::numbers::pi * static_cast<double>(count - 1);
  const auto samples = sampled(oscillator, x0, t0, t1, accurate_series(), std::numbers::pi, limits);
  std::vector<ivp::State> states;
  states.reserve(samples.size());
  for (const Sample& s : samples) states.push_back(s.x);
  return states;
}

double rotation_number(const std::vector<ivp::State>& sections) {
  constexpr double turn = 2 * std::numbers::pi;
  double sum = 0, weights = 0;
  const auto count = static_cast<double>(sections.size() - 1);
  for (std::size_t k = 0; k + 1 < sections.size(); ++k) {
    // Clockwise angle from a to b, in turns; added modulo 1.
    const ivp::State &a = sections[k], &b = sections[k + 1];
    double advance = std::atan2(a[1] * b[0] - a[0] * b[1], a.dot(b)) / turn;
    if (advance < 0) advance += 1;
    const double s = (static_cast<double>(k) + 0.5) / count, weight = std::exp(-1 / (s * (1 - s)));
    sum += weight * advance;
    weights += weight;
  }
  return sum / weights;
}

double island_radius(const std::vector<ivp::State>& sections, const ivp::State& centre, std::size_t begin,
                     std::size_t end) {
  double greatest = 0;
  for (std::size_t k = (begin + 30) / 31 * 31; k < end; k += 31)
    greatest = std::max(greatest, (sections[k] - centre).norm());
  return greatest;
}

}  // namespace nlmech::chapters::algebraic_series
