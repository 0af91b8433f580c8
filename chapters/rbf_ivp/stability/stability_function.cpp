#include <Eigen/LU>
#include <cmath>

#include "chapters/rbf_ivp/stability/extended.hpp"

namespace nlmech::chapters::rbf_ivp {

using collocation::Matrix;
using collocation::Vector;

Digits50 stability_function(const Matrix<Digits50>& derivative, const Digits50& z) {
  const Eigen::Index s = derivative.rows() - 1;
  Matrix<Digits50> equations = derivative.bottomRightCorner(s, s);
  equations.diagonal().array() -= z;
  const Vector<Digits50> x = equations.partialPivLu().solve(Vector<Digits50>(-derivative.col(0).tail(s)));
  return x[s - 1];
}

double linear_order(const Matrix<Digits50>& derivative, const Digits50& z) {
  const auto error = [&](const Digits50& at) { return abs(stability_function(derivative, at) - exp(at)); };
  return static_cast<double>(log(error(z) / error(z / 2)) / log(Digits50(2))) - 1;
}

double polynomial_amplification(const Vector<Digits50>& nodes, double y) {
  const Eigen::Index s = nodes.size() - 1;
  Vector<Digits50> at_zero =
      Vector<Digits50>::Zero(s + 1);  // coefficients of M, then of its Taylor series at 1
  at_zero[0] = 1;
  for (Eigen::Index i = 1; i <= s; ++i) {
    for (Eigen::Index k = i; k > 0; --k) at_zero[k] = at_zero[k - 1] - nodes[i] * at_zero[k];
    at_zero[0] *= -nodes[i];
  }
  Vector<Digits50> at_one = at_zero;
  for (Eigen::Index i = 0; i < s; ++i) {
    for (Eigen::Index k = s - 1; k >= i; --k) at_one[k] += at_one[k + 1];
  }
  const auto size = [&](const Vector<Digits50>& taylor) {
    Digits50 part[2] = {0, 0},
             term = 1;  // of the sum of M^(s-k) (iy)^k; terms are (s - k)! taylor[s - k] y^k
    for (Eigen::Index k = 1; k <= s; ++k) term *= k;
    for (Eigen::Index k = 0; k <= s; ++k) {
      part[k % 2] += (k % 4 < 2 ? 1 : -1) * term * taylor[s - k];
      if (k < s) term *= Digits50(y) / (s - k);
    }
    return sqrt(Digits50(part[0] * part[0] + part[1] * part[1]));
  };
  return static_cast<double>(Digits50(size(at_one) / size(at_zero)));
}

}  // namespace nlmech::chapters::rbf_ivp
