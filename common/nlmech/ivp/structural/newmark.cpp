#include "nlmech/ivp/structural/newmark.hpp"

namespace nlmech::ivp {

AlphaScheme alpha_scheme(const Newmark& method) {
  require_within(method.name, "beta", method.beta, 0, 0.5);
  require_within(method.name, "gamma", method.gamma, 0, 1);
  return {.beta = method.beta, .gamma = method.gamma};
}

}  // namespace nlmech::ivp
