#include "nlmech/series/expansion_errors.hpp"

#include <stdexcept>

namespace nlmech {

void throw_unannounced_branch(bool timed) {
  if (timed)
    throw std::invalid_argument(
        "series: the right-hand side branches on the time and has not announced where; give the problem a "
        "member discontinuities(t0, t1)");
  throw std::invalid_argument(
      "series: the right-hand side branches on the state, so that one power series cannot hold for a whole "
      "step; integrate by another method, or split the problem where it branches");
}

}  // namespace nlmech
