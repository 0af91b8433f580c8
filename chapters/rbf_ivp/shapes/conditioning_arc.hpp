/// @file
/// The arc that the study of conditioning differentiates, with 50 digits.
#pragma once

#include "chapters/rbf_ivp/shapes/conditioning.hpp"
#include "chapters/rbf_ivp/stability/extended.hpp"

namespace nlmech::chapters::rbf_ivp::conditioning {

/// Numbers at the nodes.
using Column50 = collocation::Vector<Digits50>;

/// The motion x(t) of Eq. 4.23 and its derivative with 50 digits at the nodes of an interval, which is the
/// unit of time.
struct Arc {
  Column50 value;  ///< x
  Column50 slope;  ///< dx/dt
};

/// From t = 1.1 s on.
[[nodiscard]] Arc arc(const Setting& setting);

}  // namespace nlmech::chapters::rbf_ivp::conditioning
