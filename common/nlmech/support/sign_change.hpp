/// @file
/// Root of a function in a bracket. For sources compiled with Boost.
#pragma once

#include <boost/math/tools/roots.hpp>

namespace nlmech {

/// Position of the sign change of @p f between @p low and @p high, by bisection to the last bit: the lower of
/// the two adjacent doubles. Without a sign change: @p high if f(high) = 0, else @p low; Boost would throw.
template <class F>
[[nodiscard]] double sign_change(const F& f, double low, double high) {
  const double first = f(low), last = f(high);
  if (!(first < 0 && last > 0) && !(first > 0 && last < 0)) return last == 0 ? high : low;
  return boost::math::tools::bisect(f, low, high, [](double, double) { return false; }).first;
}

}  // namespace nlmech
