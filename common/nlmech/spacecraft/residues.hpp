/// @file
/// A function of time as a sum of residues: a polynomial and exponentials of complex poles, with its
/// derivatives, samples, extremes and settling time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// An extreme value.
struct Extreme {
  double time = 0;   ///< where, s
  double value = 0;  ///< the value there
};

/// The least and the largest value of an interval.
struct Extremes {
  Extreme least;    ///< minimum
  Extreme largest;  ///< maximum
};

/// When a function has settled.
struct Settling {
  double time = 0;  ///< from here on it stays within the band; 0 if it always did
  Status status;    ///< not_converged: not settled in the time allowed
};

/// f(t) = c0 + c1 t + c2 t^2 + 2 Re sum_k w_k e^(p_k t), t >= 0. Poles of Im > 0 stand for themselves and
/// their conjugates; the weight of a real one is half its residue.
///
/// Tests hold values and derivatives to their closed forms, to 1e-13.
class ExponentialSum {
 public:
  /// Nothing: 0.
  ExponentialSum() = default;
  /// A sum.
  /// @param polynomial c0, c1, c2
  /// @param poles p_k, of non-positive real part if late times are wanted
  /// @param weights w_k, as many
  /// @throws std::invalid_argument if the sizes differ or a number is not finite
  ExponentialSum(const std::array<double, 3>& polynomial, std::vector<Complex> poles,
                 std::vector<Complex> weights);

  /// f(t), or its derivative of @p order by t. Rounding is within 4 eps (1 + |p t|) of the sum of the terms'
  /// moduli.
  /// @param time t >= 0; not checked
  /// @param order 0, 1, 2, ...
  [[nodiscard]] double value(double time, int order = 0) const;
  /// f at first, first + step, ...: by rotation, which is faster than one by one and as accurate.
  [[nodiscard]] std::vector<double> samples(double first, double step, std::size_t count) const;
  /// f' as a sum of the same kind.
  [[nodiscard]] ExponentialSum derivative() const;
  /// 2 sum_k |w_k| e^(Re p_k t): a bound of the oscillating part from then on if all real parts are negative.
  [[nodiscard]] double envelope(double time) const;
  /// By how much value() may be off because the poles are rounded: the sum of 2 |w_k| e^(Re p_k t) times the
  /// error of the exponent, 4 eps |p_k| t, which is taken for 1 at the most: then the phase is anything.
  [[nodiscard]] double uncertainty(double time) const;
  /// f without its smallest terms, as many as add up to at most @p remainder, counting 2 |w_k| each.
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
  double value = 0;        ///< itself
  double uncertainty = 0;  ///< by rounding of the poles: the decay of each is known to 8 eps of its modulus
};

/// Of a sum all of whose poles decay, without its polynomial: -sum w_i w_j/(p_i + p_j) over all poles,
/// conjugates included.
[[nodiscard]] SquareIntegral square_integral(const ExponentialSum& f);

/// Least and largest value for t from @p from to @p until, ends included: candidates from samples of the
/// terms that matter, refined on the whole sum by its derivative. Values are right to the sum's rounding,
/// times to the root of it where f is flat and better where f'' is not small.
/// @throws std::invalid_argument unless 0 <= from < until
[[nodiscard]] Extremes extremes(const ExponentialSum& f, double from, double until);

/// The last time at which |f - @p final_value| = @p band, looked for backwards from where the terms' moduli
/// fall below the band.
/// @param latest give up if the moduli do not fall below the band before, or more than 2e7 samples are needed
/// @throws std::invalid_argument unless band and latest are positive
[[nodiscard]] Settling settling_time(const ExponentialSum& f, double final_value, double band, double latest);

}  // namespace nlmech::spacecraft
