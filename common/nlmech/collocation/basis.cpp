#include "nlmech/collocation/basis.hpp"

#include <stdexcept>
#include <utility>

#include "nlmech/collocation/barycentric.hpp"

namespace nlmech::collocation {
namespace {

Eigen::VectorXd unit_nodes(NodeFamily family, int n) {
  require_node_count("Basis", n, 2);
  return (collocation::nodes(family, n).array() + 1) / 2;
}

}  // namespace

Basis Basis::polynomial(NodeFamily family, int n) {
  Basis basis;
  basis.nodes_ = unit_nodes(family, n);
  basis.weights_ = barycentric_weights(basis.nodes_);
  // On [-1, 1] the differences of nodes are accurate near both ends.
  basis.derivative_ = 2 * polynomial_differentiation_matrix(collocation::nodes(family, n));
  return basis;
}

Basis Basis::radial(NodeFamily family, int n, Kernel kernel, double relative_shape, Inversion inversion) {
  Basis basis;
  basis.nodes_ = unit_nodes(family, n);
  Differentiation d = radial_differentiation(basis.nodes_, kernel, relative_shape, inversion);
  basis.derivative_ = std::move(d.matrix);
  basis.condition_ = d.condition;
  basis.status_ = std::move(d.status);
  basis.radial_.emplace(basis.nodes_, kernel, relative_shape);
  return basis;
}

Eigen::RowVectorXd Basis::row(double tau) const {
  Eigen::RowVectorXd result;
  if (!radial_) {
    polynomial_row(nodes_, weights_, tau, result);
    return result;
  }
  if (!status_.ok()) throw std::logic_error(status_.text());
  radial_->row(tau, result);
  return result;
}

}  // namespace nlmech::collocation
