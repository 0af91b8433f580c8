/// @file
/// The cardinal functions of Gaussians at given nodes, right of the nodes they belong to.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nlmech/collocation/radial/positive_kernel.hpp"

namespace nlmech::collocation {

/// A Gaussian of the difference of two times as weight(s) K(x(s), x(t)) weight(t), where K is a power series
/// with positive coefficients and x grows with the time:
///     exp(-c^2 (s - t)^2) = exp(-c^2 s^2) (sum_k (2 c^2)^k/k! s^k t^k) exp(-c^2 t^2), for wide functions;
///     the same = C sum_q exp(-2 c^2 (s - qh)^2) exp(-2 c^2 (t - qh)^2), for narrow ones: by the trapezoidal
///     rule, and a power series in exp(4 c^2 h s) exp(4 c^2 h t).
/// The step h makes the rule's error, 2 exp(-(pi/(2 c h))^2), far smaller than the smallest pivot of the
/// matrix. Of the two, the one with fewer terms is taken.
class GaussianCardinals {
 public:
  /// @param times nodes, ascending
  /// @param shape c > 0, 1/time; c times the interval at least 1e-10
  GaussianCardinals(Eigen::VectorXd times, double shape);

  /// The values at a time @p t of the cardinal functions of the nodes left of it.
  /// @param t within the interval of the nodes, and none of them
  [[nodiscard]] Eigen::VectorXd values(double t) const;

  /// The derivatives at node @p i of the cardinal functions of the nodes 0..i-1; 1/time.
  [[nodiscard]] Eigen::VectorXd derivatives(Eigen::Index i) const;

  /// 1/(Phi^-1)_ii for each i: the last pivot of Phi if node i comes last. n^3 M/2 steps.
  [[nodiscard]] std::vector<Wide> last_pivots() const;

  /// How many powers were summed.
  [[nodiscard]] Eigen::Index terms() const noexcept { return static_cast<Eigen::Index>(kernel_.terms()); }

 private:
  /// Which power series: x = c (t - t_1) if rate is 0, else exp(rate c (t - t_n)).
  struct Series {
    double rate = 0;
    double offset = 0;         // the weight is exp(-(c (t - t_1) + offset)^2), or its square if rate > 0
    std::vector<Wide> ratios;  // of its coefficients
  };
  [[nodiscard]] static Series choose(Eigen::Index n, double width, double digits);
  [[nodiscard]] PositiveKernel factorised();
  [[nodiscard]] Wide last_pivot(const PositiveKernel& kernel, Eigen::Index last) const;
  [[nodiscard]] Wide gap(double t, double u) const;
  [[nodiscard]] Wide coordinate(double t) const;
  [[nodiscard]] Eigen::VectorXd cardinals(double t, Eigen::Index count, Wide product) const;

  Eigen::VectorXd times_;
  double shape_;
  Series series_;
  std::vector<Wide> gaps_, products_;  // |x_m - x_j| at n m + j; its product over m != j
  PositiveKernel kernel_;
};

}  // namespace nlmech::collocation
