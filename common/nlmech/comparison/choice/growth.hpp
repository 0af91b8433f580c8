/// @file
/// How a problem multiplies errors between t0 and t1, found by cheap runs.
#pragma once

#include <string>

#include "nlmech/comparison/choice/features.hpp"

namespace nlmech::comparison {

/// What a problem makes of errors.
struct Growth {
  double factor = 1;   ///< from one tolerance, absolute + relative, to the error by the size of a component
  double covered = 0;  ///< the share of the interval that it was found on, from 0 to 1; 0: it is not known
};

/// The greatest factor from six times to the last of them, by amplification() along a run; not known with
/// more than 64 components.
/// @param method by which it runs
[[nodiscard]] Growth growth_along(const ChoiceRequest& request, const std::string& method);

}  // namespace nlmech::comparison
