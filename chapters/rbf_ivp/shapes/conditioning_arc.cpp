#include "chapters/rbf_ivp/shapes/conditioning_arc.hpp"

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "nlmech/problems/duffing.hpp"

namespace nlmech::chapters::rbf_ivp::conditioning {
namespace {

constexpr double begin = 1.1;  // s, of the arc: at no symmetry of the motion, where errors would cancel

}  // namespace

Arc arc(const Setting& setting) {
  const problems::Duffing problem;
  const Digits50 X = 1, omega = problem.argument_frequency(X), h = setting.periods * problem.period(X);
  const Digits50 m = problem.elliptic_parameter(X), modulus = sqrt(m);
  const Column50 nodes = unit_nodes(collocation::NodeFamily::legendre_gauss_lobatto, setting.nodes);
  Arc a{Column50(nodes.size()), Column50(nodes.size())};
  for (Eigen::Index j = 0; j < nodes.size(); ++j) {
    Digits50 cn;
    const Digits50 u = omega * (begin + h * nodes[j]), sn = boost::math::jacobi_elliptic(modulus, u, &cn);
    const Digits50 dn = sqrt(1 - m * sn * sn);  // the library's own is a quotient of zeros at quarter periods
    a.value[j] = X * cn;
    a.slope[j] = -X * omega * h * sn * dn;
  }
  return a;
}

}  // namespace nlmech::chapters::rbf_ivp::conditioning
