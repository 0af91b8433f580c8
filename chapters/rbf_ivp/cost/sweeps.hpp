/// @file
/// nlmech and peer methods with sweeps of step sizes or tolerances, for the error-vs-time scenes and the
/// benchmark.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/cost/method_sweep.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Basic step sizes of a problem, from the dissertation (Tables 4.2, 4.4, 4.6).
struct StepScales {
  double few_nodes;   ///< step of RBF-Coll with N = 7
  double many_nodes;  ///< step of RBF-Coll with N = 35
  double few_shape;   ///< c times the step for N = 7
  double many_shape;  ///< c times the step for N = 35
};

/// Scales of the free Duffing oscillator: P/10 and P.
[[nodiscard]] StepScales free_duffing_steps();
/// Scales after the end of the impact: 0.5 and 6, and the shape 0.66 that Table 4.4 does not state.
[[nodiscard]] StepScales impact_steps();
/// Scales of the three masses: 0.625 and 20.
[[nodiscard]] StepScales three_mass_steps();

/// Sweeps of all methods and peers: fixed-step methods over multiples of the scales, methods with step-size
/// control over a common set of tolerances. @param quick fewer settings of each
[[nodiscard]] std::vector<comparison::MethodSweep> sweeps(const StepScales& scales, bool quick);

}  // namespace nlmech::chapters::rbf_ivp
