/// @file
/// Poincare sections of the strongly nonlinear oscillator, one per period pi of its coefficients.
#pragma once

#include <cstdint>
#include <vector>

#include "chapters/algebraic_series/samples.hpp"

namespace nlmech::chapters::algebraic_series {

/// States at t_0 + k pi for k = 0 to @p count - 1, by dense output of Series with steps from the radius of
/// convergence (rtol = atol = 1e-16). @throws Failure if the integration fails or exceeds @p limits
[[nodiscard]] std::vector<ivp::State> sections(const ivp::System& oscillator, const ivp::State& x0, double t0,
                                               std::int64_t count, const ivp::Limits& limits = {});

/// Mean advance of the angle about the origin between successive sections, in turns, in (0, 1). The weighted
/// Birkhoff average converges faster than any power of the number of sections on a smooth torus.
[[nodiscard]] double rotation_number(const std::vector<ivp::State>& sections);

/// Largest distance of every 31st section from @p centre, for section numbers in [@p begin, @p end).
[[nodiscard]] double island_radius(const std::vector<ivp::State>& sections, const ivp::State& centre,
                                   std::size_t begin, std::size_t end);

}  // namespace nlmech::chapters::algebraic_series
