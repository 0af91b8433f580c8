#include "nlmech/orbit/covariance.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nlmech::orbit {

std::optional<CovarianceFault> root_of_covariance(const Matrix<double, 6>& covariance,
                                                  Matrix<double, 6>& root) {
  root.setZero();
  Vector<double, 6> deviation;
  for (int i = 0; i < 6; ++i) {
    if (!(covariance(i, i) >= 0))
      return CovarianceFault{i, i, fmt::format("the variance {} is negative", covariance(i, i))};
    deviation[i] = std::sqrt(covariance(i, i));
  }
  // Of the correlations, which have no units.
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double a = covariance(i, j), b = covariance(j, i), size = deviation[i] * deviation[j];
      if (std::abs(a - b) > 1e-9 * size && a != b)
        return CovarianceFault{i, j, fmt::format("{} differs from {}, the entry across the diagonal", a, b)};
      if (size == 0 && (a != 0 || b != 0))
        return CovarianceFault{i, j, fmt::format("the covariance {} has a variance of 0", a)};
      double left = size == 0 ? 0 : (a / 2 + b / 2) / size;
      for (int k = 0; k < j; ++k) left -= root(i, k) * root(j, k);
      constexpr double least = 1e-12;
      if (j < i) {
        // A pivot of 0: what is left is at most the square root of its rounding.
        if (root(j, j) == 0 && std::abs(left) > 1e-6)
          return CovarianceFault{i, j,
                                 fmt::format("with the covariance {} the matrix is not positive "
                                             "semi-definite",
                                             a)};
        root(i, j) = root(j, j) == 0 ? 0 : left / root(j, j);
      } else if (left < -least) {
        return CovarianceFault{
            i, i,
            fmt::format("the variance {} is too small for the covariances with the variables before: the "
                        "matrix has a negative eigenvalue (what is left of the variance is {:.3g} of it)",
                        covariance(i, i), left)};
      } else {
        root(i, i) = left > least ? std::sqrt(left) : 0;
      }
    }
  }
  root = deviation.asDiagonal() * root;
  return std::nullopt;
}

}  // namespace nlmech::orbit
