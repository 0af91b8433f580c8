#include "chapters/rbf_ivp/stability/extended.hpp"

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/radial_basis.hpp"

namespace nlmech::chapters::rbf_ivp {

using collocation::Matrix;
using collocation::NodeFamily;
using collocation::Vector;

Vector<Digits50> unit_nodes(NodeFamily family, int n) {
  return (collocation::nodes<Digits50>(family, n).array() + 1) / 2;
}

Matrix<Digits50> polynomial_derivative(NodeFamily family, int n) {
  return collocation::polynomial_differentiation_matrix(unit_nodes(family, n));
}

Matrix<Digits50> radial_derivative(NodeFamily family, int n, double relative_shape) {
  const collocation::RadialBasis<Digits50> basis(unit_nodes(family, n), collocation::Kernel::gaussian,
                                                 Digits50(relative_shape));
  return basis.differentiation_matrix();
}

}  // namespace nlmech::chapters::rbf_ivp
