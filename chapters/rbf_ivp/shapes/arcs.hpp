/// @file
/// Arcs of the free Duffing oscillator, on which the studies of shapes differentiate.
#pragma once

#include "nlmech/collocation/shape_choice.hpp"

namespace nlmech::chapters::rbf_ivp {

/// x(t) of Eq. 4.23 with X = 1 and its derivative at the n Legendre-Gauss-Lobatto nodes of an interval, which
/// is the unit of time; rounded from 50 digits.
/// @param n       number of nodes
/// @param periods length of the interval in periods of the oscillator
/// @param begin   where it begins, s
[[nodiscard]] collocation::Sampled duffing_arc(int n, double periods, double begin);

}  // namespace nlmech::chapters::rbf_ivp
