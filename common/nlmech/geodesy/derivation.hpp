/// @file
/// The coefficients of the perturbation series, derived from the equations in exact rational arithmetic.
///
/// The foot of the perpendicular at parametric latitude phi = phi_0 + d obeys
///     sin d = p [ q (2 + p)/2 sin(2 phi_0 + 2 d) - cos(phi_0) sin(phi_0 + d) ],    q = b/R,
/// which is Eq. 2.46 with the height eliminated. Its right-hand side carries a factor p, so that substituting
/// a series for d gives the next order of that series: order by order without any unknown coefficient. All
/// coefficients are polynomials in q, cos(phi_0)^2 and S = sin(2 phi_0) with rational numbers; S^2 reduces to
/// 4 cos^2 (1 - cos^2). The height is then the projection on the normal, expanded in the same way.
#pragma once

#include "nlmech/geodesy/perturbation.hpp"

namespace nlmech::geodesy {

/// Derives all tabulated orders. Exact: an overflow of the 64-bit fractions would throw std::overflow_error.
[[nodiscard]] SeriesTable derive_series();

}  // namespace nlmech::geodesy
