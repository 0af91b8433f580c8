#include "nlmech/collocation/radial/gaussian_radau.hpp"

#include <Eigen/LU>

#include "nlmech/collocation/radial/stable_gaussian.hpp"

namespace nlmech::collocation {

template <int s>
bool gaussian_radau(double shape, Radau<s>& tables) {
  const Radau<s>& polynomials = radau<s>();
  Eigen::VectorXd times(s + 1);
  times << 0, polynomials.nodes;
  const Eigen::MatrixXd derivative = StableGaussian(times, shape).differentiation_matrix();
  const Eigen::MatrixXd integral = derivative.bottomRightCorner(s, s).partialPivLu().inverse();
  tables.nodes = polynomials.nodes;
  tables.legendre = polynomials.legendre;
  tables.integral = integral;
  tables.twice = tables.integral * tables.integral;
  tables.left = (derivative.topRightCorner(1, s) * integral).transpose();
  return tables.twice.allFinite() && tables.left.allFinite();
}

template bool gaussian_radau<8>(double, Radau<8>&);
template bool gaussian_radau<12>(double, Radau<12>&);
template bool gaussian_radau<16>(double, Radau<16>&);

}  // namespace nlmech::collocation
