#include <stdexcept>

#include "nlmech/peers/ivp/odeint/odeint.hpp"

namespace nlmech::peers {

bool odeint_available() noexcept { return false; }

Status integrate_by(Run&, const Odeint&) {
  throw std::logic_error("this build has no Odeint (NLMECH_PEERS)");
}

template <int n>
requires(ivp::compiled_dimension<ivp::System<n>> != Eigen::Dynamic) Status
    integrate_by(EquationsOf<ivp::System<n>>&, Run& run, const Odeint& method) {
  return integrate_by(run, method);
}
template Status integrate_by(EquationsOf<ivp::System<1>>&, Run&, const Odeint&);
template Status integrate_by(EquationsOf<ivp::System<2>>&, Run&, const Odeint&);
template Status integrate_by(EquationsOf<ivp::System<3>>&, Run&, const Odeint&);
template Status integrate_by(EquationsOf<ivp::System<4>>&, Run&, const Odeint&);
template Status integrate_by(EquationsOf<ivp::System<6>>&, Run&, const Odeint&);

}  // namespace nlmech::peers
