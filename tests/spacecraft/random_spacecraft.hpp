/// @file
/// Random spacecraft for properties.
#pragma once

#include <cmath>

#include "nlmech/spacecraft/parameters.hpp"
#include "tests/random.hpp"

namespace nlmech::spacecraft {

using tests::between;

/// Table 3.1 with every entry between a tenth and ten times its value; half of them without tip.
inline rc::Gen<Parameters> random_spacecraft() {
  return rc::gen::exec([] {
    Parameters p = table_3_1();
    for (double Parameters::*const field :
         {&Parameters::hub_inertia, &Parameters::mass_per_length, &Parameters::length,
          &Parameters::hub_radius, &Parameters::second_moment, &Parameters::tip_mass,
          &Parameters::tip_inertia})
      p.*field *= std::pow(10, *between(-1, 1));
    return *rc::gen::arbitrary<bool>() ? p : without_tip(p);
  });
}

}  // namespace nlmech::spacecraft
