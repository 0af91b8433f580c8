/// @file
/// Real numbers of many digits, for references and for what double cannot resolve.
#pragma once

#include <boost/multiprecision/mpfr.hpp>

namespace nlmech {

/// A real number of @p digits decimal digits, at least; operations and elementary functions are MPFR's.
/// Programs that use it link mpfr.
template <unsigned digits>
using ExtendedReal = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<digits, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

}  // namespace nlmech
