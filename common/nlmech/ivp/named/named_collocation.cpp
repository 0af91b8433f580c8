#include <Eigen/LU>
#include <cmath>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"

namespace nlmech::ivp::named {
namespace {

/// Radial functions do not contain the linear ones. With N unknowns D x = h g and g = 1 the state should grow
/// by h; by how much of h does it miss?
double rate_error(const RbfCollocation& method) {
  const collocation::Basis basis = basis_of(method);
  if (!basis.status().ok()) return HUGE_VAL;
  const Eigen::Index inner = basis.nodes().size() - 1;
  const Eigen::VectorXd growth =
      basis.derivative().bottomRightCorner(inner, inner).lu().solve(Eigen::VectorXd::Ones(inner));
  return std::abs(growth[inner - 1] - 1);
}

}  // namespace

template <int n>
NamedIntegrator<n> by_collocation(const MethodInfo& info, const Settings& settings) {
  const double shape = settings.shape.value_or(0);
  if (info.name == AdaptiveCollocation::name)
    return by_tolerance<n, AdaptiveCollocation>(settings,
                                                {.nodes = settings.nodes.value_or(0), .shape = shape});
  if (info.name == Mcpi::name) {
    const int order = settings.nodes ? *settings.nodes - 1 : Mcpi{}.order;
    return fixed_step<n>(info, settings, {},
                         [order](double step) { return Mcpi{.step = step, .order = order}; });
  }
  const int nodes = settings.nodes.value_or(PolynomialCollocation{}.nodes);
  if (info.name == RbfCollocation::name) {
    const auto make = [nodes, shape](double step) {
      return RbfCollocation{.step = step, .nodes = nodes, .shape = shape};
    };
    return fixed_step<n>(info, settings, {}, make, [make](double step) { return rate_error(make(step)); });
  }
  const auto polynomials = [&](collocation::NodeFamily points, int order) {
    return fixed_step<n>(info, settings, order, [nodes, points](double step) {
      return PolynomialCollocation{.step = step, .nodes = nodes, .points = points};
    });
  };
  if (info.name == lgl_name) return polynomials(collocation::NodeFamily::legendre_gauss_lobatto, nodes - 1);
  if (info.name == radau_name) return polynomials(collocation::NodeFamily::left_end_and_radau, 2 * nodes - 3);
  return {};
}

template NamedIntegrator<1> by_collocation(const MethodInfo&, const Settings&);
template NamedIntegrator<2> by_collocation(const MethodInfo&, const Settings&);
template NamedIntegrator<3> by_collocation(const MethodInfo&, const Settings&);
template NamedIntegrator<4> by_collocation(const MethodInfo&, const Settings&);
template NamedIntegrator<6> by_collocation(const MethodInfo&, const Settings&);
template NamedIntegrator<Eigen::Dynamic> by_collocation(const MethodInfo&, const Settings&);

}  // namespace nlmech::ivp::named
