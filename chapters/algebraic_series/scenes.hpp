/// @file
/// The scenes of the chapter, one function a group.
#pragma once

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

// The paper's own.
void add_projectile(scene::Chapter& chapter);      ///< figure 1
void add_bodies(scene::Chapter& chapter);          ///< table 1, figure 2
void add_lorenz(scene::Chapter& chapter);          ///< figures 3a and 3b
void add_forced_duffing(scene::Chapter& chapter);  ///< figures 4a and 4b, and another start
void add_oscillator(scene::Chapter& chapter);      ///< figures 5 and 6a
void add_poincare(scene::Chapter& chapter);        ///< figure 6b, and the island chain that it is part of

// Ours.
void add_radius(scene::Chapter& chapter);            ///< printed steps against the radius of convergence
void add_bessel(scene::Chapter& chapter);            ///< Bessel's equation about tau = 1
void add_fractional_power(scene::Chapter& chapter);  ///< the claim of 3000 terms
void add_divergence(scene::Chapter& chapter);        ///< forward Euler's departure against its step
void add_extremes(scene::Chapter& chapter);          ///< where a series ends
void add_error_vs_time(scene::Chapter& chapter);     ///< series and the peers

}  // namespace nlmech::chapters
