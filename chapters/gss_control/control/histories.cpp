#include "chapters/gss_control/control/histories.hpp"

namespace nlmech::chapters::gss_control {

const spacecraft::ExponentialSum& History::of(const spacecraft::TimeResponse& r) const {
  if (hub) return rate ? r.theta_dot : r.theta;
  return rate ? r.deflection_dot.front() : r.deflection.front();
}

}  // namespace nlmech::chapters::gss_control
