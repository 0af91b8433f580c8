#include "nlmech/ivp/structural/hht.hpp"

namespace nlmech::ivp {

AlphaScheme alpha_scheme(const Hht& method) {
  require_within(method.name, "alpha", method.alpha, -1. / 3, 0);
  return {.alpha_m = 0,
          .alpha_f = -method.alpha,
          .beta = (1 - method.alpha) * (1 - method.alpha) / 4,
          .gamma = 0.5 - method.alpha,
          .forgets = method.form == Hht::Form::as_printed};
}

}  // namespace nlmech::ivp
