/// @file
/// Arcs of the free Duffing oscillator, on which the studies of shapes differentiate.
#pragma once

#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/collocation/radial/shape_choice.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Where arcs begin, s: at no symmetry of the motion, where errors would cancel.
inline constexpr double arc_begin = 1.1;

/// Numbers at the nodes.
using Column50 = collocation::Vector<Digits50>;

/// x(t) of Eq. 4.23 with X = 1 and its derivative at the n Legendre-Gauss-Lobatto nodes of an interval, which
/// is the unit of time; 50 digits.
struct Arc50 {
  Column50 nodes;   ///< on the unit interval
  Column50 values;  ///< x
  Column50 slopes;  ///< dx/dt
};

/// @param n       number of nodes
/// @param periods length of the interval in periods of the oscillator
/// @param begin   where it begins, s
[[nodiscard]] Arc50 exact_duffing_arc(int n, double periods, double begin = arc_begin);

/// The same, rounded.
[[nodiscard]] collocation::Sampled duffing_arc(int n, double periods, double begin = arc_begin);

}  // namespace nlmech::chapters::rbf_ivp
