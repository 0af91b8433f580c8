/// @file
/// What the tests of peers share.
#pragma once

#include <gtest/gtest.h>

#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::peers::testing {

/// x' = -x.
struct Decay {
  static constexpr int dimension = 1;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 1>& x, Vector<T, 1>& dxdt) const {
    dxdt[0] = -x[0];
  }
};

}  // namespace nlmech::peers::testing
