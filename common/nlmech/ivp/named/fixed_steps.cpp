#include "nlmech/ivp/named/fixed_steps.hpp"

#include <limits>

namespace nlmech::ivp {

StepGrid make_step_grid(double begin, double end, double length) {
  constexpr double most = 4611686018427387904.0;  // 2^62: far above any limit of steps
  const double ratio = std::abs(end - begin) / length;
  const double whole = std::round(ratio);
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * ratio;
  if (whole >= 1 && std::abs(ratio - whole) <= 1e-9 + rounding) {
    const auto count = static_cast<std::int64_t>(std::min(whole, most));
    const double step = (end - begin) / static_cast<double>(count);
    return {begin, end, step, step, count};
  }
  const double full = std::min(std::floor(ratio), most);
  const double step = std::copysign(length, end - begin);
  // Not end - (begin + full step): that sum is rounded to the spacing of times.
  return {begin, end, step, end - begin - full * step, static_cast<std::int64_t>(full) + 1};
}

}  // namespace nlmech::ivp
