/// @file
/// Forward sensitivities by CVODES of SUNDIALS, as a peer; optional.
#pragma once

#include <vector>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"

namespace nlmech::peers {

/// Does this build have CVODES? It replaces CVODE, whose functions it has under the same names.
[[nodiscard]] bool cvodes_available() noexcept;

/// Integrates @p system and its sensitivities by CVODES (A. C. Hindmarsh, R. Serban) as its manual proposes:
/// the staggered corrector, sensitivities in the error test with tolerances by the parameters' sizes, exact
/// Jacobian and right-hand sides, the end as stop time. No checks of the result and no observers.
/// @param extended the same equations with sensitivities, whose layout() and right-hand side are used
/// @param sizes magnitude of what each column is the derivative by; positive
/// @param x state of @p extended at @p t0; replaced by that at @p t1
/// @return true on success; false also without CVODES
[[nodiscard]] bool cvodes_natively(const Cvode& method, const ivp::System& system,
                                   const ivp::System& extended, const std::vector<double>& sizes, double t0,
                                   double t1, ivp::State& x);

}  // namespace nlmech::peers
