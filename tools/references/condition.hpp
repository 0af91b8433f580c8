/// @file
/// Condition numbers of a problem: products of the derivatives of steps, backwards from the times at which
/// errors are measured.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "nlmech/support/stopwatch.hpp"

namespace nlmech::references {

/// A step of a solution: its start, and the derivatives of its end by its start.
struct Link {
  double end;                  ///< time
  Eigen::VectorXd start;       ///< state
  Eigen::MatrixXd derivative;  ///< n times n
};

/// What errors are divided by.
struct Scales {
  Eigen::VectorXd flagged;  ///< of components near zero: a size; 0 where errors are relative
  /// Of a component with the value @p x.
  [[nodiscard]] double of(Eigen::Index i, double x) const {
    return flagged[i] > 0 ? flagged[i] : std::abs(x);
  }
};

/// A component is near zero if it changes its sign, or falls below a tenth of its greatest value, between the
/// times of measurement: it then counts by that value. One below a thousandth of the absolute tolerance is
/// what the tolerance leaves open, and counts by that.
inline Scales scales_of(const std::vector<Eigen::VectorXd>& judged, double absolute) {
  Scales scales{Eigen::VectorXd::Zero(judged.front().size())};
  for (Eigen::Index i = 0; i < scales.flagged.size(); ++i) {
    double low = judged[0][i], high = low, least = std::abs(low);
    for (const Eigen::VectorXd& x : judged) {
      low = std::min(low, x[i]);
      high = std::max(high, x[i]);
      least = std::min(least, std::abs(x[i]));
    }
    const double size = std::max(-low, high);
    if (low * high <= 0 || least < size / 10) scales.flagged[i] = size;
    if (size < absolute / 1000) scales.flagged[i] = absolute;
  }
  return scales;
}

/// The median over the times of measurement of the greatest factor from errors of one weight in every
/// component, at any earlier time, to the error there; weights are absolute + |x_i|, signs the worst.
/// @param links all steps from the start to the end; a step ends at each time of measurement
inline double condition(const std::vector<Link>& links, const std::vector<double>& times,
                        const std::vector<Eigen::VectorXd>& judged, const Scales& scales, double absolute) {
  std::vector<double> all;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Eigen::Index n = judged[k].size();
    Eigen::VectorXd over(n);
    for (Eigen::Index i = 0; i < n; ++i) over[i] = 1 / scales.of(i, judged[k][i]);
    const auto factor = [&](const Eigen::MatrixXd& m, const Eigen::VectorXd& x) {
      const Eigen::VectorXd moved = m.cwiseAbs() * (x.array().abs() + absolute).matrix();
      return moved.cwiseProduct(over).maxCoeff();
    };
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(n, n);
    double greatest = factor(m, judged[k]);
    std::size_t last = links.size();
    while (last > 0 && links[last - 1].end > times[k]) --last;
    for (; last > 0; --last) {
      m = (m * links[last - 1].derivative).eval();
      greatest = std::max(greatest, factor(m, links[last - 1].start));
    }
    all.push_back(greatest);
  }
  return median(all);
}

}  // namespace nlmech::references
