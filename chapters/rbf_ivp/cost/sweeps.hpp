/// @file
/// What the error-vs-time scenes and the benchmark set side by side: ours and the peers, each with a sweep of
/// steps or tolerances.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/cost/method_sweep.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Lengths of steps to begin with, as the dissertation takes them for a problem (Tables 4.2, 4.4, 4.6).
struct StepScales {
  double few_nodes;   ///< step of RBF-Coll with N = 7
  double many_nodes;  ///< step of RBF-Coll with N = 35
  double few_shape;   ///< c times the step for N = 7
  double many_shape;  ///< c times the step for N = 35
};

/// Scales of the free Duffing oscillator: P/10 and P.
[[nodiscard]] StepScales free_duffing_steps();
/// Scales of the impact after its end: 0.5 and 6, and the shape 0.66 that Table 4.4 leaves out.
[[nodiscard]] StepScales impact_steps();
/// Scales of the three masses: 0.625 and 20.
[[nodiscard]] StepScales three_mass_steps();

/// All methods and peers: those of fixed step with steps that begin at the scales, those with step control
/// with one sweep of tolerances for all.
/// @param quick fewer settings of each
[[nodiscard]] std::vector<comparison::MethodSweep> sweeps(const StepScales& scales, bool quick);

}  // namespace nlmech::chapters::rbf_ivp
