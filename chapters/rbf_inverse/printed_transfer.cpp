#include "chapters/rbf_inverse/printed_transfer.hpp"

#include <limits>

#include "nlmech/orbit/kepler.hpp"

namespace nlmech::chapters::rbf_inverse {

orbit::TransferProblem printed_transfer() {
  return {{2.87e6, 5.19e6, 2.85e6}, {2.09e6, 7.82e6, 0}, 4320, {.mu = 3.986e14}};
}

double velocity_error(const orbit::Vector3<double>& v1) {
  return (v1 - orbit::Vector3<double>(2774.8469906025419, 7217.0230343355381, 1625.9338905977957)).norm();
}

orbit::Vector3<double> miss_vector(const orbit::Vector3<double>& v1) {
  const orbit::TransferProblem p = printed_transfer();
  const auto end = orbit::propagate_kepler({p.from, v1}, p.time, p.gravity.mu);
  if (!end.status.ok()) return orbit::Vector3<double>::Constant(std::numeric_limits<double>::infinity());
  return end.state.position - p.to;
}

}  // namespace nlmech::chapters::rbf_inverse
