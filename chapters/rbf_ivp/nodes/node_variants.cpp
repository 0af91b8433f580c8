#include "chapters/rbf_ivp/nodes/node_variants.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/collocation/barycentric.hpp"

namespace nlmech::chapters::rbf_ivp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TrialSpace gaussians(const VectorXd& nodes, const VectorXd& shapes) {
  using Square = collocation::Matrix<Digits50>;
  if (nodes.size() < 2 || nodes.size() != shapes.size())
    throw std::invalid_argument(
        fmt::format("gaussians: {} nodes and {} shapes; as many of both are needed, at least 2", nodes.size(),
                    shapes.size()));
  const VectorXd checks = check_points(nodes.size());
  const Index n = nodes.size(), m = checks.size();
  Square phi(n, n), dphi(n, n), at(m, n), dat(m, n);
  const auto fill = [&](const VectorXd& times, Square& value, Square& slope) {
    for (Index i = 0; i < times.size(); ++i) {
      for (Index k = 0; k < n; ++k) {
        const Digits50 r = Digits50(times[i]) - nodes[k], c2 = Digits50(shapes[k]) * shapes[k];
        value(i, k) = exp(Digits50(-c2 * r * r));
        slope(i, k) = -2 * c2 * r * value(i, k);
      }
    }
  };
  fill(nodes, phi, dphi);
  fill(checks, at, dat);
  // A Phi = B for all three at once: their rows one above the other.
  Square right(n, n + 2 * m);
  right << dphi.transpose(), at.transpose(), dat.transpose();
  const Square rows = Square(phi.transpose()).partialPivLu().solve(right);
  const MatrixXd all = rows.transpose().cast<double>();
  return {nodes, all.topRows(n), checks, all.middleRows(n, m), all.bottomRows(m)};
}

TrialSpace polynomials(const VectorXd& nodes) {
  const VectorXd checks = check_points(nodes.size()), weights = collocation::barycentric_weights(nodes);
  MatrixXd values(checks.size(), nodes.size());
  collocation::RowVector<double> row;
  for (Index i = 0; i < checks.size(); ++i) {
    collocation::polynomial_row(nodes, weights, checks[i], row);
    values.row(i) = row;
  }
  const MatrixXd derivative = collocation::polynomial_differentiation_matrix(nodes);
  return {nodes, derivative, checks, values, values * derivative};
}

VectorXd check_points(Index nodes) {
  return (collocation::legendre_gauss(static_cast<int>(3 * (nodes - 1))).array() + 1) / 2;
}

VectorXd gauss_weights(Index m) {
  VectorXd w(m);
  const VectorXd nodes = collocation::legendre_gauss(static_cast<int>(m));
  for (Index i = 0; i < m; ++i) {
    const double slope = collocation::jacobi(static_cast<int>(m), 0, 0, nodes[i]).derivative;
    w[i] = 1 / ((1 - nodes[i] * nodes[i]) * slope * slope);
  }
  return w;
}

VectorXd family_nodes(collocation::NodeFamily family, int n) {
  return (collocation::nodes(family, n).array() + 1) / 2;
}

VectorXd own_shapes(const VectorXd& nodes, double c) {
  const Index n = nodes.size();
  VectorXd shapes(n);
  for (Index k = 0; k < n; ++k) {
    const Index left = std::max<Index>(k - 1, 0), right = std::min(k + 1, n - 1);
    const double spacing = (nodes[right] - nodes[left]) / static_cast<double>(right - left);
    shapes[k] = c / static_cast<double>(n - 1) / spacing;
  }
  return shapes;
}

VectorXd placed_nodes(const VectorXd& nodes, const VectorXd& checks, const VectorXd& monitor) {
  const Index m = checks.size();
  // The density is a polygon through the check points, constant beyond the outermost; its integral by the
  // trapezoidal rule.
  std::vector<double> times = {0}, density;
  const double mean = gauss_weights(m).dot(monitor);
  const auto at = [&](Index i) { return mean > 0 ? 0.5 + 0.5 * monitor[i] / mean : 1; };
  density.push_back(at(0));
  for (Index i = 0; i < m; ++i) {
    times.push_back(checks[i]);
    density.push_back(at(i));
  }
  times.push_back(1);
  density.push_back(at(m - 1));
  std::vector<double> sum = {0};
  for (std::size_t i = 1; i < times.size(); ++i)
    sum.push_back(sum.back() + (times[i] - times[i - 1]) * (density[i] + density[i - 1]) / 2);
  VectorXd placed = nodes;
  std::size_t i = 1;
  for (Index k = 1; k + 1 < nodes.size(); ++k) {
    const double target = nodes[k] * sum.back();
    while (sum[i] < target) ++i;
    // Within a piece the integral is taken for linear: off by the bend of the density alone.
    placed[k] = times[i - 1] + (times[i] - times[i - 1]) * (target - sum[i - 1]) / (sum[i] - sum[i - 1]);
  }
  return placed;
}

VectorXd envelope(const VectorXd& residuals) {
  const Index m = residuals.size();
  VectorXd result(m);
  for (Index i = 0; i < m; ++i) {
    const Index first = std::max<Index>(i - 2, 0), last = std::min(i + 2, m - 1);
    result[i] = std::sqrt(residuals.segment(first, last - first + 1).maxCoeff());
  }
  return result;
}

VectorXd with_inserted(const VectorXd& nodes, const VectorXd& checks, const VectorXd& residuals, int count) {
  struct Candidate {
    double residual = -1, time = 0;
  };
  std::vector<Candidate> gaps(static_cast<std::size_t>(nodes.size() - 1));
  for (Index i = 0; i < checks.size(); ++i) {
    const Index right = std::upper_bound(nodes.begin(), nodes.end(), checks[i]) - nodes.begin();
    const double from_left = checks[i] - nodes[right - 1], to_right = nodes[right] - checks[i];
    Candidate& gap = gaps[static_cast<std::size_t>(right - 1)];
    if (std::min(from_left, to_right) < (from_left + to_right) / 4 || residuals[i] <= gap.residual) continue;
    gap = {residuals[i], checks[i]};
  }
  std::sort(gaps.begin(), gaps.end(),
            [](const Candidate& a, const Candidate& b) { return a.residual > b.residual; });
  std::vector<double> all(nodes.begin(), nodes.end());
  for (const Candidate& c : gaps) {
    if (count-- <= 0 || c.residual < 0) break;
    all.push_back(c.time);
  }
  std::sort(all.begin(), all.end());
  return Eigen::Map<const VectorXd>(all.data(), static_cast<Index>(all.size()));
}

}  // namespace nlmech::chapters::rbf_ivp
