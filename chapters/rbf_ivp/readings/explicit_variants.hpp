/// @file
/// Readings of Eq. 4.4 with damping: it needs the velocity at times at which the method has none, and does
/// not define the first velocity.
#pragma once

#include <array>
#include <string_view>

#include "chapters/rbf_ivp/examples/runs.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Value of the first velocity v(-h/2), half a step before the start.
enum class ExplicitStart {
  half_step,  ///< v0 - h/2 a0
  as_given,   ///< v0 itself
  whole_step  ///< v0 - h a0, so that v(h/2) = v0
};
/// All values of ExplicitStart.
inline constexpr std::array explicit_starts = {ExplicitStart::half_step, ExplicitStart::as_given,
                                               ExplicitStart::whole_step};
/// Name, such as "v0 - h/2 a0".
[[nodiscard]] std::string_view to_string(ExplicitStart start);

/// Velocity used for the damping forces.
enum class ExplicitDamping {
  from_initial,  ///< 1.5 v(t - h/2) - 0.5 v(t - 3h/2), first step v0, as in CentralDifference
  from_half,     ///< 1.5 v(t - h/2) - 0.5 v(t - 3h/2), first step v(-h/2)
  lagged,        ///< v(t - h/2)
  implicit       ///< (v(t - h/2) + v(t + h/2))/2
};
/// All values of ExplicitDamping.
inline constexpr std::array explicit_dampings = {ExplicitDamping::from_initial, ExplicitDamping::from_half,
                                                 ExplicitDamping::lagged, ExplicitDamping::implicit};
/// Name, such as "v0 first".
[[nodiscard]] std::string_view to_string(ExplicitDamping damping);

/// Runs central differences on the three masses to t = 200; records positions only.
/// @param h step size, a divisor of 200
[[nodiscard]] Record explicit_chain(double h, ExplicitStart start, ExplicitDamping damping);

}  // namespace nlmech::chapters::rbf_ivp
