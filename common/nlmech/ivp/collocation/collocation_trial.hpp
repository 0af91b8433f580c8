/// @file
/// Input and result of one trial step; shared by the sweeps and Newton's iteration.
#pragma once

#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp::adaptive {

/// Error bound of a step: |e_i| <= absolute + relative |x_i|.
struct Tolerance {
  double absolute;  ///< positive
  double relative;  ///< 0 or more
};

/// Arguments of the constructor of an engine.
struct Setup {
  const System& system;  ///< outlives the engine
  Tolerance tolerance;   ///< of each step
  double shape = 0;      ///< c of Gaussians, 1/time; 0: polynomials
};

/// Result of a trial step.
struct Trial {
  bool converged;  ///< are the collocation equations solved?
  double
      error;  ///< error estimate over tolerance; without convergence the estimate that ended the trial, or 0
  int iterations;  ///< number of iterations
  double shorter;  ///< without convergence: fraction of the step that should converge; 0: unknown
};

}  // namespace nlmech::ivp::adaptive
