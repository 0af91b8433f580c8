#include "nlmech/ivp/series/series.hpp"

#include "nlmech/problems/three_mass_chain.hpp"
#include "tests/ivp/series.hpp"

namespace nlmech::ivp::testing {

Solution<6> inlined(const problems::ThreeMassChain& chain, const State<6>& x0, double t0, double t1,
                    const Series& method) {
  return integrate(Direct(chain), x0, t0, t1, method);
}

}  // namespace nlmech::ivp::testing
