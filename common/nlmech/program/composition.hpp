/// @file
/// An analytic function of several series, given by its Taylor coefficients (Filipich and Rosales, section
/// 2.1).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/program/power_series.hpp"

namespace nlmech {

/// F = sum of alpha_pqr x^p y^q z^r (Eq. 1) with finitely many coefficients, those of higher powers being 0.
/// The table is full: powers[0] coefficients of x, powers[1] of y, powers[2] of z.
template <class T>
class AnalyticFunction {
 public:
  /// @param alpha alpha_pqr at place (p powers[1] + q) powers[2] + r
  /// @param powers how many powers of x, y and z there are; 1 for a variable that F does not depend on
  /// @throws std::invalid_argument unless alpha has powers[0] powers[1] powers[2] entries, at least one
  AnalyticFunction(std::vector<T> alpha, std::array<std::size_t, 3> powers)
      : alpha_(std::move(alpha)), powers_(powers) {
    const std::size_t wanted = powers[0] * powers[1] * powers[2];
    if (wanted == 0 || alpha_.size() != wanted) {
      throw std::invalid_argument("AnalyticFunction: " + std::to_string(powers[0]) + " x " +
                                  std::to_string(powers[1]) + " x " + std::to_string(powers[2]) +
                                  " powers need as many coefficients, not " + std::to_string(alpha_.size()));
    }
  }

  /// The series of F(x(tau), y(tau), z(tau)) (Eq. 3). In place of the products of Eqs. 4-8 it is summed after
  /// Horner, innermost in z: a Cauchy product for every power of x, every pair of powers of x and y, and
  /// every coefficient. The series need not begin with 0: the coefficients are those of powers of x itself.
  [[nodiscard]] PowerSeries<T> operator()(const PowerSeries<T>& x, const PowerSeries<T>& y = {},
                                          const PowerSeries<T>& z = {}) const {
    PowerSeries<T> f;
    for (std::size_t p = powers_[0]; p-- > 0;) {
      PowerSeries<T> in_y;
      for (std::size_t q = powers_[1]; q-- > 0;) {
        PowerSeries<T> in_z;
        for (std::size_t r = powers_[2]; r-- > 0;) {
          in_z = in_z * z + PowerSeries<T>(alpha_[(p * powers_[1] + q) * powers_[2] + r]);
        }
        in_y = in_y * y + in_z;
      }
      f = f * x + in_y;
    }
    return f;
  }

 private:
  std::vector<T> alpha_;
  std::array<std::size_t, 3> powers_;
};

}  // namespace nlmech
