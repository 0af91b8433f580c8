/// @file
/// States of n components, and what is made of them.
#pragma once

#include <cstdint>
#include <vector>

#include "nlmech/series/vector.hpp"

namespace nlmech::ivp {

/// The state of n components as a column.
template <int n>
using State = Vector<double, n>;
/// States at many nodes, one a column.
template <int n>
using Nodes = Matrix<double, n, Eigen::Dynamic>;
/// df/dx.
template <int n>
using Jacobian = Matrix<double, n, n>;
/// On which side of each surface a system switches: 1 where its function is positive, -1 where it is
/// negative, 0 for a motion that stays on the surface.
using Mode = std::vector<std::int8_t>;
/// Half of a state: the positions, or the velocities, of a second-order problem.
template <int n>
inline constexpr int half = n == Eigen::Dynamic ? Eigen::Dynamic : n / 2;
/// Positions, velocities or accelerations of a second-order problem.
template <int n>
using Half = Vector<double, half<n>>;

}  // namespace nlmech::ivp
