#include "nlmech/collocation/radial/shape.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "nlmech/collocation/radial/radial_basis.hpp"

namespace nlmech::collocation {

double rule_of_thumb_shape(int n, double h) {
  if (n >= 2 && h > 0 && std::isfinite(h)) return (n - 1) / (4 * h);
  std::ostringstream text;
  text << "rule_of_thumb_shape: needs at least 2 nodes and a positive, finite interval; has " << n
       << " nodes and an interval of " << h;
  throw std::invalid_argument(text.str());
}

double leave_one_out_cost(const Eigen::VectorXd& times, Kernel kernel, double shape) {
  require_node_count("leave_one_out_cost", times.size(), 2);
  const RadialBasis<double> basis(times, kernel, shape);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!basis.status().ok()) return infinity;
  const Eigen::ArrayXXd D = basis.differentiation_matrix();
  const Eigen::ArrayXd diagonal = basis.inverse().diagonal();
  const Eigen::MatrixXd E = D.transpose().colwise() / diagonal;
  if (!E.allFinite()) return infinity;
  return E.norm();
}

}  // namespace nlmech::collocation
