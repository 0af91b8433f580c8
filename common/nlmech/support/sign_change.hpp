/// @file
/// Roots between two places with different signs. For sources that are compiled with Boost.
#pragma once

#include <boost/math/tools/roots.hpp>

namespace nlmech {

/// Where @p f changes its sign between @p low and @p high, to the last bit: of the two doubles the lower one;
/// an end where it does not, which Boost would throw for.
template <class F>
[[nodiscard]] double sign_change(const F& f, double low, double high) {
  const double first = f(low), last = f(high);
  if (!(first < 0 && last > 0) && !(first > 0 && last < 0)) return last == 0 ? high : low;
  return boost::math::tools::bisect(f, low, high, [](double, double) { return false; }).first;
}

}  // namespace nlmech
