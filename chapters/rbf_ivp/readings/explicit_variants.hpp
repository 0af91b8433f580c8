/// @file
/// Ways to read Eq. 4.4 where damping is concerned: it wants the velocity at a time at which the method has
/// none, and does not say where to begin.
#pragma once

#include <array>
#include <string_view>

#include "chapters/rbf_ivp/examples/runs.hpp"

namespace nlmech::chapters::rbf_ivp {

/// What the first velocity, half a step before the start, is taken to be.
enum class ExplicitStart {
  half_step,  ///< v0 - h/2 a0
  as_given,   ///< v0 itself
  whole_step  ///< v0 - h a0, so that v(h/2) = v0
};
/// All of them.
inline constexpr std::array explicit_starts = {ExplicitStart::half_step, ExplicitStart::as_given,
                                               ExplicitStart::whole_step};
/// "v0 - h/2 a0"
[[nodiscard]] std::string_view to_string(ExplicitStart start);

/// The velocity that damping forces get.
enum class ExplicitDamping {
  from_initial,  ///< 1.5 v(t - h/2) - 0.5 v(t - 3h/2), in the first step v0: as CentralDifference
  from_half,     ///< the same, in the first step v(-h/2)
  lagged,        ///< v(t - h/2)
  implicit       ///< (v(t - h/2) + v(t + h/2))/2
};
/// All of them.
inline constexpr std::array explicit_dampings = {ExplicitDamping::from_initial, ExplicitDamping::from_half,
                                                 ExplicitDamping::lagged, ExplicitDamping::implicit};
/// "v0 first"
[[nodiscard]] std::string_view to_string(ExplicitDamping damping);

/// Central differences on the three masses, to t = 200; positions alone.
/// @param h step, a divisor of 200
[[nodiscard]] Record explicit_chain(double h, ExplicitStart start, ExplicitDamping damping);

}  // namespace nlmech::chapters::rbf_ivp
