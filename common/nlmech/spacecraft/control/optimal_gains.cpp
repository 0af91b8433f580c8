#include "nlmech/spacecraft/control/optimal_gains.hpp"

#include <cmath>
#include <limits>

#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

void require_gain(const char* name, double value) {
  if (!(value > 0)) throw invalid_argument("costs: {} = {:g}; it must be positive", name, value);
}

void require_weights(const CostWeights& w) {
  if (!(w.deflection >= 0) || !std::isfinite(w.deflection))
    throw invalid_argument("cost: the weight of the deflection is {:g}; it must be at least 0", w.deflection);
  if (!(w.torque > 0) || !std::isfinite(w.torque))
    throw invalid_argument(
        "cost: the weight of the torque is {:g}; it must be positive, because the gains grow without bound "
        "as it tends to 0",
        w.torque);
}

/// Returns @p best. Throws if it is outside the range of double.
OptimalGains finite(const OptimalGains& best, const CostWeights& w) {
  const Gains& g = best.gains;
  const bool inside = std::isfinite(g.k1) && std::isfinite(g.k2) && std::isfinite(g.k3) &&
                      std::isfinite(best.cost) && g.k1 > 0 && g.k3 > 0;
  if (!inside)
    throw invalid_argument(
        "cost: with the weights {:g} and {:g} the optimal gains of this spacecraft, or their cost, leave the "
        "range of double",
        w.deflection, w.torque);
  return best;
}

}  // namespace

StepCosts step_costs(const Parameters& parameters, const Gains& gains, double x) {
  const ClosedLoop loop(parameters, gains);
  require_gain("k1", gains.k1);
  require_gain("k3", gains.k3);
  const Statics s = statics(parameters, x);
  const double hub = parameters.hub_inertia, inertia = parameters.appendage_inertia(), kappa = loop.kappa();
  const double half = gains.k1 * gains.k1 / (2 * gains.k3);
  StepCosts c{};
  c.error = gains.k3 / (2 * gains.k1) + (hub + kappa * inertia) / (2 * gains.k3);
  c.rate = gains.k1 / (2 * gains.k3);
  c.acceleration = hub > 0 ? half / hub : std::numeric_limits<double>::infinity();
  c.torque = half * (hub + 4 * inertia / kappa);
  c.deflection = 2 * half * s.square / kappa;
  c.deflection_dot = half * s.green / kappa;
  return c;
}

double cost(const Parameters& parameters, const Gains& gains, const CostWeights& weights) {
  require_weights(weights);
  const StepCosts c = step_costs(parameters, gains, parameters.length);
  return c.error + weights.deflection * c.deflection + weights.torque * c.torque;
}

OptimalGains optimal_gains(const Parameters& parameters, const CostWeights& weights) {
  require_weights(weights);
  const double deflection = weights.deflection * statics(parameters, parameters.length).square;
  const double inertia = parameters.appendage_inertia(), r = weights.torque;
  // W C/(2 B_0): increase of the effective weight of the torque by the deflection.
  const double added = deflection / (2 * inertia);
  OptimalGains best{};
  best.cost = std::sqrt(2 * parameters.hub_inertia * std::sqrt(r) + 4 * inertia * std::sqrt(r + added));
  best.gains.k1 = 1 / std::sqrt(r);
  // 2 sqrt(1 + q) - 2 without cancellation.
  const double q = added / r;
  best.gains.k2 = 2 * q / (std::sqrt(1 + q) + 1);
  best.gains.k3 = best.gains.k1 * best.cost;
  return finite(best, weights);
}

OptimalGains optimal_pd_gains(const Parameters& parameters, const CostWeights& weights) {
  require_weights(weights);
  const double deflection = weights.deflection * statics(parameters, parameters.length).square;
  const double inertia = parameters.total_inertia();
  const double price = deflection + weights.torque * inertia;
  OptimalGains best{};
  best.cost = std::sqrt(2 * std::sqrt(inertia * price));
  best.gains.k1 = std::sqrt(inertia / price);
  best.gains.k3 = best.gains.k1 * best.cost;
  return finite(best, weights);
}

}  // namespace nlmech::spacecraft
