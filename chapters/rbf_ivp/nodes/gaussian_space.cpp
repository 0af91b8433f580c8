#include <fmt/format.h>

#include <Eigen/LU>
#include <stdexcept>

#include "chapters/rbf_ivp/nodes/node_variants.hpp"
#include "chapters/rbf_ivp/stability/extended.hpp"

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

}  // namespace nlmech::chapters::rbf_ivp
