/// @file
/// Roots between two places with different signs. Internal to the component.
#pragma once

#include <boost/math/tools/roots.hpp>

namespace nlmech::spacecraft {

/// Where @p f changes its sign between @p low and @p high, to the last bit: of the two doubles the lower one.
template <class F>
[[nodiscard]] double sign_change(const F& f, double low, double high) {
  return boost::math::tools::bisect(f, low, high, [](double, double) { return false; }).first;
}

}  // namespace nlmech::spacecraft
