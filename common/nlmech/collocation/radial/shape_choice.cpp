#include "nlmech/collocation/radial/shape_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "nlmech/collocation/radial/radial_basis.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"

namespace nlmech::collocation {
namespace {

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

void require_samples(const Sampled& sampled) {
  const Eigen::Index n = sampled.times.size();
  if (sampled.values.size() != n || sampled.slopes.size() != n) {
    refuse("slope_error: ", n, " times have ", sampled.values.size(), " values and ", sampled.slopes.size(),
           " slopes");
  }
  if (!sampled.values.allFinite() || !sampled.slopes.allFinite())
    refuse("slope_error: a value or a slope is not finite");
}

double error_of(const Sampled& sampled, double shape) {
  const StableGaussian basis(sampled.times, shape);
  return (basis.differentiation_matrix() * sampled.values - sampled.slopes).cwiseAbs().maxCoeff();
}

/// Golden-section search for a minimum in [low, high], in log c.
ShapeChoice refine(const Sampled& sampled, double low, double high) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  const auto at = [&](double x) { return ShapeChoice{std::exp(x), error_of(sampled, std::exp(x))}; };
  double a = std::log(low), b = std::log(high), x = b - ratio * (b - a), y = a + ratio * (b - a);
  ShapeChoice left = at(x), right = at(y);
  constexpr double enough = 1e-3;  // relative accuracy of c; at a minimum the error is flat or 0 with a kink
  while (b - a > enough) {
    if (left.error < right.error) {
      b = y;
      y = x;
      right = left;
      x = b - ratio * (b - a);
      left = at(x);
    } else {
      a = x;
      x = y;
      left = right;
      y = a + ratio * (b - a);
      right = at(y);
    }
  }
  return left.error < right.error ? left : right;
}

}  // namespace

double slope_error(const Sampled& sampled, double shape) {
  require_samples(sampled);
  return error_of(sampled, shape);
}

ShapeChoice choose_shape(const Sampled& sampled, double least, double largest, int samples) {
  if (!(least > 0) || !(largest > least) || !std::isfinite(largest))
    refuse("choose_shape: the shapes must ascend from above 0, are ", least, " to ", largest);
  if (samples < 3) refuse("choose_shape: needs at least 3 samples, is given ", samples);
  ShapeChoice best{0, slope_error(sampled, 0)};
  const double step = std::pow(largest / least, 1.0 / (samples - 1));
  double best_sample = 0, lowest = HUGE_VAL;
  for (int k = 0; k < samples; ++k) {
    const double shape = k == samples - 1 ? largest : least * std::pow(step, k);
    const double error = error_of(sampled, shape);
    if (error < lowest) {
      lowest = error;
      best_sample = shape;
    }
  }
  if (lowest < best.error) best = {best_sample, lowest};
  const ShapeChoice refined =
      refine(sampled, std::max(least, best_sample / step), std::min(largest, best_sample * step));
  return refined.error < best.error ? refined : best;
}

double exact_leave_one_out_cost(const Eigen::VectorXd& times, double shape) {
  require_shape("exact_leave_one_out_cost", shape);
  const StableGaussian basis(times, shape);
  const Eigen::MatrixXd& D = basis.differentiation_matrix();
  const std::vector<Wide> pivots = basis.last_pivots();
  if (pivots.empty()) return 0;  // c times the interval is below 1e-10
  Wide sum;
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const Wide pivot = pivots[static_cast<std::size_t>(i)];
    sum = sum + pivot * pivot * D.col(i).squaredNorm();  // E_ij = D_ji/(Phi^-1)_ii, Eq. 4.20
  }
  return std::pow(10, sum.log10() / 2);
}

double rule_of_thumb_shape(int n, double h) {
  if (n >= 2 && h > 0 && std::isfinite(h)) return (n - 1) / (4 * h);
  std::ostringstream text;
  text << "rule_of_thumb_shape: needs at least 2 nodes and a positive, finite interval; has " << n
       << " nodes and an interval of " << h;
  throw std::invalid_argument(text.str());
}

double leave_one_out_cost(const Eigen::VectorXd& times, Kernel kernel, double shape) {
  require_node_count("leave_one_out_cost", times.size(), 2);
  const RadialBasis<double> basis(times, kernel, shape);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!basis.status().ok()) return infinity;
  const Eigen::ArrayXXd D = basis.differentiation_matrix();
  const Eigen::ArrayXd diagonal = basis.inverse().diagonal();
  const Eigen::MatrixXd E = D.transpose().colwise() / diagonal;
  if (!E.allFinite()) return infinity;
  return E.norm();
}

}  // namespace nlmech::collocation
