/// @file
/// Forward sensitivities by CVODES of SUNDIALS, as a peer; optional.
#pragma once

#include <functional>
#include <vector>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"

namespace nlmech::peers {

/// Integrates @p system and its sensitivities by CVODES (A. C. Hindmarsh, R. Serban) as its manual proposes:
/// the staggered corrector, sensitivities in the error test with tolerances by the parameters' sizes, exact
/// Jacobian and right-hand sides, the end as stop time. Right-hand sides count those of the sensitivities.
/// @param extended the same equations with sensitivities, whose layout() and right-hand side are used
/// @param sizes magnitude of what each column is the derivative by; positive
/// @param x0 state of @p extended at @p t0
/// @param observe called at the end of each step with the state of @p extended; may be empty
/// @throws std::logic_error if the build has no CVODES (see cvode_available())
[[nodiscard]] ivp::Solution integrate_by_cvodes(
    const Cvode& method, const ivp::System& system, const ivp::System& extended, std::vector<double> sizes,
    const ivp::State& x0, double t0, double t1,
    const std::function<void(double t, const ivp::State& x)>& observe);

}  // namespace nlmech::peers
