/// @file
/// Coefficients of the perturbation series, derived in exact rational arithmetic.
///
/// The foot of the perpendicular at parametric latitude phi = phi_0 + d obeys
///     sin d = p [ q (2 + p)/2 sin(2 phi_0 + 2 d) - cos(phi_0) sin(phi_0 + d) ],    q = b/R,
/// which is Eq. 2.46 with the height eliminated. Its right-hand side has a factor p, so substituting the
/// series for d gives its next order, without unknown coefficients. All coefficients are polynomials in q,
/// cos(phi_0)^2 and S = sin(2 phi_0) with rational numbers; S^2 reduces to 4 cos^2 (1 - cos^2). The height is
/// then the projection on the normal, expanded in the same way.
#pragma once

#include "nlmech/geodesy/perturbation.hpp"

namespace nlmech::geodesy {

/// Derives all tabulated orders exactly. @throws std::overflow_error if the 64-bit fractions overflow
[[nodiscard]] SeriesTable derive_series();

}  // namespace nlmech::geodesy
