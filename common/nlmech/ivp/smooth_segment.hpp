/// @file
/// Times at which a right-hand side is asked for, so that a step that ends on a jump does not look across it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace nlmech::ivp {

/// A stretch of time on which the right-hand side is smooth, between two neighbouring discontinuities or
/// ends. At a discontinuity f is the limit from the right, so at the later end of a segment it is asked for
/// one double before; a sum t + h that rounds below the earlier end is that end; elsewhere the time is left
/// alone. A method that asks for f at segment(t) sees on each segment, forwards or backwards, one smooth
/// function.
class SmoothSegment {
 public:
  /// The whole line.
  SmoothSegment() = default;
  /// Between @p begin and @p end, in either order.
  SmoothSegment(double begin, double end)
      : earlier_(std::min(begin, end)),
        later_(std::max(begin, end)),
        before_(std::nextafter(later_, earlier_)) {}
  /// Where to ask for f when the method means @p t.
  [[nodiscard]] double operator()(double t) const { return t < later_ ? std::max(t, earlier_) : before_; }

 private:
  double earlier_ = -std::numeric_limits<double>::infinity();
  double later_ = std::numeric_limits<double>::infinity();
  double before_ = std::numeric_limits<double>::infinity();
};

}  // namespace nlmech::ivp
