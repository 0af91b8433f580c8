/// @file
/// The printed transfer of section 5.4, and errors of an initial velocity for it.
#pragma once

#include <array>
#include <limits>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Eq. 5.38, in metres and seconds.
[[nodiscard]] inline orbit::TransferProblem printed_transfer() {
  return {{2.87e6, 5.19e6, 2.85e6}, {2.09e6, 7.82e6, 0}, 4320, {.mu = 3.986e14}};
}

/// Error of an initial velocity, with the reference of tools/oracles/rbf_inverse_lambert.py, m/s.
[[nodiscard]] inline double velocity_error(const orbit::Vector3<double>& v1) {
  return (v1 - orbit::Vector3<double>(2774.8469906025419, 7217.0230343355381, 1625.9338905977957)).norm();
}

/// Miss r(t) - r_F of the orbit with the initial velocity @p v1, m; infinite if the propagation fails.
[[nodiscard]] inline orbit::Vector3<double> miss_vector(const orbit::Vector3<double>& v1) {
  const orbit::TransferProblem p = printed_transfer();
  const auto end = orbit::propagate_kepler({p.from, v1}, p.time, p.gravity.mu);
  if (!end.status.ok()) return orbit::Vector3<double>::Constant(std::numeric_limits<double>::infinity());
  return end.state.position - p.to;
}

/// Units of time in which the equations of the section are solved, s; the first one as printed.
inline constexpr std::array<double, 12> time_units = {1, 2, 3, 7, 10, 60, 100, 600, 806.8, 1000, 3600, 86400};

}  // namespace nlmech::chapters::rbf_inverse
