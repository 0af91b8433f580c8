/// @file
/// What named_integrator() knows of a system beside the runs of a method: frequencies, another method, laws.
#pragma once

#include "nlmech/ivp/named/step_search.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp::named {

/// The highest of the frequencies of the loads that the system names and of those of its Jacobian at (t, x),
/// the imaginary parts of its eigenvalues, rad/time; 0 if there are none.
[[nodiscard]] double highest_frequency(const System& system, double t, const State& x);

/// What search_step() may hold runs from (t0, x0) to t1 to. The references are `series` with tolerances of
/// 1e-16; and, where that ends with a status or the problem cannot be expanded, `adaptive-collocation` with a
/// thousandth of
/// @p tolerance, at least 1e-13. @p system and @p x0 outlive it.
[[nodiscard]] Evidence evidence_of(const System& system, const State& x0, double t0, double t1,
                                   double tolerance);

}  // namespace nlmech::ivp::named
