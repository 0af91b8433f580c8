/// @file
/// The exact reverse transformation, as the tests of the series call it, and pi.
#pragma once

#include "tests/geodesy/exact_reverse.hpp"

namespace nlmech::geodesy::oracle {

using reference::Real;
using reference::reverse;
inline Real pi() { return 4 * atan(Real(1)); }

}  // namespace nlmech::geodesy::oracle
