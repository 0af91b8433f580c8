#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "nlmech/algebraic/paths/path_step.hpp"

namespace nlmech::algebraic {
namespace {

constexpr std::size_t places = 9;  // points per step, including both ends
constexpr Eigen::Index block = 3;  // vectors of the block inverse iteration
constexpr int rounds = 4;          // its iterations

/// Minimum of the parabola through three values at distance 1; `at` is relative to the middle one.
struct Vertex {
  double at, value;
};

Vertex vertex_of(double left, double middle, double right) {
  const double slope = (right - left) / 2, bend = right - 2 * middle + left;
  if (!(bend > 0)) return {HUGE_VAL, HUGE_VAL};
  return {-slope / bend, middle - slope * slope / (2 * bend)};
}

}  // namespace

/// Eigenvalues of K nearest to zero on both sides, from the factors of the system: Ritz values of the inverse
/// on a few vectors. They are never nearer to zero than the eigenvalues.
Path::AroundZero Path::around_zero() {
  const Eigen::Index n = system_.size();
  Eigen::MatrixXd v(n, std::min<Eigen::Index>(n, block)), next(v.rows(), v.cols());
  for (Eigen::Index i = 0; i < v.size(); ++i)
    v.data()[i] = 1 + 0.5 * std::sin(1. + 3. * static_cast<double>(i));
  Eigen::VectorXd column(n), solved(n);
  for (int round = 0; round < rounds; ++round) {
    v = Eigen::HouseholderQR<Eigen::MatrixXd>(v).householderQ() * Eigen::MatrixXd::Identity(n, v.cols());
    for (Eigen::Index j = 0; j < v.cols(); ++j) {
      column = v.col(j);
      system_.solve(column, solved);
      next.col(j) = solved;
    }
    if (round + 1 < rounds) v.swap(next);
  }
  const Eigen::MatrixXd inverse = v.transpose() * next;
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                     (inverse + inverse.transpose()) / 2, Eigen::EigenvaluesOnly)
                                     .eigenvalues();
  const double least = values[0], most = values[values.size() - 1];
  return {least < 0 ? -1 / least : HUGE_VAL, most > 0 ? 1 / most : HUGE_VAL};
}

/// Point in an interval where an eigenvalue has another sign than at both ends, by golden-section search for
/// the eigenvalue nearest to zero on one side.
std::optional<double> Path::extremum_between(double low, double high, double AroundZero::*side,
                                             Eigen::Index negative) {
  PathPoint point;
  return golden_section(low, high, 30, [&](double part) -> std::optional<double> {
    if (between(part, point) != Outcome::success || !system_.linearise(point.at)) return HUGE_VAL;
    system_.certify();
    if (point.negative != negative) return std::nullopt;
    return around_zero().*side;
  });
}

/// Between two places whose numbers of negative eigenvalues differ: fractions of the step that separate
/// further changes of sign, which cancel between the places.
void Path::split_between(double low, double high, Eigen::Index first, Eigen::Index last,
                         std::vector<double>& parts) {
  std::array<Eigen::Index, places> negative{};
  negative.front() = first, negative.back() = last;
  const auto part = [&](std::size_t i) { return low + (high - low) * static_cast<double>(i) / (places - 1); };
  PathPoint point;
  Eigen::Index all = 0;
  for (std::size_t i = 1; i < places; ++i) {
    if (i + 1 < places)
      negative[i] = between(part(i), point) == Outcome::success ? point.negative : negative[i - 1];
    all += std::abs(negative[i] - negative[i - 1]);
  }
  if (all == std::abs(last - first)) return;
  for (std::size_t i = 1; i + 1 < places; ++i) {
    if (negative[i] != negative[i - 1] || negative[i] != negative[i + 1]) parts.push_back(part(i));
  }
}

/// Fractions of the step that separate changes of sign of eigenvalues which cancel over the step: two
/// bifurcation points within one step. Samples inner points of the cubic and refines where the smallest
/// positive or greatest negative eigenvalue has a minimum of its magnitude near zero. Changes of one
/// direction only show at the ends and are not split.
Outcome Path::split_points(std::vector<double>& parts) {
  parts.clear();
  if (!system_.equations().is_symmetric()) return Outcome::success;
  std::array<AroundZero, places> soft{};
  std::array<Eigen::Index, places> negative{};
  const auto part = [](std::size_t i) { return static_cast<double>(i) / (places - 1); };
  for (std::size_t i = 0; i < places; ++i) {
    const PathVector at = i == 0            ? before_.at
                          : i + 1 == places ? now_.at
                                            : between_by_cubic(before_, now_, part(i));
    if (!system_.linearise(at)) return Outcome::non_finite;
    system_.certify();
    negative[i] = system_.inertia().negative;
    soft[i] = around_zero();
  }
  const auto is_at_change = [&](std::size_t i) {
    return negative[i] != negative[i - 1] || negative[i] != negative[i + 1];
  };
  Eigen::Index all = 0;
  for (std::size_t i = 1; i < places; ++i) all += std::abs(negative[i] - negative[i - 1]);
  const bool is_one_way = all == std::abs(negative[places - 1] - negative[0]);
  // Where an eigenvalue is nearly zero, the cubic is not accurate enough for its sign: use points of the
  // path.
  for (std::size_t i = 1; i + 1 < places && !is_one_way; ++i) {
    PathPoint point;
    if (!is_at_change(i) || between(part(i), point) != Outcome::success || !system_.linearise(point.at))
      continue;
    negative[i] = point.negative;
    soft[i] = around_zero();
  }
  for (std::size_t i = 1; i + 1 < places; ++i) {
    if (is_at_change(i)) {
      if (!is_one_way) parts.push_back(part(i));
      continue;
    }
    for (const auto side : {&AroundZero::negative, &AroundZero::positive}) {
      const double left = soft[i - 1].*side, right = soft[i + 1].*side;
      const Vertex vertex = vertex_of(left, soft[i].*side, right);
      if (!(std::abs(vertex.at) <= 1 && vertex.value < 0.3 * std::max(left, right))) continue;
      if (const auto extremum = extremum_between(part(i - 1), part(i + 1), side, negative[i]))
        parts.push_back(*extremum);
    }
  }
  for (std::size_t i = 1; i < places; ++i) {
    if (negative[i] != negative[i - 1])
      split_between(part(i - 1), part(i), negative[i - 1], negative[i], parts);
  }
  std::sort(parts.begin(), parts.end());
  return Outcome::success;
}

}  // namespace nlmech::algebraic
