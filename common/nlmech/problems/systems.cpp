// Systems of the library's problems, so that no program compiles one anew.
#include "nlmech/ivp/compiled_system.hpp"
#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/bodies.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/duffing_chain.hpp"
#include "nlmech/problems/forced_duffing.hpp"
#include "nlmech/problems/hires.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/linear_oscillator.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/projectile.hpp"
#include "nlmech/problems/robertson.hpp"
#include "nlmech/problems/strong_oscillator.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_body.hpp"
#include "nlmech/problems/two_dof.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::ivp::detail {

using namespace problems;
template struct InSystem<BlowUp>;
template struct InSystem<BasicBodies<double, 4>>;
template struct InSystem<DrivenDuffing>;
template struct InSystem<Duffing>;
template struct InSystem<DuffingChain>;
template struct InSystem<BasicForcedDuffing<double>>;
template struct InSystem<Hires>;
template struct InSystem<ImpactDuffing>;
template struct InSystem<LinearOscillator>;
template struct InSystem<BasicLorenz<double>>;
template struct InSystem<BasicProjectile<double>>;
template struct InSystem<Robertson>;
template struct InSystem<BasicStrongOscillator<double>>;
template struct InSystem<BasicThreeMassChain<double>>;
template struct InSystem<TwoBody>;
template struct InSystem<TwoDof>;
template struct InSystem<VanDerPol>;

}  // namespace nlmech::ivp::detail
