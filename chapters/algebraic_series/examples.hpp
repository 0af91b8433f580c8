/// @file
/// The examples of section 4 of the paper: equations, and their solutions in more than double precision.
#pragma once

#include <functional>

#include "nlmech/comparison/commands/example.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/strong_oscillator.hpp"

namespace nlmech::chapters::algebraic_series {

/// Lorenz equations (section 4.3) from 0 to 20; the reference reaches 40 and is good to 1e-17 there. Made at
/// the first call, as all of these.
[[nodiscard]] const comparison::Example& lorenz_example();
/// Forced Duffing oscillator (section 4.4) from 0 to 50; the reference reaches 100.
[[nodiscard]] const comparison::Example& forced_duffing_example();
/// Strongly nonlinear oscillator (section 4.5) from pi to 375 + pi; the reference reaches 750 + pi and is
/// good to 1e-13 there.
[[nodiscard]] const comparison::Example& oscillator_example();
/// Four bodies (section 4.2, with G = 1e-6 in physical time) from 0 to 3000.
[[nodiscard]] const comparison::Example& bodies_example();

}  // namespace nlmech::chapters::algebraic_series
