/// @file
/// Evaluation times of the right-hand side: a step that ends on a jump must not evaluate f beyond it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace nlmech::ivp {

/// Interval of time on which the right-hand side is smooth, between two neighbouring discontinuities or ends.
/// At a discontinuity f is the limit from the right, so at the later end of a segment f is evaluated one
/// double earlier. A sum t + h that rounds below the earlier end is replaced by that end. Other times are
/// unchanged. A method that evaluates f at segment(t) integrates one smooth function on each segment,
/// forwards or backwards.
class SmoothSegment {
 public:
  /// The whole line.
  SmoothSegment() = default;
  /// Between @p begin and @p end, in either order.
  SmoothSegment(double begin, double end)
      : earlier_(std::min(begin, end)),
        later_(std::max(begin, end)),
        before_(std::nextafter(later_, earlier_)) {}
  /// Time at which to evaluate f for the time @p t.
  [[nodiscard]] double operator()(double t) const { return t < later_ ? std::max(t, earlier_) : before_; }

 private:
  double earlier_ = -std::numeric_limits<double>::infinity();
  double later_ = std::numeric_limits<double>::infinity();
  double before_ = std::numeric_limits<double>::infinity();
};

}  // namespace nlmech::ivp
