/// @file
/// The generalised state space solution in the closed form of the source, corrected: the function f of Eq.
/// 3.30 and its derivatives, Eqs. 3.28, 3.33 and 3.42. Exact on paper; in doubles it loses digits at both
/// ends of the spectrum, which is what it is kept for. Any complex type of number.
#pragma once

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::spacecraft {

/// Both transfer functions in the closed form.
template <class C>
struct ClosedForm {
  C theta;       ///< theta/u
  C deflection;  ///< y(x)/u
};

}  // namespace nlmech::spacecraft
