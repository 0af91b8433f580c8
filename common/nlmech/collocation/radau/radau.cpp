#include "nlmech/collocation/radau/radau.hpp"

#include <Eigen/LU>

#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"

namespace nlmech::collocation {
namespace {

/// P_0(x) to P_{s-1}(x).
template <int s>
Eigen::Matrix<long double, s, 1> legendre_values(long double x) {
  Eigen::Matrix<long double, s, 1> p;
  p[0] = 1;
  if constexpr (s > 1) p[1] = x;
  for (int k = 2; k < s; ++k) p[k] = ((2 * k - 1) * x * p[k - 1] - (k - 1) * p[k - 2]) / k;
  return p;
}

template <int s>
Radau<s> make() {
  const Vector<long double> x = radau_right<long double>(s);
  const Matrix<long double> a = integration_matrix(x) / 2;
  Radau<s> r;
  r.nodes = ((x.array() + 1) / 2).matrix().template cast<double>();
  r.integral = a.template cast<double>();
  r.twice = (a * a).eval().template cast<double>();
  // The quadrature is exact to degree 2s - 2, so the P_k are orthogonal in the discrete inner product.
  Eigen::Matrix<long double, s, s> values, legendre;
  for (int j = 0; j < s; ++j) values.col(j) = legendre_values<s>(x[j]);
  for (int k = 0; k < s; ++k) legendre.row(k) = (2 * k + 1) * values.row(k).cwiseProduct(a.row(s - 1));
  r.legendre = legendre.template cast<double>();
  const Eigen::Matrix<long double, s, 1> begin = legendre_values<s>(-1);
  r.left = (legendre.transpose() * begin).template cast<double>();
  return r;
}

}  // namespace

template <int s>
const Radau<s>& radau() {
  static const Radau<s> tables = make<s>();
  return tables;
}

template const Radau<3>& radau<3>();
template const Radau<5>& radau<5>();
template const Radau<7>& radau<7>();
template const Radau<8>& radau<8>();
template const Radau<12>& radau<12>();
template const Radau<16>& radau<16>();

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
