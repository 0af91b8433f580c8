/// @file
/// Real numbers of extended precision, for references and for quantities that double cannot resolve.
#pragma once

#include <boost/multiprecision/mpfr.hpp>

namespace nlmech {

/// A real number of at least @p digits decimal digits; operations and elementary functions of MPFR. Programs
/// that use it link mpfr.
template <unsigned digits>
using ExtendedReal = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<digits, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

}  // namespace nlmech
