#include <algorithm>
#include <array>
#include <cmath>

#include "nlmech/algebraic/paths/golden_section.hpp"
#include "nlmech/algebraic/paths/path_step.hpp"

namespace nlmech::algebraic {
namespace {

constexpr std::size_t places = 9;  // of a step that are looked at, both ends included

/// Where the parabola through three neighbours, a distance of 1 apart, has its least value, from the middle
/// one.
struct Vertex {
  double at, value;
};

Vertex vertex_of(double left, double middle, double right) {
  const double slope = (right - left) / 2, bend = right - 2 * middle + left;
  if (!(bend > 0)) return {HUGE_VAL, HUGE_VAL};
  return {-slope / bend, middle - slope * slope / (2 * bend)};
}

}  // namespace

/// The eigenvalue of K that is nearest to zero, as inverse iteration finds it with the factors of the system.
double Path::softest() {
  const Eigen::VectorXd v = null_direction(system_);
  system_.multiply(v, rest_);
  return v.dot(rest_);
}

/// A place in an interval where an eigenvalue has another sign than at its ends, by golden section for the
/// one nearest to zero.
std::optional<double> Path::dip_in(double low, double high, double sign, Eigen::Index negative) {
  PathPoint point;
  return golden_section(low, high, 24, [&](double part) -> std::optional<double> {
    if (between(part, point) != Outcome::success || !system_.linearise(point.at)) return HUGE_VAL;
    system_.certify();
    if (point.negative != negative) return std::nullopt;
    return sign * softest();
  });
}

/// Parts of the step between which eigenvalues change their signs, though from end to end they may not: two
/// branch points within a step, which no sign at its ends shows. Looks at inner places of the cubic, and more
/// closely where an eigenvalue comes down to near zero and returns. Changes that all go one way show at the
/// ends.
Outcome Path::splits(std::vector<double>& parts) {
  parts.clear();
  if (!system_.equations().is_symmetric()) return Outcome::success;
  std::array<double, places> soft{};
  std::array<Eigen::Index, places> negative{};
  const auto part = [](std::size_t i) { return static_cast<double>(i) / (places - 1); };
  for (std::size_t i = 0; i < places; ++i) {
    const PathVector at = i == 0            ? before_.at
                          : i + 1 == places ? now_.at
                                            : between_by_cubic(before_, now_, part(i));
    if (!system_.linearise(at)) return Outcome::non_finite;
    system_.certify();
    negative[i] = system_.inertia().negative;
    soft[i] = softest();
  }
  Eigen::Index all = 0;
  for (std::size_t i = 1; i < places; ++i) all += std::abs(negative[i] - negative[i - 1]);
  const bool is_one_way = all == std::abs(negative[places - 1] - negative[0]);
  for (std::size_t i = 1; i + 1 < places; ++i) {
    if (negative[i] != negative[i - 1] || negative[i] != negative[i + 1]) {
      if (!is_one_way) parts.push_back(part(i));
      continue;
    }
    const double sign = soft[i] > 0 ? 1 : -1;
    const Vertex vertex = vertex_of(sign * soft[i - 1], sign * soft[i], sign * soft[i + 1]);
    const bool is_near = std::abs(vertex.at) <= 1 && vertex.value < 0.3 * std::abs(soft[i]);
    if (!is_near || soft[i - 1] * sign <= 0 || soft[i + 1] * sign <= 0) continue;
    if (const auto dip = dip_in(part(i - 1), part(i + 1), sign, negative[i])) parts.push_back(*dip);
  }
  std::sort(parts.begin(), parts.end());
  return Outcome::success;
}

}  // namespace nlmech::algebraic
