/// @file
/// Sum of residues: polynomial plus exponentials of complex poles, with derivatives, samples, extremes and
/// settling time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// Minimum or maximum of a function.
struct Extreme {
  double time = 0;   ///< time of the extreme, s
  double value = 0;  ///< function value
};

/// Minimum and maximum over an interval.
struct Extremes {
  Extreme least;    ///< minimum
  Extreme largest;  ///< maximum
};

/// Settling time.
struct Settling {
  double time = 0;  ///< the function stays within the band from this time on, s; 0 if it never leaves it
  Status status;    ///< not_converged: not settled before the latest time
};

/// f(t) = c0 + c1 t + c2 t^2 + 2 Re sum_k w_k e^(p_k t), t >= 0. A pole with Im > 0 represents itself and its
/// conjugate; the weight of a real pole is half its residue.
///
/// Tests compare values and derivatives with their closed forms (1e-13).
class ExponentialSum {
 public:
  /// The zero function.
  ExponentialSum() = default;
  /// Sum with given coefficients.
  /// @param polynomial c0, c1, c2
  /// @param poles p_k; real parts must be non-positive for late times
  /// @param weights w_k, one per pole
  /// @throws std::invalid_argument if the sizes differ or a number is not finite
  ExponentialSum(const std::array<double, 3>& polynomial, std::vector<Complex> poles,
                 std::vector<Complex> weights);

  /// f(t), or its time derivative of order @p order. The rounding error is at most 4 eps (1 + |p t|) times
  /// the sum of the moduli of the terms.
  /// @param time t >= 0; not checked
  /// @param order 0, 1, 2, ...
  [[nodiscard]] double value(double time, int order = 0) const;
  /// f at first, first + step, ...; multiplies by e^(p step), which is faster than value() and as accurate.
  [[nodiscard]] std::vector<double> samples(double first, double step, std::size_t count) const;
  /// The time derivative f'.
  [[nodiscard]] ExponentialSum derivative() const;
  /// 2 sum_k |w_k| e^(Re p_k t): for negative real parts a bound of the exponential part at all later times.
  [[nodiscard]] double envelope(double time) const;
  /// Error bound of value() due to rounding of the poles: sum of 2 |w_k| e^(Re p_k t) times the error of the
  /// exponent, 4 eps |p_k| t, limited to 1, where the phase is lost.
  [[nodiscard]] double uncertainty(double time) const;
  /// f without its smallest terms, whose moduli 2 |w_k| add up to at most @p remainder.
  [[nodiscard]] ExponentialSum without_small(double remainder) const;

  /// c0, c1, c2.
  [[nodiscard]] const std::array<double, 3>& polynomial() const { return polynomial_; }
  /// p_k.
  [[nodiscard]] const std::vector<Complex>& poles() const { return poles_; }
  /// w_k.
  [[nodiscard]] const std::vector<Complex>& weights() const { return weights_; }

 private:
  std::array<double, 3> polynomial_{};
  std::vector<Complex> poles_, weights_;
};

/// The integral of f^2 from 0 to infinity.
struct SquareIntegral {
  double value = 0;        ///< value of the integral
  double uncertainty = 0;  ///< error due to rounding of the poles: each decay rate has an error of 8 eps
                           ///< times the modulus of the pole
};

/// Integral of the square of the exponential part: -sum w_i w_j/(p_i + p_j) over all poles, conjugates
/// included. All poles must have negative real parts.
[[nodiscard]] SquareIntegral square_integral(const ExponentialSum& f);

/// Minimum and maximum of f for t from @p from to @p until, ends included. Candidates are found on samples of
/// the dominant terms and refined on the complete sum by its derivative. Values are accurate to the rounding
/// of the sum; times to its square root where f is flat, and better where f'' is not small.
/// @throws std::invalid_argument unless 0 <= from < until
[[nodiscard]] Extremes extremes(const ExponentialSum& f, double from, double until);

/// The last time at which |f - @p final_value| = @p band, searched backwards from the time at which the sum
/// of the moduli falls below the band.
/// @param latest latest time, s; not_converged if the moduli do not fall below the band before, or if more
/// than 2e7 samples are needed
/// @throws std::invalid_argument unless band and latest are positive
[[nodiscard]] Settling settling_time(const ExponentialSum& f, double final_value, double band, double latest);

}  // namespace nlmech::spacecraft
