#include "chapters/two_body_series/orbits/orbits.hpp"

namespace nlmech::chapters::two_body_series {

Orbit low_orbit() {
  return {"LEO",
          {{1.702547136867679e6, 6.353992417071098e6, 0}, {-7.886014053829254e3, 2.113051097224035e3, 0}},
          25,
          10};
}

Orbit high_orbit() {
  return {"HEO",
          {{2.096434265330419e6, 7.823999192941453e6, 0}, {-8.834757074967362e3, 2.367266023562654e3, 0}},
          100,
          30};
}

}  // namespace nlmech::chapters::two_body_series
