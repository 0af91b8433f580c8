/// What the tests of multi-step transversal linearisation share.
#pragma once

#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::ivp::testing {

/// Driven Duffing oscillator from x0 at t0 to t1.
inline Solution run(const problems::TextProblem& p, const State& x0, double t0, double t1,
                    const Mtl& method) {
  return integrate(System(p), x0, t0, t1, method);
}

}  // namespace nlmech::ivp::testing
