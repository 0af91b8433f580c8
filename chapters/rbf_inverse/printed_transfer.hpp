/// @file
/// The printed transfer of section 5.4, and what a velocity found for it is worth.
#pragma once

#include <array>

#include "nlmech/orbit/transfer.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Eq. 5.38, in metres and seconds.
[[nodiscard]] orbit::TransferProblem printed_transfer();

/// |v - exact| of the initial velocity by tools/oracles/rbf_inverse_lambert.py, m/s.
[[nodiscard]] double velocity_error(const orbit::Vector3<double>& v1);

/// r(t) - r_F of a flight with @p v1, m; infinite if it does not arrive.
[[nodiscard]] orbit::Vector3<double> miss_vector(const orbit::Vector3<double>& v1);

/// Units of time in which the section's equations are solved, s; the first of them as printed.
inline constexpr std::array<double, 12> time_units = {1, 2, 3, 7, 10, 60, 100, 600, 806.8, 1000, 3600, 86400};

}  // namespace nlmech::chapters::rbf_inverse
