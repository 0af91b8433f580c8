#include "chapters/rbf_ivp/stability/windows.hpp"

#include <Eigen/LU>
#include <boost/math/tools/minima.hpp>
#include <cmath>

namespace nlmech::chapters::rbf_ivp {

std::complex<double> stability_function(const Eigen::MatrixXd& derivative, std::complex<double> z) {
  const Eigen::Index s = derivative.rows() - 1;
  Eigen::MatrixXcd equations = derivative.bottomRightCorner(s, s).cast<std::complex<double>>();
  equations.diagonal().array() -= z;
  const Eigen::VectorXcd x = equations.partialPivLu().solve(
      Eigen::VectorXcd(-derivative.col(0).tail(s).cast<std::complex<double>>()));
  return x[s - 1];
}

double polynomial_amplification(collocation::NodeFamily family, int count, double y) {
  using Digits50 = ExtendedReal<50>;
  using Column = collocation::Vector<Digits50>;
  const Column nodes = (collocation::nodes<Digits50>(family, count).array() + 1) / 2;
  const Eigen::Index s = nodes.size() - 1;
  Column at_zero = Column::Zero(s + 1);  // coefficients of M
  at_zero[0] = 1;
  for (Eigen::Index i = 1; i <= s; ++i) {
    for (Eigen::Index k = i; k > 0; --k) at_zero[k] = at_zero[k - 1] - nodes[i] * at_zero[k];
    at_zero[0] *= -nodes[i];
  }
  Column at_one = at_zero;  // coefficients of the Taylor series of M at 1
  for (Eigen::Index i = 0; i < s; ++i) {
    for (Eigen::Index k = s - 1; k >= i; --k) at_one[k] += at_one[k + 1];
  }
  const auto size = [&](const Column& taylor) {
    // The sum of M^(s-k) (iy)^k, whose terms are (s - k)! taylor[s - k] y^k.
    Digits50 part[2] = {0, 0}, term = 1;
    for (Eigen::Index k = 1; k <= s; ++k) term *= k;
    for (Eigen::Index k = 0; k <= s; ++k) {
      part[k % 2] += (k % 4 < 2 ? 1 : -1) * term * taylor[s - k];
      if (k < s) term *= Digits50(y) / (s - k);
    }
    return sqrt(Digits50(part[0] * part[0] + part[1] * part[1]));
  };
  return static_cast<double>(Digits50(size(at_one) / size(at_zero)));
}

std::vector<Window> windows_above(const Eigen::MatrixXd& derivative, double last, double threshold,
                                  int per_unit) {
  const auto growth = [&](double y) { return std::abs(stability_function(derivative, {0, y})); };
  std::vector<Window> windows;
  bool inside = false;
  for (int i = 1; i <= last * per_unit; ++i) {
    const double y = static_cast<double>(i) / per_unit, size = growth(y);
    if (size > threshold) {
      if (!inside) windows.push_back({y, y, size, y});
      windows.back().end = y;
      if (size > windows.back().largest) {
        windows.back().largest = size;
        windows.back().place = y;
      }
    }
    inside = size > threshold;
  }
  for (Window& w : windows) {
    const auto [place, least] = boost::math::tools::brent_find_minima(
        [&](double y) { return -growth(y); }, w.place - 1.0 / per_unit, w.place + 1.0 / per_unit, 26);
    w.largest = -least;
    w.place = place;
  }
  return windows;
}

}  // namespace nlmech::chapters::rbf_ivp
