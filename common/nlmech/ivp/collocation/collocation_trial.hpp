/// @file
/// What both engines of adaptive-collocation are told and answer.
#pragma once

#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp::adaptive {

/// How accurate a step is to be: |e_i| against absolute + relative |x_i|.
struct Tolerance {
  double absolute;  ///< positive
  double relative;  ///< 0 or more
};

/// What an engine is made from.
struct Setup {
  const System& system;  ///< outlives the engine
  Tolerance tolerance;   ///< of its steps
  double shape = 0;      ///< c of Gaussians, 1/time; 0: polynomials
};

/// What came of a trial step.
struct Trial {
  bool converged;  ///< are the collocation equations solved?
  double error;    ///< estimate over tolerance; of the unfinished trial, if it was given up for it, else 0
  int iterations;  ///< how many it took
  double shorter;  ///< part of the step that should converge, after a trial that did not; 0: unknown
};

}  // namespace nlmech::ivp::adaptive
