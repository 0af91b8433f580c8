#include "chapters/rbf_ivp/shapes/arcs.hpp"

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "nlmech/problems/duffing.hpp"

namespace nlmech::chapters::rbf_ivp {

Arc50 exact_duffing_arc(int n, double periods, double begin) {
  const problems::Duffing problem;
  const Digits50 X = 1, omega = problem.argument_frequency(X), h = periods * problem.period(X);
  const Digits50 m = problem.elliptic_parameter(X), modulus = sqrt(m);
  Arc50 arc{unit_nodes(collocation::NodeFamily::legendre_gauss_lobatto, n), Column50(n), Column50(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    Digits50 cn;
    const Digits50 u = omega * (begin + h * arc.nodes[j]), sn = boost::math::jacobi_elliptic(modulus, u, &cn);
    const Digits50 dn = sqrt(1 - m * sn * sn);  // the library's own is a quotient of zeros at quarter periods
    arc.values[j] = X * cn;
    arc.slopes[j] = -X * omega * h * sn * dn;
  }
  return arc;
}

collocation::Sampled duffing_arc(int n, double periods, double begin) {
  const Arc50 arc = exact_duffing_arc(n, periods, begin);
  return {arc.nodes.cast<double>(), arc.values.cast<double>(), arc.slopes.cast<double>()};
}

}  // namespace nlmech::chapters::rbf_ivp
