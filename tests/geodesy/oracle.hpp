/// @file
/// The exact reverse transformation in the form that the tests of the series use, and pi.
#pragma once

#include "tests/geodesy/exact_reverse.hpp"

namespace nlmech::geodesy::oracle {

using reference::Real;
using reference::reverse;
inline Real pi() { return 4 * atan(Real(1)); }

}  // namespace nlmech::geodesy::oracle
