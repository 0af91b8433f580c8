#include "chapters/rbf_ivp/shapes/arcs.hpp"

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/problems/duffing.hpp"

namespace nlmech::chapters::rbf_ivp {

collocation::Sampled duffing_arc(int n, double periods, double begin) {
  const problems::Duffing problem;
  const Digits50 X = 1, omega = problem.argument_frequency(X), h = periods * problem.period(X);
  const Digits50 m = problem.elliptic_parameter(X), modulus = sqrt(m);
  const auto nodes = unit_nodes(collocation::NodeFamily::legendre_gauss_lobatto, n);
  collocation::Sampled arc{nodes.cast<double>(), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    Digits50 cn;
    const Digits50 u = omega * (begin + h * nodes[j]), sn = boost::math::jacobi_elliptic(modulus, u, &cn);
    const Digits50 dn = sqrt(1 - m * sn * sn);
    arc.values[j] = static_cast<double>(Digits50(X * cn));
    arc.slopes[j] = static_cast<double>(Digits50(-X * omega * h * sn * dn));
  }
  return arc;
}

}  // namespace nlmech::chapters::rbf_ivp
