/// @file
/// Sections of the strongly nonlinear oscillator once a period of its coefficients (pi), and what they tell.
#pragma once

#include <cstdint>
#include <vector>

#include "chapters/algebraic_series/samples.hpp"

namespace nlmech::chapters::algebraic_series {

/// States at t_0 + k pi for k = 0 to @p count - 1, by the dense output of series with steps by the radius of
/// convergence (rtol = atol = 1e-16). @throws Failure if the integration fails or uses up @p limits
[[nodiscard]] std::vector<ivp::State> sections(const ivp::System& oscillator, const ivp::State& x0, double t0,
                                               std::int64_t count, const ivp::Limits& limits = {});

/// Mean advance of the angle about the origin from one section to the next, in turns, in (0, 1): a weighted
/// Birkhoff average, which converges faster than any power of the number of sections on a smooth torus.
[[nodiscard]] double rotation_number(const std::vector<ivp::State>& sections);

/// Greatest distance of every 31st section from @p centre, of those numbered from @p begin to @p end.
[[nodiscard]] double island_radius(const std::vector<ivp::State>& sections, const ivp::State& centre,
                                   std::size_t begin, std::size_t end);

}  // namespace nlmech::chapters::algebraic_series
