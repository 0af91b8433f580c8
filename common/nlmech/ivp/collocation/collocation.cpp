#include "nlmech/ivp/collocation/collocation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace nlmech::ivp {

collocation::Basis basis_of(const RbfCollocation& method) {
  if (!(method.shape >= 0) || !std::isfinite(method.shape))
    throw std::invalid_argument(fmt::format(
        "rbf-coll: the shape must be positive and finite, or 0 for the rule, not {}", method.shape));
  const double relative = method.shape == 0 ? (method.nodes - 1) / 4.0 : method.shape * method.step;
  return collocation::Basis::radial(method.points, method.nodes, method.kernel, relative, method.inversion);
}

collocation::Basis basis_of(const PolynomialCollocation& method) {
  return collocation::Basis::polynomial(method.points, method.nodes);
}

}  // namespace nlmech::ivp
