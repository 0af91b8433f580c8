/// What the tests of the Taylor series method share.
#pragma once

#include "nlmech/ivp/series/series.hpp"
#include "tests/ivp/reference.hpp"

namespace nlmech::ivp::testing {

/// Steps chosen by one tolerance.
inline Series with_tolerance(double tolerance, int order = 0) {
  return {.relative_tolerance = tolerance, .absolute_tolerance = tolerance, .order = order};
}

}  // namespace nlmech::ivp::testing
