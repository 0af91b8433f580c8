#include "nlmech/collocation/radial/stable_gaussian.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "nlmech/collocation/barycentric.hpp"

namespace nlmech::collocation {
namespace {

void require_width(double shape, double length) {
  const double width = shape * length;
  if (shape >= 0 && width <= StableGaussian::largest_shape) return;
  std::ostringstream text;
  text << "StableGaussian: the shape times the interval must be between 0 and "
       << StableGaussian::largest_shape << ", is " << shape << " * " << length;
  throw std::invalid_argument(text.str());
}

}  // namespace

StableGaussian::StableGaussian(const Eigen::VectorXd& times, double shape) : times_(times) {
  require_node_count("StableGaussian", times.size(), 2);
  weights_ = barycentric_weights(times);
  const double length = times[times.size() - 1] - times[0];
  require_width(shape, length);
  constexpr double negligible = 1e-10;  // D differs from that of polynomials by the square of this
  if (shape * length < negligible) {
    derivative_ = polynomial_differentiation_matrix(times);
    return;
  }
  sides_.reserve(2);
  sides_.emplace_back(times, shape);
  sides_.emplace_back(-times.reverse(), shape);
  differentiate(shape);
}

void StableGaussian::differentiate(double shape) {
  const Eigen::Index n = times_.size();
  derivative_.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    derivative_.row(i).head(i) = sides_[0].derivatives(i).transpose();
    // Seen from the other end time runs backwards.
    derivative_.row(i).tail(n - 1 - i) = -sides_[1].derivatives(n - 1 - i).reverse().transpose();
    const Eigen::ArrayXd u = shape * (times_.array() - times_[i]);
    derivative_(i, i) = 0;
    derivative_(i, i) = -(derivative_.row(i) * (-u.square()).exp().matrix()).value();
  }
}

void StableGaussian::row(double t, RowVector<double>& row) const {
  const Eigen::Index n = times_.size();
  require_time("StableGaussian::row", t);
  if (t < times_[0] || t > times_[n - 1]) {
    std::ostringstream text;
    text << "StableGaussian::row: the time must be between " << times_[0] << " and " << times_[n - 1]
         << ", is " << t;
    throw std::invalid_argument(text.str());
  }
  if (sides_.empty()) {
    polynomial_row(times_, weights_, t, row);
    return;
  }
  const Eigen::Index left = (times_.array() < t).count();
  if (times_[left] == t) {
    row.setZero(n);
    row[left] = 1;
    return;
  }
  row.resize(n);
  row.head(left) = sides_[0].values(t).transpose();
  row.tail(n - left) = sides_[1].values(-t).reverse().transpose();
}

}  // namespace nlmech::collocation
