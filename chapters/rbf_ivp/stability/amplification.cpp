#include <Eigen/LU>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "chapters/rbf_ivp/stability/extended.hpp"

namespace nlmech::chapters::rbf_ivp {

std::complex<double> stability_function(const Eigen::MatrixXd& derivative, std::complex<double> z) {
  const Eigen::Index s = derivative.rows() - 1;
  Eigen::MatrixXcd equations = derivative.bottomRightCorner(s, s).cast<std::complex<double>>();
  equations.diagonal().array() -= z;
  const Eigen::VectorXcd x = equations.partialPivLu().solve(
      Eigen::VectorXcd(-derivative.col(0).tail(s).cast<std::complex<double>>()));
  return x[s - 1];
}

std::vector<Window> instability_windows(const Eigen::MatrixXd& derivative, double last, double threshold,
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
