#include "chapters/rbf_ivp/nodes/node_variants.hpp"
#include "nlmech/collocation/barycentric.hpp"

namespace nlmech::chapters::rbf_ivp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

}  // namespace nlmech::chapters::rbf_ivp
