/// @file
/// The examples of section 4 of the paper: equations, and their solutions in more than double precision.
/// Their numbers are the doubles next to the paper's decimals and to 8/3, as methods see them: a solution of
/// Lorenz's equations with 8/3 itself is another one by 4e-13 at t = 20, and by 2e-3 at 40.
#pragma once

#include <functional>

#include "nlmech/comparison/commands/example.hpp"

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
