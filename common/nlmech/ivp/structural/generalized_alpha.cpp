#include "nlmech/ivp/structural/generalized_alpha.hpp"

namespace nlmech::ivp {

AlphaScheme alpha_scheme(const GeneralizedAlpha& method) {
  const double rho = method.rho_inf;
  require_within(method.name, "rho_inf", rho, 0, 1);
  const double alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
  const double root = 1 - alpha_m + alpha_f;
  return {.alpha_m = alpha_m, .alpha_f = alpha_f, .beta = root * root / 4, .gamma = root - 0.5};
}

}  // namespace nlmech::ivp
