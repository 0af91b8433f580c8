/// @file
/// Spacecraft of Table 3.1 with and without tip bodies, and the gains of the text.
#pragma once

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control {

/// Parameters of Table 3.1, with or without tip bodies.
[[nodiscard]] inline spacecraft::Parameters craft(bool tip) {
  const spacecraft::Parameters all = spacecraft::table_3_1();
  return tip ? all : without_tip(all);
}

using spacecraft::designed_gains;
using spacecraft::unit_gains;

}  // namespace nlmech::chapters::gss_control
