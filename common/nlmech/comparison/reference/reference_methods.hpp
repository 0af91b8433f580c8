/// @file
/// References by methods of ours and peers, for problems that Taylor series in extended precision do not get
/// through.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::comparison {

/// Methods that share nothing but the problem, cheap ones first: Taylor series in double precision,
/// collocation, Rosenbrock, Runge-Kutta, differentiation formulas, Hermitian operators; peers as far as this
/// build has them. Each is begun anew at every time, so that no dense output has a part in the states.
/// Tolerances are a tenth of what is needed, but not below 1e-13 (differentiation formulas and Rosenbrock:
/// 1e-12); absolute ones are a millionth of that first, for components that decay, and if the method fails
/// so, as coarse as needed.
/// @param system is kept
/// @param needed how finely
/// @param effort when to give up
[[nodiscard]] std::vector<Candidate> method_candidates(const ivp::System& system, const Needed& needed,
                                                       const Effort& effort);

}  // namespace nlmech::comparison
